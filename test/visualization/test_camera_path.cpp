// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/visualization/camera_path.h>

#include <gtest/gtest.h>

#include <limits>

namespace {
using namespace pcl6d;
using Eigen::Vector3d;

const PictureBox kBox{0, 0, 800, 600};

Vector3d
placeOf(const Camera& camera)
{
  return camera.T_world_camera.translation();
}
Vector3d
viewOf(const Camera& camera)
{
  return camera.T_world_camera.linear().col(2);
}

/** A camera 5 m south of a place and 3 m above it, looking at it. */
Camera
cameraAt(const Vector3d& middle)
{
  Camera camera;
  const Vector3d forward = Vector3d(0, 5, -3).normalized(), right = Vector3d::UnitX();
  camera.T_world_camera.linear() << right, forward.cross(right), forward;
  camera.T_world_camera.translation() = middle + Vector3d(0, -5, 3);
  camera.centre = {400, 300};
  return camera;
}

/** Poses on a line, a corner, and a line again. */
Trajectory
corner()
{
  Trajectory trajectory;
  for (int i = 0; i <= 20; ++i) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = Vector3d(std::min(i, 10), std::max(0, i - 10), 1);
    trajectory.poses.push_back(pose);
  }
  return trajectory;
}

void
expectUpright(const Camera& camera)
{
  const Eigen::Matrix3d axes = camera.T_world_camera.linear();
  EXPECT_TRUE((axes.transpose() * axes).isIdentity(1e-12));
  EXPECT_NEAR(axes.determinant(), 1, 1e-12);
  EXPECT_NEAR(axes(2, 0), 0, 1e-12) << "right is level";
  EXPECT_LT(axes(2, 1), 0) << "down is down";
}
} // namespace

TEST(Turntable, GoesOnceAroundAndAlwaysLooksAtTheMiddle)
{
  const Vector3d middle(7, -2, 1);
  const auto cameras = turntable(cameraAt(middle), middle, 8);
  ASSERT_EQ(cameras.size(), 8u);
  EXPECT_TRUE(cameras[0].T_world_camera.isApprox(cameraAt(middle).T_world_camera));
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    EXPECT_TRUE(placeOf(cameras[i])
                    .isApprox(middle + Vector3d(5 * std::sin(M_PI * i / 4),
                                                -5 * std::cos(M_PI * i / 4),
                                                3)))
        << i;
    EXPECT_TRUE(
        cameras[i].toPixel(middle)->head<2>().isApprox(Eigen::Vector2d(400, 300)));
    expectUpright(cameras[i]);
  }
  EXPECT_THROW(turntable(cameraAt(middle), middle, 0), BadArgument);
}

TEST(FlyThrough, FollowsThePathAtConstantSpeedAndLooksAhead)
{
  FlyThroughOptions options;
  options.count = 41;
  options.smoothing = 0;
  options.above = 0.5;
  options.ahead = 2;
  const auto cameras = flyThrough(corner(), kBox, options);
  ASSERT_EQ(cameras.size(), 41u);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const double s = 0.5 * static_cast<double>(i); // 20 m in 40 steps
    EXPECT_TRUE(
        placeOf(cameras[i])
            .isApprox(Vector3d(std::min(s, 10.0), std::max(0.0, s - 10), 1.5), 1e-9))
        << i << ": " << placeOf(cameras[i]).transpose();
    expectUpright(cameras[i]);
  }
  // The place 2 m ahead is in the middle of the picture, also behind the end.
  EXPECT_NEAR(cameras[0].toPixel({2, 0, 1})->x(), 400, 1e-6);
  EXPECT_NEAR(cameras[0].toPixel({2, 0, 1})->y(), 300, 1e-6);
  EXPECT_NEAR(cameras[18].toPixel({10, 1, 1})->x(), 400, 1e-6) << "round the corner";
  EXPECT_TRUE(viewOf(cameras[40]).isApprox(Vector3d(0, 2, -0.5).normalized(), 1e-9));
  // 1.2 rad from left to right.
  EXPECT_NEAR(cameras[0].scale * std::tan(0.6), 400, 1e-9);
}

TEST(FlyThrough, SmoothsTheCorner)
{
  FlyThroughOptions options;
  options.count = 201;
  options.smoothing = 3;
  const auto cameras = flyThrough(corner(), kBox, options);
  double largest = 0;
  for (std::size_t i = 1; i < cameras.size(); ++i)
    largest = std::max(
        largest,
        std::acos(std::min(1.0, viewOf(cameras[i]).dot(viewOf(cameras[i - 1])))));
  EXPECT_LT(largest, 0.1) << "[rad] from picture to picture";
  EXPECT_GT(placeOf(cameras[100]).y(), 0.2) << "cuts the corner";
}

TEST(FlyThrough, LooksOnWhereThePathComesBackOnItself)
{
  Trajectory there_and_back = corner();
  for (std::size_t i = 20; i-- > 0;)
    there_and_back.poses.push_back(there_and_back.poses[i]);
  for (const auto& camera : flyThrough(there_and_back, kBox)) {
    EXPECT_TRUE(camera.T_world_camera.matrix().allFinite());
    expectUpright(camera);
  }
}

TEST(FlyThrough, RefusesPathsWithoutLengthAndBadOptions)
{
  Trajectory still;
  EXPECT_THROW(flyThrough(still, kBox), BadArgument);
  still.poses.assign(3, Eigen::Isometry3d::Identity());
  EXPECT_THROW(flyThrough(still, kBox), BadArgument);
  Trajectory broken = corner();
  broken.poses[3].translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(placeOf(flyThrough(broken, kBox)[50]).allFinite()) << "left out";
  FlyThroughOptions options;
  options.count = 1;
  EXPECT_THROW(flyThrough(corner(), kBox, options), BadArgument);
  options = {};
  options.ahead = 0;
  EXPECT_THROW(flyThrough(corner(), kBox, options), BadArgument);
}
