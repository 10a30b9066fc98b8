// SPDX-License-Identifier: BSD-3-Clause
#include "scanner/expect_refused.h"

#include <pcl6d/scanner/depth_image.h>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include <cmath>

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
