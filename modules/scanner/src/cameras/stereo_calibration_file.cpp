// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/stereo_calibration_file.h>

#include <opencv2/core.hpp>

#include <cmath>
#include <fstream>
#include <iterator>

namespace pcl6d {
namespace {
/** \brief A file of named matrices, as OpenCV writes it. */
class CalibrationFile {
public:
  explicit CalibrationFile(const std::filesystem::path& path) : path_(path)
  {
    std::ifstream stream(path, std::ios::binary);
    if (!stream || std::filesystem::is_directory(path))
      fail("cannot be read");
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    try {
      storage_.open(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    } catch (const std::exception&) { // not only OpenCV's: some texts trip its parser
      fail("is no YAML, XML or JSON of OpenCV");
    }
    if (!storage_.isOpened() || !(storage_.root().isMap() || storage_.root().empty()))
      fail("is no YAML, XML or JSON of OpenCV");
  }

  [[noreturn]] void
  fail(const std::string& message) const
  {
    throw IoFailed(path_.string() + ": " + message);
  }

  /** \throws IoFailed naming all of the entries that are missing */
  void
  requireEntries(const std::vector<std::string>& names) const
  {
    std::string missing;
    for (const auto& name : names)
      if (storage_[name].empty())
        missing += (missing.empty() ? "" : ", ") + name;
    if (!missing.empty())
      fail("has no entry " + missing);
  }

  /** \return the values of a matrix, row by row, all finite */
  std::vector<double>
  values(const std::string& name) const
  {
    cv::Mat matrix;
    try {
      storage_[name] >> matrix;
      matrix.convertTo(matrix, CV_64F);
    } catch (const cv::Exception&) {
      matrix.release();
    }
    if (matrix.empty() || matrix.channels() != 1)
      fail("entry " + name + " is no matrix of numbers");
    std::vector<double> all(matrix.begin<double>(), matrix.end<double>());
    for (const double value : all)
      if (!std::isfinite(value))
        fail("entry " + name + " holds a value that is not finite");
    return all;
  }

  std::vector<double>
  values(const std::string& name, std::size_t count) const
  {
    const auto all = values(name);
    if (all.size() != count)
      fail("entry " + name + " has " + std::to_string(all.size()) +
           " values, but must have " + std::to_string(count));
    return all;
  }

  Eigen::Matrix3d
  matrix3(const std::string& name) const
  {
    const auto all = values(name, 9);
    return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(all.data());
  }

  void
  requireSize(const std::string& name, int expected) const
  {
    const cv::FileNode node = storage_[name];
    if (!node.empty() && static_cast<double>(node) != expected)
      fail("entry " + name + " is " + std::to_string(static_cast<int>(node)) +
           ", but the images have " + std::to_string(expected));
  }

private:
  std::filesystem::path path_;
  cv::FileStorage storage_;
};

/** OpenCV's order: k1 k2 p1 p2, k3, k4 k5 k6, s1 s2 s3 s4, tau_x tau_y. */
void
readDistortion(const CalibrationFile& file,
               const std::string& name,
               CameraIntrinsics& lens)
{
  constexpr std::size_t kRational = 8, kAll = 14;
  std::vector<double> d = file.values(name);
  const std::size_t n = d.size();
  if (n != 4 && n != 5 && n != 8 && n != 12 && n != 14)
    file.fail("entry " + name + " has " + std::to_string(n) +
              " values, but must have 4, 5, 8, 12 or 14");
  d.resize(kAll, 0);
  for (std::size_t i = kRational; i < kAll; ++i)
    if (d[i] != 0)
      file.fail("entry " + name +
                " has a coefficient of a thin prism or a tilted "
                "sensor, which is not supported");
  lens.k = {d[0], d[1], d[4], d[5], d[6], d[7]};
  lens.p = {d[2], d[3]};
}

CameraIntrinsics
readCamera(const CalibrationFile& file,
           const std::string& number,
           int width,
           int height)
{
  const Eigen::Matrix3d K = file.matrix3("M" + number);
  CameraIntrinsics lens;
  lens.width = width;
  lens.height = height;
  lens.fx = K(0, 0);
  lens.skew = K(0, 1);
  lens.cx = K(0, 2);
  lens.fy = K(1, 1);
  lens.cy = K(1, 2);
  if (K(1, 0) != 0 || K.row(2) != Eigen::RowVector3d::UnitZ())
    file.fail("entry M" + number + " is no camera matrix [fx s cx; 0 fy cy; 0 0 1]");
  readDistortion(file, "D" + number, lens);
  try {
    lens.validate();
  } catch (const BadArgument& e) {
    file.fail("camera " + number + ": " + e.what());
  }
  return lens;
}

Eigen::Isometry3d
readMotion(const CalibrationFile& file, double unit)
{
  constexpr double kRounding = 1e-3; // of a rotation that a person has typed
  const Eigen::Matrix3d R = file.matrix3("R");
  const auto T = file.values("T", 3);
  const double error = (R * R.transpose() - Eigen::Matrix3d::Identity()).norm();
  if (!(error <= kRounding && R.determinant() > 0))
    file.fail("entry R is no rotation");
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = Eigen::Quaterniond(R).normalized().toRotationMatrix();
  motion.translation() = unit * Eigen::Vector3d(T[0], T[1], T[2]);
  return motion;
}
} // namespace

StereoCalibration
readStereoCalibration(const StereoCalibrationSource& source, int width, int height)
{
  require(source.unit > 0 && std::isfinite(source.unit), "unit", source.unit, "> 0");
  const CalibrationFile lenses(source.intrinsics);
  const bool in_one = source.extrinsics.empty();
  std::vector<std::string> needed = {"M1", "D1", "M2", "D2"};
  if (in_one)
    needed.insert(needed.end(), {"R", "T"});
  lenses.requireEntries(needed);
  lenses.requireSize("image_width", width);
  lenses.requireSize("image_height", height);

  StereoCalibration calibration;
  calibration.left = readCamera(lenses, "1", width, height);
  calibration.right = readCamera(lenses, "2", width, height);
  const CalibrationFile motion(in_one ? source.intrinsics : source.extrinsics);
  motion.requireEntries({"R", "T"});
  calibration.T_right_left = readMotion(motion, source.unit);
  try {
    calibration.validate();
  } catch (const BadArgument& e) {
    motion.fail(e.what());
  }
  return calibration;
}

} // namespace pcl6d
