// SPDX-License-Identifier: BSD-3-Clause
#include "cameras/calibration_file.h"

#include <pcl6d/common/require.h>
#include <pcl6d/scanner/stereo_calibration_file.h>

#include <cmath>

namespace pcl6d {
using namespace scanner;

namespace {
Eigen::Isometry3d
readMotion(const CalibrationFile& file, double unit)
{
  constexpr double kRounding = 1e-3; // tolerance for a rotation typed by hand
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
  calibration.left = lenses.camera("M1", "D1", width, height);
  calibration.right = lenses.camera("M2", "D2", width, height);
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
