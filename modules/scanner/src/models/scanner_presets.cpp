// SPDX-License-Identifier: BSD-3-Clause
#include "lidar_presets.h"
#include "size_limits.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/driven_scanner.h>
#include <pcl6d/scanner/measurement_principles.h>
#include <pcl6d/scanner/projection_scanner.h>
#include <pcl6d/scanner/scanner_presets.h>
#include <pcl6d/scanner/tof_camera.h>

#include <cmath>

namespace pcl6d {
using namespace scanner;

namespace {
struct Entry {
  const char* name;
  const char* description;
  ScannerPreset (*make)(const Resolution& resolution);
};

// [rad] Turned about the horizontal by 90 deg, a 2D scanner's fan stands upright.
Eigen::Matrix3d
upright()
{
  return rotatingScanner().mounting;
}

// Full turns leave out the last angle, which equals the first.
enum class Ends { kBoth, kFullTurn };

double
countOf(const AngleRange& range, double resolution, Ends ends)
{
  const double span = std::abs(range.last - range.first) +
                      (ends == Ends::kFullTurn ? std::abs(range.step()) : 0);
  return std::max(1.0, std::round(span / resolution) + (ends == Ends::kBoth ? 1 : 0));
}

AngleRange
refined(const AngleRange& range, double count, Ends ends)
{
  if (ends == Ends::kBoth)
    return {range.first, range.last, static_cast<int>(count)};
  const double end = range.last + range.step();
  return {range.first, end - (end - range.first) / count, static_cast<int>(count)};
}

// Other resolution, same solid.
ScannerPreset
driven(DrivenScannerOptions options,
       const Resolution& resolution,
       Ends ends,
       const RangeOptions& range = {})
{
  if (resolution) {
    const double samples = countOf(options.beam, *resolution, Ends::kBoth);
    const double lines =
        options.theta.count > 1 ? countOf(options.theta, *resolution, ends) : 1;
    requireScanSize(lines, samples); // before the counts become whole numbers
    options.beam = refined(options.beam, samples, Ends::kBoth);
    if (options.theta.count > 1)
      options.theta = refined(options.theta, lines, ends);
  }
  return {"", "", std::make_shared<DrivenScanner>(options), range};
}

CameraIntrinsics
cameraOf(int width, int height, double focal_length, const Resolution& resolution)
{
  const double scale = resolution ? 1 / *resolution / focal_length : 1;
  const double cols = std::max(1.0, std::round(width * scale));
  const double rows = std::max(1.0, std::round(height * scale));
  requireScanSize(rows, cols);
  CameraIntrinsics camera;
  camera.width = static_cast<int>(cols);
  camera.height = static_cast<int>(rows);
  camera.fx = camera.fy = focal_length * scale;
  camera.cx = (cols - 1) / 2;
  camera.cy = (rows - 1) / 2;
  return camera;
}

// SICK LMS 200 in millimetre mode.
RangeOptions
sickRange()
{
  RangeOptions range;
  range.noise = 0.005;
  range.min_range = 0.1;
  range.max_range = 32.7;
  range.quantum = 0.001;
  range.beam = {0.01, 0.25 * kDegree, 7, 0.5};
  return range;
}

ScannerPreset
rangefinder(const Resolution&)
{
  DrivenScannerOptions options;
  options.line_period = 0.1;
  RangeOptions range;
  range.noise = 0.0015;
  range.min_range = 0.05;
  range.max_range = 60;
  range.quantum = 0.001;
  range.beam = {0.006, 0.6e-3, 7, 0.3};
  return {"", "", std::make_shared<DrivenScanner>(options), range};
}

ScannerPreset
sick(const Resolution& resolution)
{
  DrivenScannerOptions options;
  options.beam = {-90 * kDegree, 90 * kDegree, 181};
  return driven(options, resolution, Ends::kBoth, sickRange());
}

ScannerPreset
pitching(const Resolution& resolution)
{
  return driven(pitchingScanner(), resolution, Ends::kBoth);
}

ScannerPreset
rotating(const Resolution& resolution)
{
  return driven(rotatingScanner(), resolution, Ends::kFullTurn);
}

ScannerPreset
rolling(const Resolution& resolution)
{
  DrivenScannerOptions options;
  options.drive = Drive::kRolling;
  options.beam = {-90 * kDegree, 90 * kDegree, 181};
  options.theta = {0, 179 * kDegree, 180};
  return driven(options, resolution, Ends::kFullTurn, sickRange());
}

// Two 2D scanners back to back, modelled as one with twice their line rate.
ScannerPreset
scandrive(const Resolution& resolution)
{
  DrivenScannerOptions options;
  options.drive = Drive::kYawing;
  options.motion = DriveMotion::kContinuous;
  options.mounting = upright();
  options.beam = {-90 * kDegree, 90 * kDegree, 181};
  options.theta = {-180 * kDegree, 178 * kDegree, 180};
  options.line_period = 1.2 / 180;
  return driven(options, resolution, Ends::kFullTurn, sickRange());
}

// The mirror covers everything but a cone below; half a turn of the head is enough.
ScannerPreset
terrestrial(const Resolution& resolution)
{
  DrivenScannerOptions options;
  options.drive = Drive::kYawing;
  options.motion = DriveMotion::kContinuous;
  options.mounting = upright();
  options.beam = {-60 * kDegree, 240 * kDegree, 1201};
  options.theta = {0, 179.75 * kDegree, 720};
  options.line_period = 1.0 / 50;
  RangeOptions range;
  range.noise = 0.001;
  range.noise_per_range = 1e-5;
  range.signal_noise = 0.001;
  range.incidence_noise = 0.0005;
  range.min_range = 0.6;
  range.max_range = 130;
  range.quantum = 1e-4;
  range.signal_range = 250;
  range.beam = {0.003, 0.3e-3, 7, 0.3};
  return driven(options, resolution, Ends::kFullTurn, range);
}

// Kinect of the first kind: 57 x 43 deg; K. Khoshelham, S. Oude Elberink, "Accuracy and
// resolution of Kinect depth data", Sensors 12, 2012: random error 1.425 mm at 1 m, growing
// with the square of the range.
ScannerPreset
rgbd(const Resolution& resolution)
{
  const CameraIntrinsics camera = cameraOf(640, 480, 585, resolution);
  RangeOptions range;
  range.noise = 1e-4;
  range.noise_per_range_sq = 1.425e-3;
  range.min_range = 0.5;
  range.max_range = 5;
  const auto shutter = std::make_shared<TofCamera>(camera, 10e6, 1.0 / 30);
  range.beam.divergence = 1 / camera.fx;
  return {"", "", shutter, range};
}

// Hand-held GeoSLAM ZEB Revo: a Hokuyo UTM-30LX-F (270 deg, 0.25 deg, 40 lines/s, up to
// 3 cm at 30 m) turning about its axis every 2 s; half a turn covers every direction.
ScannerPreset
zeb(const Resolution& resolution)
{
  DrivenScannerOptions options;
  options.drive = Drive::kRolling;
  options.motion = DriveMotion::kContinuous;
  options.beam = {-135 * kDegree, 135 * kDegree, 1081};
  options.theta = {0, 175.5 * kDegree, 40};
  options.line_period = 1.0 / 40;
  RangeOptions range;
  range.noise = 0.01;
  range.noise_per_range = 5e-4;
  range.min_range = 0.1;
  range.max_range = 30;
  range.quantum = 0.001;
  range.beam = {0.006, 2e-3, 7, 0.5};
  return driven(options, resolution, Ends::kFullTurn, range);
}

ScannerPreset
tof(const Resolution& resolution)
{
  const CameraIntrinsics camera = cameraOf(176, 144, 200, resolution);
  const auto scanner = std::make_shared<TofCamera>(camera, 20e6, 0.04);
  RangeOptions range;
  range.noise = 0.003;
  range.signal_noise = 0.004;
  range.noise_per_range_sq = 0.0005;
  range.min_range = 0.3;
  range.signal_range = 15;
  range.ambiguity_interval = scanner->ambiguityInterval();
  range.beam.divergence = 1 / camera.fx; // a pixel's own field of view
  range.beam.rays = 7;
  return {"", "", scanner, range};
}

ScannerPreset
projection(const Resolution& resolution)
{
  const CameraIntrinsics camera = cameraOf(640, 480, 800, resolution);
  StripeProjectorOptions projector;
  projector.baseline = 0.2;
  projector.vergence = 10 * kDegree;
  constexpr int kPatterns = 14; // 10 of Gray code, 4 shifted
  RangeOptions range;
  range.noise = 1e-5;
  // A tenth of a pixel.
  range.noise_per_range_sq = depthSigmaFromImage(1, projector.baseline, camera.fx, 0.1);
  range.min_range = 0.3;
  range.max_range = 5;
  return {"",
          "",
          std::make_shared<ProjectionScanner>(camera, projector, kPatterns, 1.0 / 60),
          range};
}

constexpr Entry kEntries[] = {
    {"avia", "rosette ahead, 70 x 77 deg, 6 x 4000 in 0.1 s", avia},
    {"hdl32", "spinning lidar, 360 x 41 deg, 32 x 2170 in 0.1 s", hdl32},
    {"hdl64", "spinning lidar, 360 x 26 deg, 64 x 2083 in 0.1 s", hdl64},
    {"mid360", "rosette all around, 360 x 59 deg, 4 x 5000 in 0.1 s", mid360},
    {"os0", "spinning lidar, 360 x 90 deg, 128 x 1024 in 0.1 s", os0},
    {"ouster", "spinning lidar, 360 x 45 deg, 64 x 1024 in 0.1 s", ouster},
    {"pandar", "spinning lidar, 360 x 40 deg, uneven, 64 x 1800 in 0.1 s", pandar},
    {"pitching", "Kurt3D: nodding fan, 180 x 120 deg, 241 x 181 in 3.2 s", pitching},
    {"projection", "structured light, 44 x 33 deg, 480 x 640 in 0.23 s", projection},
    {"rangefinder", "1D: one beam straight ahead", rangefinder},
    {"rgbd", "depth camera, 57 x 45 deg, 480 x 640 in 0.03 s", rgbd},
    {"rolling", "fan rolled about its axis, half sphere, 180 x 181 in 2.4 s", rolling},
    {"rotating", "upright fan turned, 360 x 120 deg, 360 x 121 in 4.8 s", rotating},
    {"scandrive",
     "RTS/ScanDrive: upright fan that yaws on, full sphere, 180 x 181 in 1.2 s",
     scandrive},
    {"sick", "2D: SICK LMS, 180 deg, 1 x 181 in 13 ms", sick},
    {"terrestrial",
     "sphere but a cone below, 0.25 deg, 720 x 1201 in 14 s",
     terrestrial},
    {"tof", "time-of-flight camera at 20 MHz, 47 x 40 deg, 144 x 176 in 0.04 s", tof},
    {"vlp16", "spinning lidar, 360 x 30 deg, 16 x 1800 in 0.1 s", vlp16},
    {"zeb", "hand-held: fan of 270 deg rolled about its axis, 40 x 1081 in 1 s", zeb},
};

const Entry&
entryOf(const std::string& name)
{
  std::string known;
  for (const auto& entry : kEntries) {
    if (entry.name == name)
      return entry;
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw BadArgument("scanner = " + name + ", but must be one of " + known);
}
} // namespace

std::vector<std::string>
scannerNames()
{
  std::vector<std::string> names;
  for (const auto& entry : kEntries)
    names.emplace_back(entry.name);
  return names;
}

std::string
scannerDescription(const std::string& name)
{
  return entryOf(name).description;
}

ScannerPreset
scannerByName(const std::string& name, std::optional<double> resolution)
{
  const Entry& entry = entryOf(name);
  require(!resolution || (*resolution > 0 && *resolution <= M_PI / 2),
          "resolution",
          resolution.value_or(0) / kDegree,
          "> 0 and at most 90 deg");
  ScannerPreset preset = entry.make(resolution);
  preset.name = entry.name;
  preset.description = entry.description;
  return preset;
}

} // namespace pcl6d
