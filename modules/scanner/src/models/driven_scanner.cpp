// SPDX-License-Identifier: BSD-3-Clause
#include "size_limits.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/median.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/driven_scanner.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using namespace scanner;

namespace {
constexpr double kLargestDriveAngle = 200 * M_PI; // [rad] counters may run on

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

std::vector<double>
driveAngles(const DrivenScannerOptions& options)
{
  options.validate(); // first: the count may be absurd
  std::vector<double> angles;
  for (int line = 0; line < options.theta.count; ++line)
    angles.push_back(options.theta.angle(line));
  return angles;
}

// Difference from value i to the next value; the last value repeats the difference before.
double
stepFrom(const std::vector<double>& values, std::size_t i)
{
  const std::size_t from = std::min(i, values.size() - 2);
  return values[from + 1] - values[from];
}

std::vector<double>
startTimes(const DrivenScannerOptions& options,
           const std::vector<double>& theta,
           const std::vector<double>& times)
{
  std::vector<double> starts;
  if (times.empty())
    for (std::size_t i = 0; i < theta.size(); ++i)
      starts.push_back(static_cast<double>(i) * options.line_period);
  for (const double time : times) {
    const double start = time - times.front();
    require(std::isfinite(start) && (starts.empty() || start > starts.back()),
            "times",
            time,
            "finite and increasing");
    starts.push_back(start);
  }
  require(starts.size() == theta.size(), "times", starts.size(), "one per drive angle");
  return starts;
}

// [s] Median period of a line, as measured times jitter.
double
linePeriod(const DrivenScannerOptions& options, const std::vector<double>& starts)
{
  std::vector<double> periods;
  for (std::size_t i = 0; i + 1 < starts.size(); ++i)
    periods.push_back(starts[i + 1] - starts[i]);
  return periods.empty() ? options.line_period : upperMedian(std::move(periods));
}

double
samplePeriod(const DrivenScannerOptions& options, double line_period)
{
  const double share = std::min(std::abs(options.beam.step()) / (2 * M_PI),
                                1.0 / options.beam.count); // of the mirror's turn
  return options.sample_period.value_or(share * line_period);
}
} // namespace

void
DrivenScannerOptions::validate() const
{
  validateAngles(beam, "beam");
  validateAngles(theta, "theta");
  requireScanSize(theta.count, beam.count);
  Eigen::Isometry3d mount = Eigen::Isometry3d::Identity();
  mount.linear() = mounting;
  require(isRigid(mount, 1e-9), "mounting", mounting, "a rotation");
  require(lever_arm.allFinite(), "lever_arm", lever_arm.transpose(), "finite");
  require(
      axis_position.allFinite(), "axis_position", axis_position.transpose(), "finite");
  require(line_period > 0 && std::isfinite(line_period),
          "line_period",
          line_period,
          "> 0 and finite");
  if (sample_period)
    require(*sample_period >= 0 && *sample_period * beam.count <= line_period,
            "sample_period",
            *sample_period,
            ">= 0, and the samples of a line must fit into the period");
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
: DrivenScanner(options, driveAngles(options))
{}

DrivenScanner::DrivenScanner(const DrivenScannerOptions& options,
                             const std::vector<double>& theta,
                             const std::vector<double>& times)
: drive_(options.drive)
, lever_arm_(options.lever_arm)
, axis_position_(options.axis_position)
{
  options.validate();
  require(
      !theta.empty(), "drive angles", theta.size(), "at least 1: an angle per line");
  requireScanSize(static_cast<double>(theta.size()), options.beam.count);
  const std::vector<double> starts = startTimes(options, theta, times);
  sample_period_ = samplePeriod(options, linePeriod(options, starts));
  addLines(options, theta, starts);
  for (int sample = 0; sample < options.beam.count; ++sample) {
    const SinCos mirror = portableSinCos(options.beam.angle(sample));
    mirrored_.emplace_back(options.mounting *
                           Eigen::Vector3d(mirror.cos, mirror.sin, 0));
  }
}

void
DrivenScanner::addLines(const DrivenScannerOptions& options,
                        const std::vector<double>& theta,
                        const std::vector<double>& starts)
{
  const bool is_single = theta.size() == 1;
  const bool turns_on = options.motion == DriveMotion::kContinuous && !is_single;
  for (std::size_t i = 0; i < theta.size(); ++i) {
    require(std::abs(theta[i]) <= kLargestDriveAngle,
            ("drive angle " + std::to_string(i)).c_str(),
            theta[i],
            "finite and within 100 full turns");
    lines_.push_back({theta[i],
                      turns_on ? stepFrom(theta, i) : 0,
                      starts[i],
                      is_single ? options.line_period : stepFrom(starts, i),
                      driveRotation(drive_, theta[i])});
  }
}

int
DrivenScanner::numLines() const
{
  return static_cast<int>(lines_.size());
}

int
DrivenScanner::samplesPerLine() const
{
  return static_cast<int>(mirrored_.size());
}

Ray
DrivenScanner::ray(int line, int sample) const
{
  const Line& at = lines_[static_cast<std::size_t>(line)];
  const Eigen::Vector3d& beam = mirrored_[static_cast<std::size_t>(sample)];
  if (at.turn == 0)
    return {axis_position_ + at.R_drive * lever_arm_, at.R_drive * beam};
  const double passed = sample * sample_period_ / at.period; // share of the line
  const Eigen::Matrix3d R = driveRotation(drive_, at.theta + passed * at.turn);
  return {axis_position_ + R * lever_arm_, R * beam};
}

double
DrivenScanner::time(int line, int sample) const
{
  return lines_[static_cast<std::size_t>(line)].start + sample * sample_period_;
}

double
DrivenScanner::duration() const
{
  return lines_.back().start +
         std::max(lines_.back().period, samplesPerLine() * sample_period_);
}

} // namespace pcl6d
