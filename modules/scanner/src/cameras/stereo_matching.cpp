// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/stereo_matching.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <limits>

namespace pcl6d {
namespace {
constexpr Named<StereoMatcher> kMatchers[] = {{StereoMatcher::kSemiGlobal, "sgbm"},
                                              {StereoMatcher::kBlock, "bm"}};

cv::Ptr<cv::StereoMatcher>
makeMatcher(const StereoMatchingOptions& options)
{
  if (options.matcher == StereoMatcher::kBlock) {
    const auto matcher =
        cv::StereoBM::create(options.num_disparities, options.block_size);
    matcher->setUniquenessRatio(options.uniqueness);
    return matcher;
  }
  // Penalties of disparity steps by one and by more, proposed by OpenCV for grey images.
  const int area = options.block_size * options.block_size;
  const auto matcher = cv::StereoSGBM::create(
      options.min_disparity, options.num_disparities, options.block_size);
  matcher->setP1(8 * area);
  matcher->setP2(32 * area);
  matcher->setUniquenessRatio(options.uniqueness);
  matcher->setPreFilterCap(63);
  matcher->setMode(cv::StereoSGBM::MODE_SGBM); // one thread, little memory
  return matcher;
}

void
requirePair(const cv::Mat& left,
            const cv::Mat& right,
            const StereoMatchingOptions& options)
{
  const auto size = [](const cv::Mat& image) {
    return std::to_string(image.cols) + " x " + std::to_string(image.rows);
  };
  require(left.size() == right.size(),
          "size of the right image",
          size(right),
          "the size of the left image, " + size(left));
  require(left.type() == CV_8UC1 && right.type() == CV_8UC1,
          "type of the images",
          left.type() == CV_8UC1 ? right.type() : left.type(),
          "CV_8UC1 (0)");
  const int widest = options.min_disparity + options.num_disparities;
  require(left.cols > widest && left.cols > options.block_size &&
              left.rows > options.block_size,
          "size of the images",
          size(left),
          "wider than the disparities (" + std::to_string(widest) +
              ") and larger than a block (" + std::to_string(options.block_size) + ")");
}

/** \return disparities in pixels, NaN without a match or with a match outside the right
 * image */
cv::Mat
disparityOf(const cv::Mat& sixteenths, const StereoMatchingOptions& options)
{
  constexpr int kScale = cv::StereoMatcher::DISP_SCALE;
  cv::Mat disparity(sixteenths.size(), CV_32FC1);
  for (int row = 0; row < disparity.rows; ++row)
    for (int col = 0; col < disparity.cols; ++col) {
      const int d = sixteenths.at<short>(row, col);
      const bool valid = d >= kScale * options.min_disparity && d <= kScale * col;
      disparity.at<float>(row, col) = valid ? static_cast<float>(d) / kScale
                                            : std::numeric_limits<float>::quiet_NaN();
    }
  return disparity;
}
} // namespace

void
StereoMatchingOptions::validate() const
{
  constexpr int kMost = 4096;
  require(min_disparity >= -kMost && min_disparity <= kMost,
          "min_disparity",
          min_disparity,
          "in [-4096, 4096]");
  require(num_disparities >= 16 && num_disparities <= kMost &&
              num_disparities % 16 == 0,
          "num_disparities",
          num_disparities,
          "a multiple of 16 in [16, 4096]");
  const bool is_block = matcher == StereoMatcher::kBlock;
  const int smallest = is_block ? 5 : 1, largest = is_block ? 255 : 31;
  require(block_size % 2 == 1 && block_size >= smallest && block_size <= largest,
          "block_size",
          block_size,
          "odd and in [" + std::to_string(smallest) + ", " + std::to_string(largest) +
              "]");
  require(
      uniqueness >= 0 && uniqueness <= 100, "uniqueness", uniqueness, "in [0, 100]");
  require(speckle_size >= 0, "speckle_size", speckle_size, ">= 0");
  require(speckle_step >= 0, "speckle_step", speckle_step, ">= 0");
}

StereoMatcher
stereoMatcherFromName(const std::string& name)
{
  return fromName(kMatchers, "matcher", name, WordList::kOr);
}

std::string
toString(StereoMatcher matcher)
{
  return nameOf(kMatchers, matcher);
}

cv::Mat
matchStereo(const cv::Mat& left,
            const cv::Mat& right,
            const StereoMatchingOptions& options)
{
  options.validate();
  requirePair(left, right, options);
  const auto matcher = makeMatcher(options);
  matcher->setMinDisparity(options.min_disparity);
  matcher->setDisp12MaxDiff(options.max_left_right);
  matcher->setSpeckleWindowSize(options.speckle_size);
  matcher->setSpeckleRange(options.speckle_step);
  // OpenCV leaves out the columns from which the largest disparity would lead out of
  // the right image. Padding with black columns at the left keeps these columns.
  const int margin = std::max(0, options.min_disparity + options.num_disparities);
  const auto padded = [margin](const cv::Mat& image) {
    cv::Mat wide;
    cv::copyMakeBorder(image, wide, 0, 0, margin, 0, cv::BORDER_CONSTANT, 0);
    return wide;
  };
  cv::Mat sixteenths;
  matcher->compute(padded(left), padded(right), sixteenths);
  return disparityOf(sixteenths.colRange(margin, margin + left.cols), options);
}

} // namespace pcl6d
