// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/random.h>
#include <pcl6d/scanner/pinhole_camera.h>

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include <cmath>
#include <limits>

namespace {
using Eigen::Vector2d;
using Eigen::Vector3d;
using pcl6d::CameraIntrinsics;
using pcl6d::PinholeCamera;

CameraIntrinsics
ordinaryLens()
{
  CameraIntrinsics lens;
  lens.fx = 520.3;
  lens.fy = 518.7;
  lens.cx = 322.1;
  lens.cy = 236.4;
  lens.k = {-0.28, 0.07, -0.004, 0, 0, 0};
  lens.p = {7e-4, -3e-4};
  return lens;
}

CameraIntrinsics
rationalLens()
{
  CameraIntrinsics lens = ordinaryLens();
  lens.k = {0.5, -0.2, 0.01, 0.8, -0.1, 0.03};
  return lens;
}

cv::Mat
matrixOf(const CameraIntrinsics& lens)
{
  return (cv::Mat_<double>(3, 3) << lens.fx, 0, lens.cx, 0, lens.fy, lens.cy, 0, 0, 1);
}

cv::Mat
distortionOf(const CameraIntrinsics& lens)
{
  const auto& k = lens.k;
  return (cv::Mat_<double>(1, 8) << k[0],
          k[1],
          lens.p[0],
          lens.p[1],
          k[2],
          k[3],
          k[4],
          k[5]);
}
} // namespace

TEST(PinholeCamera, ProjectsLikeOpenCV)
{
  for (const auto& lens : {ordinaryLens(), rationalLens()}) {
    const PinholeCamera camera(lens);
    pcl6d::Random random(1);
    std::vector<cv::Point3d> points;
    for (int i = 0; i < 200; ++i) {
      const double z = random.uniform(1, 9);
      points.emplace_back(
          z * random.uniform(-0.6, 0.6), z * random.uniform(-0.5, 0.5), z);
    }
    std::vector<cv::Point2d> pixels;
    const cv::Mat zero = cv::Mat::zeros(3, 1, CV_64F);
    cv::projectPoints(points, zero, zero, matrixOf(lens), distortionOf(lens), pixels);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto pixel = camera.project({points[i].x, points[i].y, points[i].z});
      ASSERT_TRUE(pixel);
      EXPECT_NEAR(pixel->x(), pixels[i].x, 1e-10);
      EXPECT_NEAR(pixel->y(), pixels[i].y, 1e-10);
    }
  }
}

TEST(PinholeCamera, UndistortsToTheLastBits)
{
  auto skewed = ordinaryLens();
  skewed.skew = 3;
  auto barrel = ordinaryLens();
  barrel.k = {-0.28, 0, 0, 0, 0, 0};
  for (const auto& lens : {ordinaryLens(), rationalLens(), skewed, barrel}) {
    const PinholeCamera camera(lens);
    for (double x = -0.6; x <= 0.6; x += 0.05)
      for (double y = -0.6; y <= 0.6; y += 0.05) {
        const auto pixel = camera.project({x, y, 1});
        ASSERT_TRUE(pixel) << x << ' ' << y;
        const auto xy = camera.undistort(*pixel);
        ASSERT_TRUE(xy) << x << ' ' << y;
        // A pixel near 600 is rounded to 600 * 2^-53; over fx = 520 that is 1.3e-16 in
        // x', and at most twice that in x: d(r f)/dr >= 0.5 here.
        EXPECT_LT((*xy - Vector2d(x, y)).norm(), 4e-15) << x << ' ' << y;
      }
  }
}

TEST(PinholeCamera, EndsWhereItsModelBendsBack)
{
  CameraIntrinsics lens;
  lens.k = {-0.28, 0, 0, 0, 0, 0};
  const PinholeCamera camera(lens);
  const double end = 1 / std::sqrt(3 * 0.28); // 1 + 3 k1 r^2 = 0
  EXPECT_NEAR(camera.largestRadius(), end, 1e-12);
  EXPECT_TRUE(camera.project({0.999 * end, 0, 1}));
  EXPECT_FALSE(camera.project({1.001 * end, 0, 1}));
  const double most = lens.fx * end * (1 - 0.28 * end * end); // the outermost pixel
  EXPECT_FALSE(camera.undistort({lens.cx + 1.001 * most, lens.cy}));
  const double near_end = 0.9999 * end;
  const auto xy = camera.undistort(*camera.project({near_end, 0, 1}));
  ASSERT_TRUE(xy);
  EXPECT_NEAR(xy->x(), near_end, 1e-11); // slope 3e-4 there
  EXPECT_EQ(PinholeCamera().largestRadius(), std::numeric_limits<double>::infinity());
}

TEST(PinholeCamera, StopsBeforeAPole)
{
  CameraIntrinsics lens;
  lens.k = {0, 0, 0, -0.25, 0, 0}; // f = 1 / (1 - r^2 / 4): infinite at r = 2
  const PinholeCamera camera(lens);
  EXPECT_NEAR(camera.largestRadius(), 2, 1e-9);
  EXPECT_FALSE(camera.project({2.5, 0, 1}));
}

TEST(PinholeCamera, SeesNothingBehindOrBeside)
{
  const PinholeCamera camera;
  EXPECT_FALSE(camera.project({0.1, 0.1, 0}));
  EXPECT_FALSE(camera.project({0.1, 0.1, -1}));
  EXPECT_FALSE(camera.project(Vector3d::Constant(NAN)));
  EXPECT_FALSE(camera.undistort(Vector2d::Constant(NAN)));
  EXPECT_TRUE(camera.isInImage({-0.4, 479.4}));
  EXPECT_FALSE(camera.isInImage({639.6, 10}));
}

TEST(PinholeCamera, NamesABadParameter)
{
  const auto expectRefused = [](auto spoil, const std::string& words) {
    CameraIntrinsics lens;
    spoil(lens);
    try {
      PinholeCamera camera(lens);
      FAIL() << words;
    } catch (const pcl6d::BadArgument& e) {
      EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    }
  };
  expectRefused([](auto& lens) { lens.width = 0; }, "width = 0");
  expectRefused([](auto& lens) { lens.height = 1000000; }, "height = 1000000");
  expectRefused([](auto& lens) { lens.width = lens.height = 60000; }, "57.6 GB");
  expectRefused([](auto& lens) { lens.fx = 0; }, "fx = 0");
  expectRefused([](auto& lens) { lens.fy = NAN; }, "fy = nan");
  expectRefused([](auto& lens) { lens.k[5] = INFINITY; }, "k6 = inf");
  expectRefused([](auto& lens) { lens.p[0] = NAN; }, "p1 = nan");
}
