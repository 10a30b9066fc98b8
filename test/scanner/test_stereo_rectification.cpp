// SPDX-License-Identifier: BSD-3-Clause
#include "scanner/expect_refused.h"
#include "scanner/stereo_rig.h"

#include <pcl6d/common/random.h>

#include <opencv2/imgproc.hpp>

namespace {
using Eigen::Matrix3d;
using Eigen::Vector3d;
using pcl6d::CameraIntrinsics;
using pcl6d::PinholeCamera;
using pcl6d::StereoCalibration;
using pcl6d::StereoRectification;
using pcl6d::test::expectRefused;
using pcl6d::test::idealRig;
using pcl6d::test::realRig;

/** \return the pixel of a point in the rectified image of a camera at `centre` */
Eigen::Vector2d
rectifiedPixel(const StereoRectification& rectification,
               const Vector3d& centre,
               const Vector3d& point)
{
  const Vector3d ideal = rectification.intrinsics().matrix() *
                         (rectification.rotation() * (point - centre));
  return ideal.hnormalized();
}

StereoCalibration
uprightRig() // the right camera below the left one
{
  StereoCalibration rig = idealRig();
  rig.T_right_left.translation() << 0, -0.2, 0;
  return rig;
}
} // namespace

TEST(StereoRectification, BringsBothPixelsOfAPointIntoOneRow)
{
  for (const auto& rig : {idealRig(), realRig(), uprightRig()}) {
    const StereoRectification rectification(rig);
    const Vector3d right = rig.T_right_left.inverse().translation();
    EXPECT_NEAR(rectification.baseline(), right.norm(), 1e-15);
    EXPECT_LT((rectification.rotation() * rectification.rotation().transpose() -
               Matrix3d::Identity())
                  .norm(),
              1e-14);
    EXPECT_NEAR(rectification.rotation().determinant(), 1, 1e-14);
    pcl6d::Random random(5);
    for (int i = 0; i < 100; ++i) {
      const double z = random.uniform(1, 20);
      const Vector3d point(
          z * random.uniform(-0.4, 0.4), z * random.uniform(-0.3, 0.3), z);
      const auto a = rectifiedPixel(rectification, Vector3d::Zero(), point);
      const auto b = rectifiedPixel(rectification, right, point);
      EXPECT_NEAR(a.y(), b.y(), 1e-10);
      EXPECT_GT(a.x(), b.x());
      const Vector3d back = rectification.rotation().transpose() *
                            rectification.triangulate(a.x(), a.y(), a.x() - b.x());
      EXPECT_LT((back - point).norm(), 1e-9 * z * z);
    }
  }
}

// The book's epipolar constraint, on pixels without distortion: x2^T F x1 = 0.
TEST(StereoRectification, AgreesWithTheFundamentalMatrix)
{
  const StereoCalibration rig = realRig();
  const Matrix3d R = rig.T_right_left.linear();
  const Vector3d t = rig.T_right_left.translation();
  Matrix3d sk;
  sk << 0, -t.z(), t.y(), t.z(), 0, -t.x(), -t.y(), t.x(), 0;
  const StereoRectification rectification(rig);
  const Matrix3d K = rectification.intrinsics().matrix();
  const Matrix3d H1 = K * rectification.rotation() * rig.left.matrix().inverse();
  const Matrix3d H2 =
      K * rectification.rotation() * R.transpose() * rig.right.matrix().inverse();
  const Matrix3d F =
      rig.right.matrix().transpose().inverse() * sk * R * rig.left.matrix().inverse();
  // Points of one row of the rectified images keep the constraint of the originals.
  for (const double row : {10.0, 100.0, 230.0})
    for (const double disparity : {1.0, 20.0}) {
      const Vector3d x1 = H1.inverse() * Vector3d(150, row, 1);
      const Vector3d x2 = H2.inverse() * Vector3d(150 - disparity, row, 1);
      const Vector3d line = F * x1; // distance of a pixel from its epipolar line
      EXPECT_NEAR(
          x2.hnormalized().homogeneous().dot(line) / line.head<2>().norm(), 0, 1e-10);
    }
}

TEST(StereoRectification, MovesPixelsToWhereTheyBelong)
{
  // A bright dot, drawn where the bent lens sees a point, lands where an ideal camera
  // would see it.
  const StereoCalibration rig = realRig();
  const StereoRectification rectification(rig);
  const Vector3d point(0.4, -0.3, 3);
  const auto seen = PinholeCamera(rig.left).project(point);
  cv::Mat image(240, 320, CV_8UC1, cv::Scalar(0));
  cv::circle(image,
             cv::Point(static_cast<int>(std::lround(seen->x() * 16)),
                       static_cast<int>(std::lround(seen->y() * 16))),
             3 * 16,
             cv::Scalar(255),
             cv::FILLED,
             cv::LINE_AA,
             4);
  const auto moments = cv::moments(rectification.rectifyLeft(image));
  const auto expected = rectifiedPixel(rectification, Vector3d::Zero(), point);
  EXPECT_NEAR(moments.m10 / moments.m00, expected.x(), 0.1);
  EXPECT_NEAR(moments.m01 / moments.m00, expected.y(), 0.1);
  EXPECT_GT((*seen - expected).norm(), 2) << "the test would see no difference";
}

TEST(StereoRectification, LeavesAnIdealPairAlone)
{
  const StereoRectification rectification(idealRig());
  EXPECT_LT((rectification.rotation() - Matrix3d::Identity()).norm(), 1e-15);
  EXPECT_NEAR(rectification.intrinsics().fx, 300, 1e-12);
  EXPECT_NEAR(rectification.intrinsics().cx, 159.5, 1e-12);
  cv::Mat image(240, 320, CV_8UC1);
  cv::randu(image, 0, 256);
  EXPECT_EQ(cv::norm(rectification.rectifyLeft(image), image, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(rectification.rectifyRight(image), image, cv::NORM_INF), 0);
}

TEST(StereoRectification, KnowsWhatBothCamerasSee)
{
  const StereoRectification ideal(idealRig());
  EXPECT_TRUE(ideal.isSeen(0, 50, 50));
  EXPECT_FALSE(ideal.isSeen(0, 50, 51)) << "left of the right image";
  EXPECT_FALSE(ideal.isSeen(0, 319, -1)) << "right of it";
  // A white picture is black exactly where the camera does not see, but for its border.
  const StereoRectification rectification(realRig());
  const cv::Mat white(240, 320, CV_8UC1, cv::Scalar(255));
  const cv::Mat left = rectification.rectifyLeft(white);
  int black = 0;
  for (int row = 0; row < 240; ++row)
    for (int col = 0; col < 320; ++col)
      if (left.at<std::uint8_t>(row, col) == 0) {
        ++black;
        EXPECT_FALSE(rectification.isSeen(row, col, 1)) << row << ' ' << col;
      }
  EXPECT_GT(black, 100);
  EXPECT_TRUE(rectification.isSeen(120, 160, 1));
}

TEST(StereoRectification, RefusesASenselessRig)
{
  const auto refused = [](auto spoil, const std::string& words) {
    StereoCalibration rig = realRig();
    spoil(rig);
    expectRefused([&] { StereoRectification rectification(rig); }, words);
  };
  refused([](auto& rig) { rig.left.fx = -1; }, "fx = -1");
  refused([](auto& rig) { rig.right.width = 319; },
          "size of the right image = 319 x 240");
  refused([](auto& rig) { rig.T_right_left.translation().setZero(); }, "baseline = 0");
  refused([](auto& rig) { rig.T_right_left.linear() *= -1; }, "T_right_left");
  refused([](auto& rig) { rig.T_right_left.translation() << 0, 0, 0.3; },
          "stands before the other");
  const StereoRectification rectification(realRig());
  const cv::Mat small(10, 10, CV_8UC1, cv::Scalar(0));
  expectRefused([&] { rectification.rectifyLeft(small); }, "10 x 10");
}
