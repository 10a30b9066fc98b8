// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/simulation/ray_caster.h>
#include <pcl6d/simulation/scene_builder.h>
#include <pcl6d/simulation/scene_truth.h>
#include <pcl6d/simulation/simulation_scene.h>

#include <gtest/gtest.h>

#include <set>

namespace {
using pcl6d::RayCaster;
using pcl6d::SimulationScene;
using pcl6d::withoutObjects;

// A cube of 1 m on the ground.
pcl6d::TriangleScene
cube(const char* name)
{
  pcl6d::TriangleScene shape;
  pcl6d::addBox(shape, {-0.5, -0.5, 0}, {0.5, 0.5, 1}, {name, 0.5});
  return shape;
}

Eigen::Isometry3d
at(double x)
{
  return Eigen::Isometry3d(Eigen::Translation3d(x, 0, 0));
}

/** A chair, a table, a chair and a shelf at x = 2, 4, 6, 8 before a wall at 10; a dog and
 * a robot walk beside them. */
SimulationScene
hall()
{
  SimulationScene scene;
  pcl6d::addBox(scene.geometry, {-20, -20, -1}, {20, 20, 0}, {"ground", 0.3});
  pcl6d::addBox(scene.geometry, {10, -20, 0}, {11, 20, 3}, {"wall", 0.3});
  scene.addObject("chair", cube("seat"), at(2));
  scene.addObject("table", cube("top"), at(4));
  scene.addObject("chair", cube("seat"), at(6));
  scene.addObject("shelf", cube("board"), at(8));
  for (const char* const name : {"dog", "robot"}) {
    pcl6d::MovingBody body;
    body.name = name;
    body.shape = cube(name);
    body.way = {{0, 5, 0}, {5, 5, 0}};
    scene.addMoving(body);
  }
  pcl6d::numberPlanes(scene.geometry);
  return scene;
}

std::vector<std::string>
classesOf(const SimulationScene& scene)
{
  std::vector<std::string> classes;
  for (const auto& object : scene.objects)
    classes.push_back(object.object_class);
  return classes;
}

// What a ray from far above meets at x: the id of its object, 0: none.
std::uint32_t
objectAt(const RayCaster& caster, double x)
{
  const auto hit = caster.cast({{x, 0.1, 9}, -Eigen::Vector3d::UnitZ()});
  const auto& scene = caster.scene();
  return scene.surfaces[scene.triangles.at(hit.value().triangle).surface].object;
}
} // namespace

TEST(WithoutObjects, TakesAwayAClassAndNumbersTheRestAnew)
{
  const SimulationScene whole = hall();
  const SimulationScene left = withoutObjects(whole, {"chair"});
  EXPECT_EQ(classesOf(left),
            (std::vector<std::string>{"table", "shelf", "dog", "robot"}));
  left.geometry.validate();
  const RayCaster before(whole.geometry), after(left.geometry);
  const std::uint32_t ids[] = {0, 1, 0, 2};
  for (std::uint32_t i = 0; i < 4; ++i) {
    EXPECT_EQ(objectAt(before, 2 + 2 * i), i + 1);
    EXPECT_EQ(objectAt(after, 2 + 2 * i), ids[i]) << "at " << 2 + 2 * i;
  }
  // Where a chair was, a ray goes on to the table, and to the ground.
  const auto hit = after.cast({{0, 0.1, 0.5}, Eigen::Vector3d::UnitX()});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->range, 3.5, 1e-12);
  EXPECT_TRUE(left.objects[1].T_world_object.isApprox(at(8)));
}

TEST(WithoutObjects, NumbersPlanesWithoutHoles)
{
  const SimulationScene whole = hall();
  const SimulationScene left = withoutObjects(whole, {"chair"});
  const auto used = [](const SimulationScene& scene) {
    std::set<std::uint32_t> ids;
    for (const auto& surface : scene.geometry.surfaces)
      if (surface.plane != 0)
        ids.insert(surface.plane);
    return ids;
  };
  const auto planes = used(left);
  ASSERT_FALSE(planes.empty());
  EXPECT_EQ(*planes.begin(), 1u);
  EXPECT_EQ(*planes.rbegin(), planes.size());
  EXPECT_EQ(planes.size() + 2 * 6, used(whole).size()); // two cubes are gone
}

TEST(WithoutObjects, TakesAwayWhatMoves)
{
  const SimulationScene left = withoutObjects(hall(), {"dog", "table"});
  EXPECT_EQ(classesOf(left),
            (std::vector<std::string>{"chair", "chair", "shelf", "robot"}));
  ASSERT_EQ(left.moving.size(), 1u);
  EXPECT_EQ(left.moving[0].name, "robot");
  for (const auto& surface : left.moving[0].shape.surfaces)
    EXPECT_EQ(surface.object, 4u);
}

TEST(WithoutObjects, LeavesTheSceneAsItIsIfTheClassIsNotInIt)
{
  const SimulationScene whole = hall();
  for (const auto& classes : {std::vector<std::string>{}, {"unicorn"}}) {
    const SimulationScene left = withoutObjects(whole, classes);
    EXPECT_EQ(classesOf(left), classesOf(whole));
    ASSERT_EQ(left.geometry.triangles.size(), whole.geometry.triangles.size());
    for (std::size_t i = 0; i < whole.geometry.triangles.size(); ++i) {
      const auto &a = left.geometry.triangles[i], &b = whole.geometry.triangles[i];
      EXPECT_EQ(a.vertices, b.vertices);
      EXPECT_EQ(a.surface, b.surface);
      EXPECT_EQ(left.geometry.surfaces[a.surface].plane,
                whole.geometry.surfaces[b.surface].plane);
    }
  }
}
