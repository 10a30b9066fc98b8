// SPDX-License-Identifier: BSD-3-Clause
// Stereo on rendered pairs, whose depths are known.
#include "scanner/expect_refused.h"
#include "scanner/stereo_rig.h"

#include <pcl6d/scanner/stereo_cloud.h>

#include <map>

namespace {
using pcl6d::matchStereo;
using pcl6d::StereoCalibration;
using pcl6d::StereoCloud;
using pcl6d::StereoCloudOptions;
using pcl6d::StereoMatchingOptions;
using pcl6d::StereoRectification;
using pcl6d::test::expectRefused;
using pcl6d::test::idealRig;
using pcl6d::test::realRig;
using pcl6d::test::renderPair;
using pcl6d::test::SlantedWall;

constexpr double kGrayNoise = 2; // of 255

StereoCloud
cloudOf(const StereoCalibration& rig,
        const SlantedWall& wall,
        const StereoCloudOptions& options = {})
{
  const StereoRectification rectification(rig);
  const auto pair = renderPair(wall.scene(), rig, kGrayNoise);
  const cv::Mat gray = rectification.rectifyLeft(pair.left);
  const cv::Mat disparity = matchStereo(gray, rectification.rectifyRight(pair.right));
  return stereoCloud(disparity, gray, rectification, options);
}

/** \brief Depth errors over depth_error, so with sigma_disparity = 1 in pixels. */
struct Spread {
  double rms = 0;
  double share = 0; // of the pixels that have a point
};

/** The errors are counted along the viewing ray's depth; points near the image's border,
 * which one camera does not see, are not taken. */
Spread
spreadOf(const StereoCloud& stereo, const SlantedWall& wall)
{
  constexpr std::uint32_t kBorder = 20, kLeft = 110; // [px]
  double sum = 0, count = 0, all = 0;
  const auto& cloud = stereo.cloud;
  for (std::uint32_t row = kBorder; row < cloud.height - kBorder; ++row)
    for (std::uint32_t col = kLeft; col < cloud.width - kBorder; ++col) {
      ++all;
      const auto& p = cloud.at(static_cast<int>(col), static_cast<int>(row));
      if (std::isnan(p.x))
        continue;
      const double x = -p.y / p.x; // per metre of depth, to the right
      const double depth = wall.distance / (1 - wall.slope * x);
      const double error = (p.x - depth) / stereo.depth_error[row * cloud.width + col];
      sum += error * error;
      ++count;
    }
  return {std::sqrt(sum / count), count / all};
}
} // namespace

// The matcher errs by some share of a pixel, whatever the depth; so the depth errors must
// grow as z^2 / (b f). A matcher's sub-pixel step prefers whole pixels, so each wall is
// slanted to span more than one pixel of disparity.
TEST(StereoCloud, ErrsByTheSquareOfTheDepth)
{
  StereoCloudOptions options;
  options.sigma_disparity = 1; // errors then count in pixels
  std::map<double, double> rms;
  double sum_sq = 0;
  for (const double distance : {2.0, 3.0, 4.0, 6.0, 8.0}) {
    const SlantedWall wall{distance, 0.364}; // 20 deg
    const Spread spread = spreadOf(cloudOf(idealRig(), wall, options), wall);
    EXPECT_GT(spread.share, 0.99);
    rms[distance] = spread.rms;
    sum_sq += spread.rms * spread.rms;
    RecordProperty("sigma_disparity_at_" + std::to_string(distance),
                   std::to_string(spread.rms));
  }
  const double sigma = std::sqrt(sum_sq / static_cast<double>(rms.size())); // [px]
  EXPECT_LT(sigma, 0.25) << "worse than the default of sigma_disparity";
  for (const auto& [distance, one] : rms)
    EXPECT_NEAR(one / sigma, 1, 0.1) << distance;
}

TEST(StereoCloud, FitsTheWallSeenByARealRig)
{
  const SlantedWall wall{3, 0.2};
  const StereoCloud stereo = cloudOf(realRig(), wall);
  const Spread spread = spreadOf(stereo, wall);
  EXPECT_GT(spread.share, 0.98);
  EXPECT_LT(spread.rms, 1) << "in standard deviations";
  // One column of the rectified image, against the formula.
  const StereoRectification rectification(realRig());
  const double fb = rectification.intrinsics().fx * rectification.baseline();
  for (std::size_t i = 160; i < stereo.cloud.size(); i += stereo.cloud.width) {
    const auto& p = stereo.cloud[i];
    if (std::isnan(p.x))
      continue;
    const double z = rectification.rotation().row(2).dot(
        Eigen::Vector3d(-p.y, -p.z, p.x)); // the rectified depth
    EXPECT_NEAR(stereo.depth_error[i], z * z / fb * 0.25, 1e-5);
  }
}

TEST(StereoCloud, ComputesFromDisparitiesByTheFormula)
{
  const StereoRectification rectification(idealRig());
  cv::Mat disparity(240, 320, CV_32FC1, cv::Scalar(NAN));
  disparity.at<float>(24, 30) = 31; // left of the right image
  disparity.at<float>(20, 30) = 18; // 300 * 0.12 / 18 = 2 m
  disparity.at<float>(21, 30) = 0;
  disparity.at<float>(22, 30) = -3;
  disparity.at<float>(23, 30) = 0.5f; // 72 m: too far
  const cv::Mat gray(240, 320, CV_8UC1, cv::Scalar(51));
  const StereoCloud stereo = stereoCloud(disparity, gray, rectification);
  EXPECT_EQ(stereo.cloud.width, 320u);
  EXPECT_EQ(stereo.cloud.height, 240u);
  const auto& p = stereo.cloud.at(30, 20);
  EXPECT_NEAR(p.x, 2, 1e-6);
  EXPECT_NEAR(p.y, -(30 - 159.5) * 2 / 300, 1e-6);
  EXPECT_NEAR(p.z, -(20 - 119.5) * 2 / 300, 1e-6);
  EXPECT_NEAR(p.intensity, 0.2, 1e-6);
  EXPECT_NEAR(stereo.depth_error[20 * 320 + 30], 4.0 / 36 * 0.25, 1e-7);
  for (std::size_t i = 0; i < stereo.cloud.size(); ++i)
    EXPECT_EQ(std::isnan(stereo.cloud[i].x), i != 20 * 320 + 30) << i;
}

TEST(MatchStereo, SeesAShiftedPictureBothWays)
{
  cv::Mat wide(120, 260, CV_8UC1);
  cv::theRNG().state = 7;
  cv::randu(wide, 0, 256);
  const cv::Mat left = wide(cv::Rect(0, 0, 240, 120)).clone();
  const cv::Mat right = wide(cv::Rect(12, 0, 240, 120)).clone(); // disparity 12
  StereoMatchingOptions options;
  options.num_disparities = 32;
  for (const char* const name : {"sgbm", "bm"}) {
    options.matcher = pcl6d::stereoMatcherFromName(name);
    options.block_size = 9;
    EXPECT_EQ(toString(options.matcher), name);
    const cv::Mat disparity = matchStereo(left, right, options);
    ASSERT_EQ(disparity.type(), CV_32FC1);
    for (int row = 20; row < 100; ++row)
      for (int col = 24; col < 220; ++col) // from less than num_disparities on
        ASSERT_NEAR(disparity.at<float>(row, col), 12, 0.25) << row << ' ' << col;
    EXPECT_TRUE(std::isnan(disparity.at<float>(60, 3))) << "not in the right image";
  }
}

TEST(MatchStereo, RefusesSenselessInput)
{
  const cv::Mat image(120, 160, CV_8UC1, cv::Scalar(0));
  const auto refused = [&](auto spoil, const std::string& words) {
    StereoMatchingOptions options;
    spoil(options);
    expectRefused([&] { matchStereo(image, image, options); }, words);
  };
  refused([](auto& o) { o.num_disparities = 0; }, "num_disparities = 0");
  refused([](auto& o) { o.num_disparities = 40; }, "num_disparities = 40");
  refused([](auto& o) { o.num_disparities = 160; }, "160 x 120");
  refused([](auto& o) { o.min_disparity = 100000; }, "min_disparity = 100000");
  refused([](auto& o) { o.block_size = 4; }, "block_size = 4");
  refused([](auto& o) { o.uniqueness = 101; }, "uniqueness = 101");
  refused([](auto& o) { o.speckle_size = -1; }, "speckle_size = -1");
  expectRefused([] { pcl6d::stereoMatcherFromName("best"); }, "matcher = best");
  expectRefused([&] { matchStereo(image, image(cv::Rect(0, 0, 150, 120))); },
                "150 x 120");
  const cv::Mat colour(120, 160, CV_8UC3, cv::Scalar::all(0));
  expectRefused([&] { matchStereo(colour, colour); }, "CV_8UC1");
  const StereoRectification rectification(idealRig());
  expectRefused([&] { stereoCloud(image, image, rectification); }, "disparity = 160");
  StereoCloudOptions options;
  options.sigma_disparity = 0;
  expectRefused([&] { stereoCloud(image, image, rectification, options); },
                "sigma_disparity = 0");
}
