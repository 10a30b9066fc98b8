// SPDX-License-Identifier: BSD-3-Clause
#include "size_limits.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/spinning_lidar.h>

#include <cmath>

namespace pcl6d {
using namespace scanner;

void
SpinningLidarOptions::validate() const
{
  requireScanSize(static_cast<double>(elevations.size()), columns);
  for (const double elevation : elevations)
    require(std::abs(elevation) <= M_PI / 2,
            "elevations",
            elevation,
            "within 90 deg of the horizon");
  require(turn_period > 0 && std::isfinite(turn_period),
          "turn_period",
          turn_period,
          "> 0 and finite");
  require(fire_times.empty() || fire_times.size() == elevations.size(),
          "fire_times",
          fire_times.size(),
          "empty or equal to the number of lines");
  for (const double time : fire_times)
    require(time >= 0 && time * columns < turn_period,
            "fire_times",
            time,
            ">= 0 and within a column's share of the turn");
  require(std::abs(first_azimuth) <= 2 * M_PI,
          "first_azimuth",
          first_azimuth,
          "within a full turn");
}

SpinningLidarOptions
vlp16Lidar()
{
  constexpr double kShot = 2.304e-6; // [s] from one laser to the next
  SpinningLidarOptions options;
  // Lower and upper half fire in turns: -15, 1, -13, 3, ... -1, 15 deg.
  for (int elevation = 15; elevation >= -15; elevation -= 2) {
    options.elevations.push_back(elevation * kDegree);
    options.fire_times.push_back((elevation > 0 ? elevation : elevation + 15) * kShot);
  }
  options.first_azimuth = M_PI; // the seam lies behind
  return options;
}

SpinningLidar::SpinningLidar(const SpinningLidarOptions& options) : options_(options)
{
  options.validate();
  if (options_.fire_times.empty())
    options_.fire_times.assign(options_.elevations.size(), 0);
  for (const double elevation : options_.elevations) {
    const SinCos height = portableSinCos(elevation);
    heights_.emplace_back(height.cos, height.sin);
  }
}

int
SpinningLidar::numLines() const
{
  return static_cast<int>(heights_.size());
}

int
SpinningLidar::samplesPerLine() const
{
  return options_.columns;
}

Ray
SpinningLidar::ray(int line, int sample) const
{
  const double turn = 2 * M_PI * time(line, sample) / options_.turn_period;
  const SinCos azimuth =
      portableSinCos(options_.first_azimuth + (options_.clockwise ? -turn : turn));
  const Eigen::Vector2d& height = heights_[static_cast<std::size_t>(line)];
  return {Eigen::Vector3d::Zero(),
          {height.x() * azimuth.cos, height.x() * azimuth.sin, height.y()}};
}

double
SpinningLidar::time(int line, int sample) const
{
  return options_.turn_period * sample / options_.columns +
         options_.fire_times[static_cast<std::size_t>(line)];
}

double
SpinningLidar::duration() const
{
  return options_.turn_period;
}

} // namespace pcl6d
