// SPDX-License-Identifier: BSD-3-Clause
#include "size_limits.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/rosette_lidar.h>

#include <cmath>
#include <utility>

namespace pcl6d {
using namespace scanner;

namespace {
/** \return the direction at given angles [rad] to the left of straight ahead, and above */
Eigen::Vector3d
deflected(double left, double up)
{
  const double off = std::sqrt(left * left + up * up);
  if (off == 0)
    return Eigen::Vector3d::UnitX();
  const SinCos angle = portableSinCos(off);
  return {angle.cos, angle.sin * left / off, angle.sin * up / off};
}
} // namespace

void
RosetteLidarOptions::validate() const
{
  requireScanSize(lasers, samples);
  for (const auto& [name, rate] :
       {std::pair("first_rate", first_rate), std::pair("second_rate", second_rate)})
    require(std::isfinite(rate) && rate != 0, name, rate, "finite and not 0");
  require(shape == RosetteShape::kBelt || (half_width > 0 && half_width <= M_PI / 2),
          "half_width",
          half_width,
          "in (0, 90 deg]");
  require(lowest >= -M_PI / 2, "lowest", lowest, "within 90 deg of the horizon");
  require(highest > lowest && highest <= M_PI / 2,
          "highest",
          highest,
          "above lowest and within 90 deg of the horizon");
  require(scan_period > 0 && std::isfinite(scan_period),
          "scan_period",
          scan_period,
          "> 0 and finite");
}

RosetteLidar::RosetteLidar(const RosetteLidarOptions& options) : options_(options)
{
  options.validate();
}

int
RosetteLidar::numLines() const
{
  return options_.lasers;
}

int
RosetteLidar::samplesPerLine() const
{
  return options_.samples;
}

Ray
RosetteLidar::ray(int line, int sample) const
{
  const double t = time(line, sample);
  const double phase = 2 * M_PI * line / options_.lasers;
  const SinCos a = portableSinCos(2 * M_PI * options_.first_rate * t + phase);
  const double middle = (options_.highest + options_.lowest) / 2;
  const double half_height = (options_.highest - options_.lowest) / 2;
  if (options_.shape == RosetteShape::kBelt) {
    const SinCos b = portableSinCos(2 * M_PI * options_.second_rate * t);
    const SinCos up = portableSinCos(middle - half_height * b.cos);
    return {Eigen::Vector3d::Zero(), {up.cos * a.cos, up.cos * a.sin, up.sin}};
  }
  const SinCos b = portableSinCos(2 * M_PI * options_.second_rate * t + phase);
  return {Eigen::Vector3d::Zero(),
          deflected(options_.half_width * (a.sin + b.sin) / 2,
                    middle + half_height * (a.cos + b.cos) / 2)};
}

double
RosetteLidar::time(int /*line*/, int sample) const
{
  return options_.scan_period * sample / options_.samples;
}

double
RosetteLidar::duration() const
{
  return options_.scan_period;
}

} // namespace pcl6d
