// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/simulation/moving_body.h>
#include <pcl6d/simulation/moving_scene.h>
#include <pcl6d/simulation/scene_builder.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {
using pcl6d::BadArgument;
using pcl6d::MovingBody;
using pcl6d::MovingScene;
using pcl6d::WayEnd;

// A cube of 1 m on the ground.
pcl6d::TriangleScene
cube()
{
  pcl6d::TriangleScene shape;
  pcl6d::addBox(shape, {-0.5, -0.5, 0}, {0.5, 0.5, 1}, {"cube", 0.5});
  return shape;
}

MovingBody
walker(WayEnd end)
{
  MovingBody body;
  body.name = "walker";
  body.shape = cube();
  body.way = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0.3}};
  body.speed = 2;
  body.end = end;
  return body;
}

const double kSecondLeg = std::sqrt(9.09); // [m]

void
expectPlace(const MovingBody& body,
            double time,
            const Eigen::Vector3d& position,
            const Eigen::Vector3d& ahead)
{
  const Eigen::Isometry3d pose = body.poseAt(time);
  EXPECT_LT((pose.translation() - position).norm(), 1e-12) << "time " << time;
  EXPECT_LT((pose.linear().col(0) - ahead).norm(), 1e-12) << "time " << time;
  EXPECT_EQ(pose.linear().col(2), Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(pose.linear().determinant(), 1, 1e-12);
}

// Bare of things, so that rays beside the bodies go far.
pcl6d::TriangleScene
ground()
{
  pcl6d::TriangleScene scene;
  pcl6d::addBox(scene, {-50, -50, -1}, {50, 50, 0}, {"ground", 0.3});
  return scene;
}
} // namespace

TEST(MovingBody, FollowsItsLegsHeadingAlongThem)
{
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  for (const WayEnd end : {WayEnd::kStop, WayEnd::kReturn, WayEnd::kClosed}) {
    const MovingBody body = walker(end);
    expectPlace(body, 0, {0, 0, 0}, x);
    expectPlace(body, 1.5, {3, 0, 0}, x);
    expectPlace(body, 2, {4, 0, 0}, y);
    expectPlace(body, 2 + kSecondLeg / 4, {4, 1.5, 0.15}, y);
  }
  MovingBody late = walker(WayEnd::kStop);
  late.start = 1;
  expectPlace(late, 1, {3, 0, 0}, x);
  late.speed = 0;
  expectPlace(late, 1000, {1, 0, 0}, x);
}

TEST(MovingBody, StopsReturnsOrGoesRound)
{
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  const double at_end = (4 + kSecondLeg) / 2; // [s]
  const MovingBody stops = walker(WayEnd::kStop);
  expectPlace(stops, at_end + 100, {4, 3, 0.3}, y);
  const MovingBody returns = walker(WayEnd::kReturn);
  expectPlace(returns, at_end + kSecondLeg / 4, {4, 1.5, 0.15}, -y);
  expectPlace(returns, 2 * at_end - 1, {2, 0, 0}, -x);
  expectPlace(returns, 2 * at_end + 1, {2, 0, 0}, x);
  const MovingBody circles = walker(WayEnd::kClosed);
  const double third = std::sqrt(25.09); // [m]
  expectPlace(circles, at_end + third / 4, {2, 1.5, 0.15}, {-0.8, -0.6, 0});
  expectPlace(circles, at_end + third / 2 + 1, {2, 0, 0}, x);
}

TEST(MovingBody, FollowsItsTimetable)
{
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  MovingBody body = walker(WayEnd::kReturn);
  // It waits at (4, 0), jumps to (0, 5), and goes on along -x.
  body.way = {{0, 0, 0}, {4, 0, 0.4}, {4, 0, 0.4}, {0, 5, 0}, {-2, 5, 0}};
  body.times = {1, 3, 5, 5, 6};
  EXPECT_NO_THROW(body.validate());
  expectPlace(body, 0, {0, 0, 0}, x);
  expectPlace(body, 1, {0, 0, 0}, x);
  expectPlace(body, 2, {2, 0, 0.2}, x);
  expectPlace(body, 4, {4, 0, 0.4}, x);
  expectPlace(body, 5, {0, 5, 0}, -x);
  expectPlace(body, 5.5, {-1, 5, 0}, -x);
  expectPlace(body, 100, {-2, 5, 0}, -x);
  EXPECT_TRUE(body.moves());
  body.follows_slope = true; // 10 % up
  const Eigen::Isometry3d pose = body.poseAt(2);
  EXPECT_LT((pose.linear().col(0) - Eigen::Vector3d(4, 0, 0.4).normalized()).norm(),
            1e-12);
  EXPECT_LT((pose.linear().col(1) - y).norm(), 1e-12);
  EXPECT_NEAR(pose.linear().determinant(), 1, 1e-12);
  body.way = {{1, 2, 3}, {1, 2, 3}};
  body.times = {0, 1};
  EXPECT_NO_THROW(body.validate());
  EXPECT_FALSE(body.moves());
  expectPlace(body, 0.5, {1, 2, 3}, x);
  body.times.clear();
  body.speed = 0;
  EXPECT_FALSE(body.moves());
  body.speed = 1;
  EXPECT_TRUE(body.moves());
}

TEST(MovingBody, RefusesWhatCannotMove)
{
  const auto broken = [](const std::function<void(MovingBody&)>& spoil) {
    MovingBody body = walker(WayEnd::kReturn);
    spoil(body);
    EXPECT_THROW(body.validate(), BadArgument);
    EXPECT_THROW(MovingScene(ground(), {body}), BadArgument);
  };
  EXPECT_NO_THROW(walker(WayEnd::kReturn).validate());
  broken([](MovingBody& body) { body.way.resize(1); });
  broken([](MovingBody& body) { body.way[1] = body.way[0]; });
  broken([](MovingBody& body) { body.way[1] = {0, 0, 3}; }); // straight up
  broken([](MovingBody& body) { body.way[2].x() = std::nan(""); });
  broken([](MovingBody& body) { body.speed = -1; });
  broken([](MovingBody& body) { body.speed = 1001; });
  broken([](MovingBody& body) { body.speed = std::nan(""); });
  broken([](MovingBody& body) { body.start = -1; });
  broken(
      [](MovingBody& body) { body.start = std::numeric_limits<double>::infinity(); });
  broken([](MovingBody& body) { body.shape = {}; });
  broken([](MovingBody& body) { body.shape.triangles[0].vertices[0] = 99; });
  broken([](MovingBody& body) { body.times = {0, 1}; }); // of three corners
  broken([](MovingBody& body) { body.times = {0, 2, 1}; });
  broken([](MovingBody& body) { body.times = {0, 1, std::nan("")}; });
  MovingBody body = walker(WayEnd::kClosed);
  body.way.push_back(body.way[0]);
  EXPECT_THROW(body.validate(), BadArgument) << "the last leg has no length";
}

TEST(MovingScene, ShowsBodiesWhereTheyAreAtTheTimeOfTheRay)
{
  const MovingScene scene(ground(), {walker(WayEnd::kStop)});
  // Along y at x = 2, 0.5 m above the ground: the cube passes at 0.75 .. 1.25 s.
  const pcl6d::Ray ray = {{2, -10, 0.5}, {0, 1, 0}};
  EXPECT_FALSE(scene.cast(ray, 0.7));
  EXPECT_FALSE(scene.cast(ray, 1.3));
  const auto hit = scene.cast(ray, 1);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->range, 9.5, 1e-12);
  EXPECT_NEAR(hit->cos_incidence, 1, 1e-12);
  EXPECT_EQ(scene.scene().surfaces[scene.scene().triangles[hit->triangle].surface].name,
            "cube");
  const Eigen::Vector3d p = ray.origin + hit->range * ray.direction;
  const Eigen::Isometry3d T_scene_body = scene.poseOf(hit->triangle, 1);
  EXPECT_NEAR(
      scene.scene()
          .normal(hit->triangle)
          .dot(T_scene_body.inverse() * p - scene.scene().corner(hit->triangle, 0)),
      0,
      1e-12);
}

TEST(MovingScene, HidesWhatIsBehind)
{
  MovingBody near = walker(WayEnd::kStop);
  near.speed = 0;
  MovingBody far = near;
  near.way = {{5, 0, 0}, {6, 0, 0}};
  far.way = {{10, 0, 0}, {11, 0, 0}};
  far.shape.surfaces[0].reflectance = 0.9;
  for (const bool near_first : {true, false}) {
    const MovingScene scene(ground(),
                            near_first ? std::vector<MovingBody>{near, far}
                                       : std::vector<MovingBody>{far, near});
    EXPECT_NEAR(scene.cast({{0, 0, 0.5}, {1, 0, 0}}, 0)->range, 4.5, 1e-12);
    EXPECT_NEAR(scene.cast({{20, 0, 0.5}, {-1, 0, 0}}, 0)->range, 9.5, 1e-12);
    EXPECT_NEAR(scene.cast({{7, 0, 5}, {0, 0, -1}}, 0)->range, 5, 1e-12); // ground
    const auto on_ground = scene.cast({{7, 0, 5}, {0, 0, -1}}, 0)->triangle;
    EXPECT_EQ(scene.poseOf(on_ground, 0).matrix(), Eigen::Matrix4d::Identity());
    const auto top = scene.cast({{10, 0, 5}, {0, 0, -1}}, 0);
    EXPECT_NEAR(top->range, 4, 1e-12);
    EXPECT_EQ(scene.poseOf(top->triangle, 0).translation().x(), 10);
  }
}

TEST(MovingScene, WithoutBodiesIsTheGround)
{
  const MovingScene scene(ground());
  const pcl6d::RayCaster caster(ground());
  const pcl6d::Ray ray = {{0, 0, 3}, Eigen::Vector3d(1, 2, -1).normalized()};
  EXPECT_EQ(scene.cast(ray, 7)->range, caster.cast(ray)->range);
  EXPECT_EQ(scene.scene().triangles.size(), caster.scene().triangles.size());
}
