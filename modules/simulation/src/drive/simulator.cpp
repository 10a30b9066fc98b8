// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/common/random.h>
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/driven_scanner.h>
#include <pcl6d/simulation/cast_scan.h>
#include <pcl6d/simulation/path_check.h>
#include <pcl6d/simulation/simulator.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl6d {
namespace {
constexpr double kHighestSpeed = 50; // [m/s]
constexpr double kUsualSpeed = 1;    // [m/s]
constexpr double kSpareTime = 0.9;   // largest share of the period for a scan

// Streams of the seed, so more scans do not change the odometry's noise.
enum Stream : std::uint64_t {
  kRangeStream = 1,
  kOdometryStream = 2,
  kVibrationStream = 3
};
constexpr double kTurnRate = 30 * M_PI / 180; // [rad/s] of a small vehicle

std::uint64_t
streamSeed(std::uint64_t seed, Stream stream)
{
  return mixBits(mixBits(seed) ^ stream);
}

/** \return the number of scans up to the last */
int
scansOf(const SimulationOptions& options)
{
  return options.last ? std::min(options.num_scans - 1, *options.last) + 1
                      : options.num_scans;
}

Trajectory
odometryOf(const Trajectory& truth, const SimulationOptions& options)
{
  const std::uint64_t seed = streamSeed(options.seed, kOdometryStream);
  switch (options.odometry_kind) {
  case OdometryKind::kVisualInertial:
    return visualInertialOdometry(truth, options.visual_inertial, seed);
  case OdometryKind::kExact:
    return truth;
  case OdometryKind::kWheel:
    break;
  }
  return wheelOdometry(truth, options.odometry, seed);
}

const SimulationOptions&
validated(const SimulationOptions& options)
{
  options.validate();
  return options;
}
} // namespace

ScanMotion
scanMotionFromName(const std::string& name)
{
  constexpr Named<ScanMotion> kMotions[] = {{ScanMotion::kStop, "stop"},
                                            {ScanMotion::kContinuous, "continuous"}};
  return fromName(kMotions, "motion", name, WordList::kOr);
}

OdometryKind
odometryKindFromName(const std::string& name)
{
  constexpr Named<OdometryKind> kKinds[] = {
      {OdometryKind::kWheel, "wheel"},
      {OdometryKind::kVisualInertial, "visual-inertial"},
      {OdometryKind::kExact, "exact"}};
  return fromName(kKinds, "odometry", name, WordList::kOr);
}

void
SimulationOptions::validate() const
{
  require(
      num_scans >= 1 && num_scans <= 100000, "num_scans", num_scans, "in [1, 100000]");
  require(!last || *last >= 0, "last", last.value_or(0), ">= 0");
  require(!speed || (*speed > 0 && *speed <= kHighestSpeed),
          "speed",
          speed.value_or(0),
          "in (0, 50] m/s");
  const bool drives_on = motion == ScanMotion::kContinuous;
  const std::string rule = " with a stop for each scan";
  require(drives_on || !turns_in_place, "turns_in_place", 1, "0" + rule);
  require(drives_on || !turn_rate, "turn_rate", turn_rate.value_or(0), "none" + rule);
  require(drives_on || vibration == 0, "vibration", vibration, "0" + rule);
  require(drives_on || !period, "period", period.value_or(0), "none" + rule);
  require(!period || (*period > 0 && std::isfinite(*period)),
          "period",
          period.value_or(0),
          "> 0 s");
  RobotMotionOptions ride;
  ride.turn_rate = turn_rate;
  ride.vibration = vibration;
  ride.validate();
  range.validate();
  robot.validate();
  odometry.validate();
  visual_inertial.validate();
}

Simulator::Simulator(SimulationScene scene, const SimulationOptions& options)
: scene_(std::move(scene.geometry), std::move(scene.moving))
, options_(validated(options))
, path_(scene.waypoints,
        options.robot,
        options.turns_in_place ? PathCorners::kSharp : PathCorners::kRounded)
{
  if (!options_.scanner)
    options_.scanner = std::make_shared<DrivenScanner>();
  options_.range.seed = streamSeed(options.seed, kRangeStream);
  requireFreePath(caster(), path_, options.num_scans);
  if (options.motion == ScanMotion::kStop)
    stopAndScan();
  else
    scanOnTheMove();
  odometry_ = odometryOf(truth_, options_);
}

void
Simulator::stopAndScan()
{
  speed_ = options_.speed.value_or(kUsualSpeed);
  T_scene_world_ = path_.sensorPose(caster(), 0);
  for (int i = 0; i < scansOf(options_); ++i) {
    const double way = path_.length() * i / options_.num_scans;
    const Eigen::Isometry3d T_scene_scan = path_.sensorPose(caster(), way);
    truth_.poses.push_back(i == 0 ? Eigen::Isometry3d::Identity()
                                  : T_scene_world_.inverse() * T_scene_scan);
    truth_.stamps.push_back(way / speed_ + i * scanner().duration());
  }
}

double
Simulator::speedOnTheMove() const
{
  if (options_.period) {
    require(*options_.period >= scanner().duration(),
            "period",
            *options_.period,
            "at least " + std::to_string(scanner().duration()) +
                " s, which a scan takes");
    return options_.speed.value_or(kUsualSpeed);
  }
  const double limit = path_.length() / options_.num_scans / scanner().duration();
  return options_.speed.value_or(std::min(kUsualSpeed, kSpareTime * limit));
}

void
Simulator::scanOnTheMove()
{
  speed_ = speedOnTheMove();
  RobotMotionOptions ride;
  ride.speed = speed_;
  ride.turn_rate = options_.turn_rate;
  if (options_.turns_in_place)
    ride.turn_rate = options_.turn_rate.value_or(kTurnRate);
  ride.vibration = options_.vibration;
  ride.seed = streamSeed(options_.seed, kVibrationStream);
  motion_.emplace(path_, caster(), ride);
  const double period =
      options_.period.value_or(motion_->duration() / options_.num_scans);
  const double step = path_.length() / options_.num_scans;
  require(period >= scanner().duration(),
          "speed",
          speed_,
          "at most " + std::to_string(step / scanner().duration()) +
              " m/s: a scan takes " + std::to_string(scanner().duration()) +
              " s, and the next scan starts " + std::to_string(step) + " m on");
  T_scene_world_ = motion_->poseAt(0);
  for (int i = 0; i < scansOf(options_); ++i) {
    truth_.stamps.push_back(period * i);
    truth_.poses.push_back(i == 0 ? Eigen::Isometry3d::Identity()
                                  : T_scene_world_.inverse() *
                                        motion_->poseAt(truth_.stamps.back()));
  }
}

Eigen::Isometry3d
Simulator::poseAt(double time) const
{
  if (motion_)
    return motion_->poseAt(time);
  const auto& stamps = truth_.stamps;
  const auto next = std::upper_bound(stamps.begin(), stamps.end(), time);
  const auto i = std::max<std::ptrdiff_t>(next - stamps.begin(), 1) - 1;
  const double since =
      time - stamps[static_cast<std::size_t>(i)] - scanner().duration();
  return path_.sensorPose(caster(),
                          path_.length() * static_cast<double>(i) / options_.num_scans +
                              std::max(0.0, since) * speed_);
}

Eigen::Isometry3d
Simulator::scanPose(std::size_t i, double time) const
{
  require(i < size(), "scan", i, "below the number of scans");
  return motion_ ? T_scene_world_.inverse() * motion_->poseAt(truth_.stamps[i] + time)
                 : truth_.poses[i];
}

RangeScan
Simulator::rangeScan(std::size_t i) const
{
  require(i < size(), "scan", i, "below the number of scans");
  const Eigen::Isometry3d standing = T_scene_world_ * truth_.poses[i];
  const auto pose_at = [&](double time) {
    return motion_ ? motion_->poseAt(time) : standing;
  };
  const MovingView view(scene_, pose_at, truth_.stamps[i]);
  return castScan(view, scanner(), options_.range, i);
}

pcl::PointCloud<pcl::PointXYZI>
Simulator::scan(std::size_t i) const
{
  return toPointCloud(rangeScan(i), scanner());
}

} // namespace pcl6d
