// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/scanner/stereo_rectification.h>

#include <sstream>
#include <string>
#include <vector>

namespace pcl6d::test {

/** \return an entry of OpenCV's YAML */
inline std::string
matrixEntry(const std::string& name, int rows, const std::vector<double>& values)
{
  std::ostringstream text;
  text.precision(17);
  text << name << ": !!opencv-matrix\n   rows: " << rows
       << "\n   cols: " << values.size() / static_cast<std::size_t>(rows)
       << "\n   dt: d\n   data: [ ";
  for (std::size_t i = 0; i < values.size(); ++i)
    text << (i > 0 ? ", " : "") << values[i];
  return text.str() + " ]\n";
}

inline std::string
cameraEntries(const std::string& number, const CameraIntrinsics& lens)
{
  const auto& k = lens.k;
  return matrixEntry("M" + number,
                     3,
                     {lens.fx, lens.skew, lens.cx, 0, lens.fy, lens.cy, 0, 0, 1}) +
         matrixEntry("D" + number,
                     1,
                     {k[0], k[1], lens.p[0], lens.p[1], k[2], k[3], k[4], k[5]});
}

inline std::string
intrinsicsText(const StereoCalibration& rig)
{
  return "%YAML:1.0\n---\n" + cameraEntries("1", rig.left) +
         cameraEntries("2", rig.right);
}

inline std::string
motionEntries(const StereoCalibration& rig)
{
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R = rig.T_right_left.linear();
  const Eigen::Vector3d t = rig.T_right_left.translation();
  return matrixEntry("R", 3, {R.data(), R.data() + 9}) +
         matrixEntry("T", 3, {t.data(), t.data() + 3});
}

/** \return a calibration file as OpenCV's sample writes it, in one */
inline std::string
calibrationText(const StereoCalibration& rig)
{
  return intrinsicsText(rig) + motionEntries(rig);
}

} // namespace pcl6d::test
