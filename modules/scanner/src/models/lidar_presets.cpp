// SPDX-License-Identifier: BSD-3-Clause
#include "lidar_presets.h"
#include "size_limits.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/scanner/rosette_lidar.h>
#include <pcl6d/scanner/spinning_lidar.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace pcl6d::scanner {

namespace {
/** Spinning lidars with simultaneous lasers of a column. */
ScannerPreset
spinning(const std::vector<double>& elevations,
         int columns,
         const Resolution& resolution,
         const RangeOptions& range)
{
  SpinningLidarOptions options;
  options.elevations = elevations;
  options.columns = columns;
  if (resolution) {
    const double finer = std::max(1.0, std::round(2 * M_PI / *resolution));
    requireScanSize(static_cast<double>(elevations.size()), finer);
    options.columns = static_cast<int>(finer);
  }
  return {"", "", std::make_shared<SpinningLidar>(options), range};
}

/** \return elevations [rad], evenly from some degrees above the horizon to equally far below */
std::vector<double>
evenLines(double highest, int count)
{
  const AngleRange lines = {highest * kDegree, -highest * kDegree, count};
  std::vector<double> elevations(static_cast<std::size_t>(lines.count));
  for (int i = 0; i < lines.count; ++i)
    elevations[static_cast<std::size_t>(i)] = lines.angle(i);
  return elevations;
}

/** Adds lines down to an elevation, with a constant step [deg]. */
void
addLines(double last, double step, std::vector<double>& elevations)
{
  const double first = elevations.back() / kDegree;
  const long count = std::lround((first - last) / step);
  for (long i = 1; i <= count; ++i)
    elevations.push_back((first - static_cast<double>(i) * step) * kDegree);
}

RangeOptions
lidarRange(double noise, double least, double most)
{
  RangeOptions range;
  range.noise = noise;
  range.min_range = least;
  range.max_range = most;
  range.quantum = 0.002;
  range.signal_range = 1.5 * most;
  range.beam = {0.01, 3e-3, 7, 1.0};
  return range;
}
} // namespace

ScannerPreset
vlp16(const Resolution& resolution)
{
  SpinningLidarOptions options = vlp16Lidar();
  if (resolution) {
    const double columns = std::max(1.0, std::round(2 * M_PI / *resolution));
    requireScanSize(static_cast<double>(options.elevations.size()), columns);
    options.columns = static_cast<int>(columns);
    // With many columns the turn takes longer: the lasers keep their pace.
    options.turn_period = std::max(options.turn_period, columns * 16 * 2.304e-6);
  }
  return {"", "", std::make_shared<SpinningLidar>(options), lidarRange(0.01, 0.5, 100)};
}

// Ouster OS1 with 64 lines; their spacing is even.
ScannerPreset
ouster(const Resolution& resolution)
{
  RangeOptions range = lidarRange(0.01, 0.5, 100);
  range.quantum = 0.003;
  range.beam.exit_diameter = 0.0095;
  return spinning(evenLines(22.5, 64), 1024, resolution, range);
}

// Ouster OS0-128, data sheet of revision 7: 90 deg, 128 lines, 0.3 to 50 m, +-1.5 cm near.
ScannerPreset
os0(const Resolution& resolution)
{
  return spinning(evenLines(45, 128), 1024, resolution, lidarRange(0.015, 0.3, 50));
}

// Velodyne HDL-32E, data sheet 97-0038: 10.67 to -30.67 deg in 32 lines, +-2 cm, 100 m; 2170
// columns at 10 Hz.
ScannerPreset
hdl32(const Resolution& resolution)
{
  std::vector<double> elevations = {10.67 * kDegree};
  addLines(-30.67, 41.34 / 31, elevations);
  return spinning(elevations, 2170, resolution, lidarRange(0.02, 1, 100));
}

// Velodyne HDL-64E S3, manual 63-HDL64ES3: 32 lines from 2 to -8.33 deg, a third of a degree
// apart, 32 from -8.83 to -24.33, half a degree apart; 2 cm, 120 m; 0.1728 deg at 10 Hz.
ScannerPreset
hdl64(const Resolution& resolution)
{
  std::vector<double> elevations = {2 * kDegree};
  addLines(2 - 31.0 / 3, 1.0 / 3, elevations);
  addLines(-24.33, 0.5, elevations);
  return spinning(elevations, 2083, resolution, lidarRange(0.02, 0.9, 120));
}

// Hesai Pandar64, user manual: 15 to -25 deg, a sixth of a degree apart from 2 to -6 deg and
// wider outside; 2 cm, 200 m; 0.2 deg at 10 Hz.
ScannerPreset
pandar(const Resolution& resolution)
{
  std::vector<double> elevations = {15 * kDegree};
  addLines(11, 4, elevations);
  addLines(8, 3, elevations);
  addLines(5, 3, elevations);
  addLines(3, 2, elevations);
  addLines(2, 1, elevations);
  addLines(-6, 1.0 / 6, elevations);
  addLines(-14, 1, elevations);
  addLines(-19, 5, elevations);
  addLines(-25, 6, elevations);
  return spinning(elevations, 1800, resolution, lidarRange(0.02, 0.3, 200));
}

namespace {
/** \return solid angle of a rosette [sr] */
double
solidAngleOf(const RosetteLidarOptions& options)
{
  if (options.shape == RosetteShape::kBelt)
    return 2 * M_PI *
           (portableSinCos(options.highest).sin - portableSinCos(options.lowest).sin);
  return M_PI * options.half_width * (options.highest - options.lowest) / 2;
}

/** A rosette, whose resolution is the root of the mean area per point. */
ScannerPreset
rosette(RosetteLidarOptions options,
        const Resolution& resolution,
        const RangeOptions& range)
{
  if (resolution) {
    const double points = solidAngleOf(options) / (*resolution * *resolution);
    const double samples = std::max(1.0, std::round(points / options.lasers));
    requireScanSize(options.lasers, samples);
    // Lasers keep their pace.
    options.scan_period *= std::max(1.0, samples / options.samples);
    options.samples = static_cast<int>(samples);
  }
  return {"", "", std::make_shared<RosetteLidar>(options), range};
}
} // namespace

// Livox Avia, user manual 1.2: 70.4 x 77.2 deg, 240 000 points/s by six lasers, 2 cm at 20 m,
// 190 m at 10 %; taken in scans of 0.1 s.
ScannerPreset
avia(const Resolution& resolution)
{
  RosetteLidarOptions options;
  options.half_width = 35.2 * kDegree;
  options.lowest = -38.6 * kDegree;
  options.highest = 38.6 * kDegree;
  options.lasers = 6;
  options.samples = 4000;
  return rosette(options, resolution, lidarRange(0.02, 1, 190));
}

// Livox Mid-360, user manual 1.2: 360 deg, -7 to 52 deg, 200 000 points/s by four
// lasers, 2 cm at 10 m, from 0.1 to 40 m at 10 %; taken in scans of 0.1 s. The manual
// gives no rates: with the rates used here, the distance of the curves is about the
// distance of their points.
ScannerPreset
mid360(const Resolution& resolution)
{
  RosetteLidarOptions options;
  options.shape = RosetteShape::kBelt;
  options.first_rate = 13.1;
  options.second_rate = 401.3;
  options.lowest = -7 * kDegree;
  options.highest = 52 * kDegree;
  options.lasers = 4;
  options.samples = 5000;
  return rosette(options, resolution, lidarRange(0.02, 0.1, 40));
}

} // namespace pcl6d::scanner
