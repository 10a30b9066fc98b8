// SPDX-License-Identifier: BSD-3-Clause
// A milk carton in a recorded scene of a depth camera (objects/): a moved copy of the
// scene's own points, so that its pose is exact.
#include "support/constants.h"
#include "support/data_folder.h"

#include <pcl6d/common/median.h>
#include <pcl6d/common/random.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/object_localization/object_localizer.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

using pcl6d::test::kDegree;

namespace {
using namespace pcl6d;
using Cell = std::pair<int, int>;

Eigen::Isometry3d
exactPose()
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.matrix().topRows<3>() << 0.96888, -0.11971, 0.21666, -0.15897, 0.11683, 0.99281,
      0.02612, 0.21250, -0.21823, 0.00000, 0.97590, -0.04213;
  return pose;
}

/** Adds a triangle unless it joins what is far apart: over an edge of the carton. */
void
addTriangle(TriangleMesh& mesh,
            const std::map<Cell, std::uint32_t>& vertices,
            Cell a,
            Cell b,
            Cell c)
{
  constexpr double kLongest = 0.03; // [m]
  std::array<std::uint32_t, 3> corners;
  std::size_t next = 0;
  for (const Cell& cell : {a, b, c}) {
    const auto vertex = vertices.find(cell);
    if (vertex == vertices.end())
      return;
    corners[next++] = vertex->second;
  }
  for (std::size_t i = 0; i < 3; ++i)
    if ((mesh.vertices[corners[i]] - mesh.vertices[corners[(i + 1) % 3]]).norm() >
        kLongest)
      return;
  mesh.triangles.push_back(corners);
}

/** The cloud as a mesh: the means of the points in the cells of the camera's image,
 * joined across it. */
TriangleMesh
meshOf(const Points& model)
{
  constexpr double kCell = 0.0052; // [rad]; makes about 3000 triangles
  struct Sum {
    Eigen::Vector3d points = Eigen::Vector3d::Zero();
    int count = 0;
  };
  std::map<Cell, Sum> sums;
  for (const auto& point : model) {
    const Eigen::Vector3d p = exactPose() * point.cast<double>();
    Sum& sum = sums[{static_cast<int>(std::floor(p.x() / -p.z() / kCell)),
                     static_cast<int>(std::floor(p.y() / -p.z() / kCell))}];
    sum.points += point.cast<double>();
    ++sum.count;
  }
  TriangleMesh mesh;
  std::map<Cell, std::uint32_t> vertices;
  for (const auto& [cell, sum] : sums) {
    vertices[cell] = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(sum.points / sum.count);
  }
  for (const auto& [cell, vertex] : vertices) {
    const auto [x, y] = cell;
    addTriangle(mesh, vertices, cell, {x + 1, y}, {x, y + 1});
    addTriangle(mesh, vertices, {x + 1, y}, {x + 1, y + 1}, {x, y + 1});
  }
  return mesh;
}

Points
withNoise(Points points, double deviation)
{
  Random random(1);
  for (auto& p : points)
    for (int axis = 0; axis < 3; ++axis)
      p[axis] += static_cast<float>(deviation * random.normal());
  return points;
}

class Carton : public testing::Test {
protected:
  static constexpr double kNoise = 0.003; // [m]

  void
  SetUp() override
  {
    PCL6D_DATA_OR_SKIP(folder, "objects");
    model_ = readScan(folder / "milk.pcd").points;
    scene_ = readScan(folder / "milk_cartoon_all_small_clorox.pcd").points;
  }

  ObjectModel
  cloudModel() const
  {
    return ObjectModel::fromCloud("carton", model_);
  }

  /** \return the scene with noise, without the half of the carton that is on one side of
   * its middle along an axis of its frame */
  Points
  cut(int axis, bool lower) const
  {
    constexpr float kOnCarton = 0.008F; // [m]
    std::vector<double> along;
    for (const auto& p : model_)
      along.push_back(p[axis]);
    const double middle = upperMedian(along);
    const PointTree carton(transformed(model_, exactPose()));
    const Points noisy = withNoise(scene_, kNoise);
    Points rest;
    for (std::size_t i = 0; i < scene_.size(); ++i) {
      const Neighbour near = carton.nearest(scene_[i], kOnCarton * kOnCarton);
      const bool is_cut =
          near.index >= 0 &&
          (along[static_cast<std::size_t>(near.index)] < middle) == lower;
      if (!is_cut)
        rest.push_back(noisy[i]);
    }
    return rest;
  }

  /** Expects one carton, the middle of its box and its rotation being so exact. */
  static void
  expectFound(const ObjectLocalizer& localizer,
              const Points& scene,
              double shift,
              double turn)
  {
    const auto found = localizer.locate(LocalizationScene(scene));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].object_class, "carton");
    const Eigen::Isometry3d error = exactPose().inverse() * found[0].T_scene_object;
    const Eigen::Vector3d middle = localizer.model().box().center();
    EXPECT_LT((error * middle - middle).norm(), shift);
    EXPECT_LT(rotationAngle(error.linear()), turn);
  }

  Points model_, scene_;
};
} // namespace

TEST_F(Carton, IsFoundExactly)
{
  const ObjectLocalizer localizer(cloudModel());
  expectFound(localizer, scene_, 0.002, 0.2 * kDegree);
}

TEST_F(Carton, IsFoundInNoise)
{
  const ObjectLocalizer localizer(cloudModel());
  expectFound(localizer, withNoise(scene_, kNoise), 0.002, 0.5 * kDegree);
}

TEST_F(Carton, IsFoundAsMesh)
{
  const TriangleMesh mesh = meshOf(model_);
  EXPECT_GT(mesh.triangles.size(), 2500u);
  EXPECT_LT(mesh.triangles.size(), 3500u);
  const ObjectLocalizer localizer(ObjectModel::fromMesh("carton", mesh));
  expectFound(localizer, scene_, 0.002, 0.5 * kDegree);
  expectFound(localizer, withNoise(scene_, kNoise), 0.01, 2 * kDegree);
}

TEST_F(Carton, IsFoundIfHalfOfItIsCutAway)
{
  const ObjectLocalizer localizer(ObjectModel::fromMesh("carton", meshOf(model_)));
  for (int axis = 0; axis < 3; ++axis)
    for (const bool lower : {true, false}) {
      SCOPED_TRACE(std::string("cut along ") + "xyz"[axis] +
                   (lower ? ", lower half" : ", upper half"));
      const Points scene = cut(axis, lower);
      ASSERT_LT(scene.size() + model_.size() / 3, scene_.size());
      expectFound(localizer, scene, 0.01, 2 * kDegree);
    }
}

TEST_F(Carton, IsNotFoundWhereItIsCutOut)
{
  const PointTree carton(transformed(model_, exactPose()));
  Points rest;
  for (const auto& p : scene_)
    if (carton.nearest(p, 0.01F * 0.01F).index < 0)
      rest.push_back(p);
  const ObjectLocalizer localizer(cloudModel());
  EXPECT_TRUE(localizer.locate(LocalizationScene(rest)).empty());
}
