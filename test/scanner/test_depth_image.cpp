// SPDX-License-Identifier: BSD-3-Clause
#include "scanner/expect_refused.h"

#include <pcl6d/scanner/depth_image.h>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include <cmath>
#include <limits>

namespace {
using Eigen::Vector3d;
using pcl6d::CameraIntrinsics;
using pcl6d::DepthImageOptions;
using pcl6d::DepthKind;
using pcl6d::PinholeCamera;
using pcl6d::test::expectRefused;

/** The SR3000's 176 x 144 pixels, with a bent lens. */
PinholeCamera
camera()
{
  CameraIntrinsics lens;
  lens.width = 176;
  lens.height = 144;
  lens.fx = lens.fy = 200;
  lens.cx = 88;
  lens.cy = 71;
  lens.k = {-0.3, 0.1, 0, 0, 0, 0};
  return PinholeCamera(lens);
}

/** \return the depths [mm] of the plane n . p = offset in the camera's frame */
cv::Mat
planeDepths(const Vector3d& n, double offset, DepthKind kind)
{
  const PinholeCamera eye = camera();
  cv::Mat depth(144, 176, CV_16UC1);
  for (int row = 0; row < depth.rows; ++row)
    for (int col = 0; col < depth.cols; ++col) {
      const Vector3d v = eye.undistort(Eigen::Vector2d(col, row))->homogeneous();
      const double z = offset / n.dot(v);
      depth.at<std::uint16_t>(row, col) = static_cast<std::uint16_t>(
          std::lround(1000 * z * (kind == DepthKind::kRadial ? v.norm() : 1)));
    }
  return depth;
}
} // namespace

TEST(DepthImage, OfAPlaneGivesItsPoints)
{
  const Vector3d n = Vector3d(0.2, -0.1, 1).normalized();
  for (const auto kind : {DepthKind::kRadial, DepthKind::kAlongAxis}) {
    DepthImageOptions options;
    options.kind = kind;
    const auto cloud = depthImageToCloud(planeDepths(n, 3, kind), camera(), options);
    EXPECT_TRUE(cloud.is_dense);
    ASSERT_EQ(cloud.width, 176u);
    ASSERT_EQ(cloud.height, 144u);
    for (const auto& p : cloud) // half a millimetre of rounding times n.v < 1.2
      EXPECT_NEAR(n.dot(Vector3d(-p.y, -p.z, p.x)), 3, 0.0006);
  }
  // The two kinds differ by more than that, or the test would see nothing.
  const auto wrong =
      depthImageToCloud(planeDepths(n, 3, DepthKind::kAlongAxis), camera());
  EXPECT_GT(std::abs(n.dot(Vector3d(-wrong[0].y, -wrong[0].z, wrong[0].x)) - 3), 0.1);
}

TEST(DepthImage, LeavesOutWhatIsNotToBeBelieved)
{
  cv::Mat depth(144, 176, CV_16UC1, cv::Scalar(2000));
  cv::Mat amplitude(144, 176, CV_8UC1, cv::Scalar(90));
  depth.at<std::uint16_t>(10, 10) = 0;    // no measurement
  depth.at<std::uint16_t>(20, 20) = 100;  // too near
  depth.at<std::uint16_t>(30, 30) = 9000; // too far
  depth.at<std::uint16_t>(40, 40) = 2600; // flying
  amplitude.at<std::uint8_t>(50, 50) = 9; // too weak
  DepthImageOptions options;
  options.min_depth = 0.2;
  options.max_depth = 8;
  options.min_amplitude = 10;
  const auto missing = [&] {
    const auto cloud = depthImageToCloud(depth, camera(), options, &amplitude);
    std::size_t count = 0;
    for (const auto& p : cloud)
      count += std::isnan(p.x);
    for (const int i : {10, 20, 30, 50})
      EXPECT_TRUE(std::isnan(cloud.at(i, i).x)) << i;
    EXPECT_EQ(cloud.at(60, 60).intensity, 90);
    return count;
  };
  EXPECT_EQ(missing(), 4u);
  options.max_jump = 0.5; // each jump takes its four neighbours along
  EXPECT_EQ(missing(), 4u + 4 + 4 + 5);
}

TEST(DepthImage, RefusesSenselessInput)
{
  const cv::Mat depth(144, 176, CV_16UC1, cv::Scalar(1));
  const auto refused = [&](auto spoil, const std::string& words) {
    DepthImageOptions options;
    spoil(options);
    expectRefused([&] { depthImageToCloud(depth, camera(), options); }, words);
  };
  refused([](auto& o) { o.unit = 0; }, "unit = 0");
  refused([](auto& o) { o.min_depth = NAN; }, "min_depth = nan");
  refused([](auto& o) { o.max_depth = 0; }, "max_depth = 0");
  refused([](auto& o) { o.max_jump = -1; }, "max_jump = -1");
  const cv::Mat small(10, 20, CV_16UC1, cv::Scalar(1));
  expectRefused([&] { depthImageToCloud(small, camera()); }, "depth image = 20 x 10");
  const cv::Mat bytes(144, 176, CV_8UC1, cv::Scalar(1));
  expectRefused([&] { depthImageToCloud(bytes, camera()); }, "depth image = 0");
  expectRefused([&] { depthImageToCloud(depth, camera(), {}, &small); },
                "amplitude image = 20 x 10");
}

TEST(DepthImage, OfFloatingPointIsThatOfItsSteps)
{
  cv::Mat steps = planeDepths({0, 0, 1}, 3, DepthKind::kAlongAxis);
  steps.at<std::uint16_t>(70, 80) = 0;
  cv::Mat metres(steps.rows, steps.cols, CV_32FC1);
  for (int row = 0; row < steps.rows; ++row)
    for (int col = 0; col < steps.cols; ++col)
      metres.at<float>(row, col) =
          static_cast<float>(steps.at<std::uint16_t>(row, col)); // [mm], too
  metres.at<float>(70, 80) = std::numeric_limits<float>::quiet_NaN();
  DepthImageOptions options;
  options.kind = DepthKind::kAlongAxis;
  options.max_jump = 0.5;
  const auto expected = depthImageToCloud(steps, camera(), options);
  const auto cloud = depthImageToCloud(metres, camera(), options);
  ASSERT_EQ(cloud.size(), expected.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (std::isfinite(expected[i].x)) {
      ASSERT_EQ(cloud[i].getVector3fMap(), expected[i].getVector3fMap()) << i;
    }
    else {
      ASSERT_FALSE(std::isfinite(cloud[i].x)) << i;
    }
  metres.at<float>(1, 1) = -3;
  metres.at<float>(1, 2) = std::numeric_limits<float>::infinity();
  const auto holes = depthImageToCloud(metres, camera(), options);
  EXPECT_FALSE(std::isfinite(holes.at(1, 1).x));
  EXPECT_FALSE(std::isfinite(holes.at(2, 1).x));
}

TEST(RangesOfPhases, FollowTheModulation)
{
  constexpr double kModulation = 20e6; // [Hz]: a turn is 7.49481145 m
  cv::Mat phase(1, 4, CV_16UC1, cv::Scalar(0));
  phase.at<std::uint16_t>(0, 1) = 16384;
  phase.at<std::uint16_t>(0, 2) = 32768;
  const cv::Mat ranges = pcl6d::rangesOfPhases(phase, 65536, kModulation);
  EXPECT_EQ(ranges.type(), CV_32FC1);
  EXPECT_EQ(ranges.at<float>(0, 0), 0); // no measurement
  EXPECT_NEAR(ranges.at<float>(0, 1), 7.49481145 / 4, 1e-6);
  EXPECT_NEAR(ranges.at<float>(0, 2), 7.49481145 / 2, 1e-6);
  cv::Mat angle(1, 3, CV_32FC1, cv::Scalar(0));
  angle.at<float>(0, 1) = static_cast<float>(-M_PI / 2); // as atan2() gives it
  angle.at<float>(0, 2) = std::numeric_limits<float>::quiet_NaN();
  const cv::Mat turned = pcl6d::rangesOfPhases(angle, 2 * M_PI, kModulation);
  EXPECT_NEAR(turned.at<float>(0, 1), 7.49481145 * 3 / 4, 1e-5);
  EXPECT_EQ(turned.at<float>(0, 2), 0);
  expectRefused([&] { pcl6d::rangesOfPhases(phase, 0, kModulation); }, "turn = 0");
  expectRefused([&] { pcl6d::rangesOfPhases(phase, 1, 0); }, "modulation = 0");
  const cv::Mat bytes(1, 1, CV_8UC1, cv::Scalar(1));
  expectRefused([&] { pcl6d::rangesOfPhases(bytes, 1, 1); }, "phase image = 0");
}
