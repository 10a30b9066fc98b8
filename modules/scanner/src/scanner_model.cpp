// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/scanner_model.h>

#include <cmath>

namespace pcl6d {
namespace {
constexpr double kDegree = M_PI / 180;

Eigen::Matrix3d
driveRotation(Drive drive, double theta)
{
  const auto [s, c] = portableSinCos(theta);
  Eigen::Matrix3d R;
  switch (drive) {
  case Drive::kPitching: // Ry(-theta)
    R << c, 0, -s, 0, 1, 0, s, 0, c;
    break;
  case Drive::kRolling: // Rx(theta)
    R << 1, 0, 0, 0, c, -s, 0, s, c;
    break;
  case Drive::kYawing: // Rz(theta)
    R << c, -s, 0, s, c, 0, 0, 0, 1;
    break;
  }
  return R;
}

void
validateAngles(const AngleRange& range, const std::string& name)
{
  constexpr double kLargest = 2 * M_PI;
  constexpr int kMostAngles = 100000;
  const char* const rule = "finite and within a full turn";
  require(
      std::abs(range.first) <= kLargest, (name + ".first").c_str(), range.first, rule);
  require(std::abs(range.last) <= kLargest, (name + ".last").c_str(), range.last, rule);
  require(range.count >= 1 && range.count <= kMostAngles,
          (name + ".count").c_str(),
          range.count,
          "in [1, 100000]");
}
} // namespace

void
DrivenScannerOptions::validate() const
{
  validateAngles(beam, "beam");
  validateAngles(theta, "theta");
  Eigen::Isometry3d mount = Eigen::Isometry3d::Identity();
  mount.linear() = mounting;
  require(isRigid(mount, 1e-9), "mounting", mounting, "a rotation");
  require(lever_arm.allFinite(), "lever_arm", lever_arm.transpose(), "finite");
  require(
      axis_position.allFinite(), "axis_position", axis_position.transpose(), "finite");
}

DrivenScannerOptions
rotatingScanner()
{
  constexpr int kLines = 360;
  DrivenScannerOptions options;
  options.drive = Drive::kYawing;
  options.beam = {-60 * kDegree, 60 * kDegree, 121};
  options.theta = {-M_PI, M_PI - 2 * M_PI / kLines, kLines};
  options.mounting << 1, 0, 0, 0, 0, -1, 0, 1, 0; // Rx(pi/2): the fan stands upright
  return options;
}

DrivenScannerOptions
pitchingScanner()
{
  DrivenScannerOptions options;
  options.drive = Drive::kPitching;
  options.beam = {-90 * kDegree, 90 * kDegree, 181};
  options.theta = {-60 * kDegree, 60 * kDegree, 241};
  return options;
}

DrivenScanner::DrivenScanner(const DrivenScannerOptions& options)
: lever_arm_(options.lever_arm), axis_position_(options.axis_position)
{
  options.validate();
  for (int line = 0; line < options.theta.count; ++line)
    drive_.push_back(driveRotation(options.drive, options.theta.angle(line)));
  for (int sample = 0; sample < options.beam.count; ++sample) {
    const SinCos mirror = portableSinCos(options.beam.angle(sample));
    mirrored_.emplace_back(options.mounting *
                           Eigen::Vector3d(mirror.cos, mirror.sin, 0));
  }
}

int
DrivenScanner::numLines() const
{
  return static_cast<int>(drive_.size());
}

int
DrivenScanner::samplesPerLine() const
{
  return static_cast<int>(mirrored_.size());
}

Ray
DrivenScanner::ray(int line, int sample) const
{
  const Eigen::Matrix3d& R = drive_[static_cast<std::size_t>(line)];
  return {axis_position_ + R * lever_arm_,
          R * mirrored_[static_cast<std::size_t>(sample)]};
}

} // namespace pcl6d
