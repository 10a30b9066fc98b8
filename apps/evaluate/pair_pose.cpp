// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "evaluate/pair_pose.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/text.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <vector>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

Eigen::Isometry3d
poseOfSix(const double* v)
{
  return poseFromEuler({v[0], v[1], v[2]},
                       {radians(v[3]), radians(v[4]), radians(v[5])});
}

/** Reads the rows of a matrix. \throws IoFailed no rigid motion */
Eigen::Isometry3d
poseOfRows(const std::vector<double>& rows, const std::string& file)
{
  using Rows = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.affine() = Eigen::Map<const Rows>(rows.data());
  const bool ends_well = rows.size() == 12 || (rows[12] == 0 && rows[13] == 0 &&
                                               rows[14] == 0 && rows[15] == 1);
  if (!ends_well || !isRigid(pose))
    throw IoFailed(file + ": the numbers are no rigid motion (rows of a rotation and a "
                          "translation)");
  pose.linear() = nearestRotation(pose.linear());
  return pose;
}

/** The pose of a scan in the world of its folder. */
PairPose
poseInFolder(const fs::path& file, const ScanFolder& folder, const std::string& option)
{
  for (std::size_t i = 0; i < folder.size(); ++i)
    if (fs::equivalent(folder.file(i), file))
      return {folder.poseOfFile(i), folder.poseSource(), folder.hasPoses()};
  throw IoFailed(file.string() + ": no scan of the folder; give " + option);
}
} // namespace

Eigen::Isometry3d
poseFromText(const std::string& option, const std::string& text)
{
  std::istringstream stream(text);
  double v[6];
  for (double& value : v)
    if (!(stream >> value) || !std::isfinite(value))
      throw UsageError(
          option + " \"" + text +
          "\": expected six finite numbers, x y z [m] roll pitch yaw [deg]");
  if (!(stream >> std::ws).eof())
    throw UsageError(option + " \"" + text + "\": more than six numbers");
  return poseOfSix(v);
}

Eigen::Isometry3d
poseFromFile(const std::string& file)
{
  std::istringstream content(text::readFile(file));
  std::vector<double> numbers;
  for (std::string word; content >> word;) {
    numbers.emplace_back();
    if (!text::parseNumber(word, numbers.back()) || !std::isfinite(numbers.back()))
      throw IoFailed(file + ": " + text::quoted(word) + " is no finite number");
  }
  if (numbers.size() == 6)
    return poseOfSix(numbers.data());
  if (numbers.size() != 12 && numbers.size() != 16)
    throw IoFailed(
        file + ": " + text::counted(numbers.size(), "number") +
        ", but a pose has 6 (x y z [m] roll pitch yaw [deg]), or the 12 or 16 "
        "of a matrix");
  return poseOfRows(numbers, file);
}

PairPose
poseOfPair(const std::string& scan_a,
           const std::string& scan_b,
           ScanFormat format,
           const std::string& option)
{
  ScanFolderOptions options;
  options.format = format;
  const auto folderOf = [](const std::string& file) {
    return fs::absolute(file).parent_path();
  };
  const ScanFolder folder_a(folderOf(scan_a), options);
  const PairPose a = poseInFolder(scan_a, folder_a, option);
  const bool together = fs::equivalent(folderOf(scan_a), folderOf(scan_b));
  const PairPose b =
      together ? poseInFolder(scan_b, folder_a, option)
               : poseInFolder(scan_b, ScanFolder(folderOf(scan_b), options), option);
  if (a.source != b.source)
    throw IoFailed("the poses of the scans are not of a kind: " + a.source + " for " +
                   scan_a + ", " + b.source + " for " + scan_b + "; give " + option);
  return {a.T_a_b.inverse() * b.T_a_b, a.source, a.found};
}

} // namespace pcl6d::app
