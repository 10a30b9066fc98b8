// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "convert/verbs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/scan_writer.h>
#include <pcl6d/scanner/image_files.h>
#include <pcl6d/scanner/stereo_calibration_file.h>
#include <pcl6d/scanner/stereo_cloud.h>

#include <opencv2/core.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace pcl6d::app {

namespace {

struct StereoSettings {
  std::string left, right, output;
  std::string intrinsics, extrinsics;
  double unit = StereoCalibrationSource().unit;
  StereoMatchingOptions matching;
  StereoCloudOptions cloud;
  bool organized = false;
};

void
addOptions(OptionTable& table, StereoSettings& s)
{
  table.positional("LEFT", &s.left);
  table.positional("RIGHT", &s.right);
  table.positional("CALIB", &s.intrinsics);
  table.group("Output");
  table.add("output,o FILE", &s.output).required().help("scan file");
  table.add("organized", &s.organized)
      .help("a point per pixel of the rectified left image, NaN without a measurement");
  table.group("Calibration");
  table.add("extrinsics FILE", &s.extrinsics).help("holds R and T, if CALIB does not");
  table.add("unit M", &s.unit).help("[m] length of a unit of T");
  table.group("Matching");
  table.add("matcher NAME", &s.matching.matcher, stereoMatcherFromName)
      .help("sgbm|bm: dense, or fast");
  table.add("min-disparity D", &s.matching.min_disparity)
      .help("[px] of the farthest point; 0: at infinity");
  table.add("disparities N", &s.matching.num_disparities)
      .help("[px] a multiple of 16; more see nearer");
  table.add("block-size N", &s.matching.block_size).help("[px] odd");
  table.add("uniqueness P", &s.matching.uniqueness)
      .help("[%] by which the best match beats the second");
  table.group("Points");
  table.add("max-depth M", &s.cloud.max_depth).help("[m]");
  table.add("sigma PX", &s.cloud.sigma_disparity)
      .help("[px] standard deviation of a disparity, for the depth error");
}

bool
parse(const std::vector<std::string>& arguments, StereoSettings& s)
{
  OptionTable table(std::string("usage: ") + kConvert +
                    R"( stereo LEFT RIGHT CALIB -o FILE [options]
Triangulates the pictures of two cameras. CALIB: YAML, XML or JSON of OpenCV
with M1 D1 M2 D2 R T, as its sample stereo_calib writes (in two files:
--extrinsics). The points are in the left camera's place, x forward, y left, z
up; fields x y z, intensity (0 to 1), depth_error (its standard deviation [m]).
)");
  addOptions(table, s);
  if (!table.parse(arguments))
    return false;
  table.check(
      [&] {
        s.matching.validate();
        s.cloud.validate();
        if (!(s.unit > 0 && std::isfinite(s.unit)))
          throw BadArgument("unit = " + std::to_string(s.unit) + ", but must be > 0");
      },
      {{"num_disparities", "disparities"}, {"sigma_disparity", "sigma"}});
  refuseInputs(s.output, {s.left, s.right, s.intrinsics, s.extrinsics});
  return true;
}

/** \return a cloud with fields x, y, z, intensity, depth_error */
pcl::PCLPointCloud2
withDepthError(const StereoCloud& stereo, bool organized)
{
  using Row = std::array<float, 5>;
  pcl::PCLPointCloud2 cloud;
  const std::array<const char*, 5> names = {"x", "y", "z", "intensity", "depth_error"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    pcl::PCLPointField field;
    field.name = names[i];
    field.offset = static_cast<pcl::uindex_t>(i * sizeof(float));
    field.datatype = pcl::PCLPointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
  }
  std::vector<Row> rows;
  for (std::size_t i = 0; i < stereo.cloud.size(); ++i) {
    const auto& p = stereo.cloud[i];
    if (organized || std::isfinite(p.x))
      rows.push_back({p.x, p.y, p.z, p.intensity, stereo.depth_error[i]});
  }
  cloud.point_step = sizeof(Row);
  cloud.height = organized ? stereo.cloud.height : 1;
  cloud.width = static_cast<pcl::uindex_t>(rows.size()) / cloud.height;
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.is_dense = !organized;
  cloud.data.resize(rows.size() * sizeof(Row));
  if (!rows.empty())
    std::memcpy(cloud.data.data(), rows.data(), cloud.data.size());
  return cloud;
}

void
printResult(const StereoRectification& rectification, std::vector<float> errors)
{
  const std::size_t num_pixels = errors.size();
  errors.erase(std::remove_if(
                   errors.begin(), errors.end(), [](float e) { return std::isnan(e); }),
               errors.end());
  std::printf("baseline %.6g m, focal length %.6g px\n",
              rectification.baseline(),
              rectification.intrinsics().fx);
  std::printf("points %zu of %zu pixels\n", errors.size(), num_pixels);
  if (!errors.empty()) {
    const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
    std::nth_element(errors.begin(), middle, errors.end());
    std::printf("depth error %.4g m (median)\n", double{*middle});
  }
}
} // namespace

int
runStereo(const std::vector<std::string>& arguments)
{
  StereoSettings s;
  if (!parse(arguments, s))
    return kDone;
  const cv::Mat left = readGrayImage(s.left), right = readGrayImage(s.right);
  const auto size = [](const cv::Mat& image) {
    return std::to_string(image.cols) + " x " + std::to_string(image.rows) + " pixels";
  };
  if (left.size() != right.size())
    throw IoFailed(s.right + ": has " + size(right) + ", but " + s.left + " has " +
                   size(left));
  const StereoRectification rectification(readStereoCalibration(
      {s.intrinsics, s.extrinsics, s.unit}, left.cols, left.rows));
  const cv::Mat gray = rectification.rectifyLeft(left);
  const cv::Mat disparity =
      matchStereo(gray, rectification.rectifyRight(right), s.matching);
  const StereoCloud stereo = stereoCloud(disparity, gray, rectification, s.cloud);
  if (std::all_of(stereo.depth_error.begin(), stereo.depth_error.end(), [](float e) {
        return std::isnan(e);
      }))
    throw ComputeFailed("no pixel of " + s.left + " has a match in " + s.right);
  const auto lost = writeScan(s.output, withDepthError(stereo, s.organized));
  printResult(rectification, stereo.depth_error);
  for (const auto& what : lost)
    std::printf("%s\n", what.c_str());
  flushOutput();
  return kDone;
}

} // namespace pcl6d::app
