// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/deskew/motion_correction.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl6d {
namespace {
constexpr double kLongestShare = 1.5; // periods between a point and its stamp
constexpr double kLeastShare =
    0.01; // of the longest, for non-integers in parts of a second
// Ouster: t; Velodyne: time; Hesai, RoboSense, Livox (2): timestamp; Livox (1): offset_time.
constexpr const char* kTimeFields[] =
    {"t", "time", "timestamp", "time_stamp", "offset_time", "stamps"};
constexpr std::size_t kPointsPerBlock = 4096;

struct Unit {
  double seconds;
  const char* name;
};
constexpr std::array<Unit, 4> kUnits = {
    {{1, "s"}, {1e-3, "ms"}, {1e-6, "us"}, {1e-9, "ns"}}};

double
sinceStamp(double value, const TimeFormat& format, double stamp)
{
  return value * format.unit - (format.is_absolute ? stamp : 0);
}

// An integer holds parts of a second, a floating type mostly seconds; some drivers write parts.
bool
mayHave(const FieldValues& times, const Unit& unit)
{
  return !times.is_integer || unit.seconds < 1;
}

// The largest distance [s] from the stamp.
double
farthest(const FieldValues& times, const TimeFormat& format, double stamp)
{
  double largest = 0;
  for (const double value : times.values)
    largest = std::max(largest, std::abs(sinceStamp(value, format, stamp)));
  return largest;
}

// The cubic from 0 (s = 0) to `end` (s = 1) with derivatives `rate_0` and `rate_1` at the ends.
Eigen::Vector3d
hermite(double s,
        const Eigen::Vector3d& end,
        const Eigen::Vector3d& rate_0,
        const Eigen::Vector3d& rate_1)
{
  return s * (1 - s) * (1 - s) * rate_0 + s * s * (3 - 2 * s) * end +
         s * s * (s - 1) * rate_1;
}

// How a rotation vector w changes while the body turns at a velocity [rad/s] in the
// world: the inverse of the left Jacobian, to the third order in |w|.
Eigen::Vector3d
rotationVectorRate(const Eigen::Vector3d& w, const Eigen::Vector3d& velocity)
{
  return velocity - w.cross(velocity) / 2 + w.cross(w.cross(velocity)) / 12;
}

void
requireFinite(const FieldValues& times)
{
  const auto bad = std::count_if(times.values.begin(),
                                 times.values.end(),
                                 [](double value) { return !std::isfinite(value); });
  require(bad == 0,
          ("points whose field " + times.name + " is not finite").c_str(),
          bad,
          "0");
}
} // namespace

TimeFormat
timeFormatAlone(const FieldValues& times)
{
  requireFinite(times);
  constexpr double kShortest = 0.02,
                   kLongest = 20; // [s] a factor of 1000: one unit fits
  const auto [first, last] =
      std::minmax_element(times.values.begin(), times.values.end());
  const double lasts = times.values.empty() ? 0 : *last - *first;
  for (const auto& unit : kUnits) {
    const double seconds = lasts * unit.seconds;
    const bool is_long = unit.seconds == 1 || seconds > kShortest || lasts == 0;
    // Without stamps, 100 may mean milliseconds or the seconds of a slow scan.
    const bool is_clear = times.is_integer || unit.seconds != 1e-3;
    if (mayHave(times, unit) && is_long && is_clear && seconds <= kLongest) {
      const double latest = std::max(std::abs(*first), std::abs(*last));
      return {unit.seconds, latest * unit.seconds > kLongest && lasts > 0};
    }
  }
  require(false,
          ("largest difference of field " + times.name).c_str(),
          lasts,
          times.is_integer ? "20 ms to 20 s in ms, us or ns" : "at most 20 s");
  return {};
}

std::string
toString(const TimeFormat& format)
{
  std::string name;
  for (const auto& unit : kUnits)
    if (unit.seconds == format.unit)
      name = unit.name;
  return "in " + name + (format.is_absolute ? ", absolute" : " since the scan's stamp");
}

std::optional<FieldValues>
timeField(const pcl::PCLPointCloud2& cloud)
{
  for (const char* const name : kTimeFields)
    if (auto field = fieldValues(cloud, name))
      return field;
  return {};
}

MotionInterpolation
motionInterpolationFromName(const std::string& name)
{
  constexpr Named<MotionInterpolation> kInterpolations[] = {
      {MotionInterpolation::kLinear, "linear"}, {MotionInterpolation::kCubic, "cubic"}};
  return fromName(kInterpolations, "interpolation", name, WordList::kOr);
}

MotionCorrection::MotionCorrection(const Trajectory& odometry,
                                   MotionInterpolation interpolation)
: odometry_(odometry), interpolation_(interpolation)
{
  const auto& [poses, stamps] = odometry_;
  require(poses.size() >= 2, "number of poses", poses.size(), ">= 2");
  require(stamps.size() == poses.size(),
          "number of time stamps",
          stamps.size(),
          "one per pose, " + std::to_string(poses.size()));
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    require(std::isfinite(stamps[i]) && (i == 0 || stamps[i] > stamps[i - 1]),
            ("time stamp " + std::to_string(i)).c_str(),
            stamps[i],
            "finite and after the previous time");
    if (i > 0)
      turns_.push_back(
          rotationVector(poses[i].linear() * poses[i - 1].linear().transpose()));
  }
  for (std::size_t i = 0; i < poses.size(); ++i)
    velocities_.push_back(velocityAt(i));
}

MotionCorrection::Velocity
MotionCorrection::meanVelocity(std::size_t segment) const
{
  const auto& [poses, stamps] = odometry_;
  const double time = stamps[segment + 1] - stamps[segment];
  return {(poses[segment + 1].translation() - poses[segment].translation()) / time,
          turns_[segment] / time};
}

MotionCorrection::Velocity
MotionCorrection::velocityAt(std::size_t pose) const
{
  const auto& stamps = odometry_.stamps;
  if (pose == 0)
    return meanVelocity(0);
  const Velocity before = meanVelocity(pose - 1);
  if (pose + 1 == stamps.size())
    return before;
  const Velocity after = meanVelocity(pose);
  const double s =
      (stamps[pose] - stamps[pose - 1]) / (stamps[pose + 1] - stamps[pose - 1]);
  return {(1 - s) * before.linear + s * after.linear,
          (1 - s) * before.angular + s * after.angular};
}

std::size_t
MotionCorrection::segmentAt(double time) const
{
  const auto& stamps = odometry_.stamps;
  const auto next = std::upper_bound(stamps.begin() + 1, stamps.end() - 1, time);
  return static_cast<std::size_t>(next - stamps.begin()) - 1;
}

Eigen::Isometry3d
MotionCorrection::poseAt(double time) const
{
  const std::size_t i = segmentAt(time);
  const Eigen::Isometry3d& from = odometry_.poses[i];
  const double duration = odometry_.stamps[i + 1] - odometry_.stamps[i];
  const double s = (time - odometry_.stamps[i]) / duration;
  Eigen::Vector3d step = odometry_.poses[i + 1].translation() - from.translation();
  Eigen::Vector3d turn = turns_[i]; // both within this segment
  if (interpolation_ == MotionInterpolation::kLinear || s < 0 || s > 1) {
    step *= s;
    turn *= s; // slerp
  }
  else {
    const Velocity& v0 = velocities_[i];
    const Velocity& v1 = velocities_[i + 1];
    step = hermite(s, step, duration * v0.linear, duration * v1.linear);
    turn = hermite(s,
                   turn,
                   duration * v0.angular,
                   duration * rotationVectorRate(turn, v1.angular));
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotationFromVector(turn) * from.linear();
  pose.translation() = from.translation() + step;
  return pose;
}

double
MotionCorrection::period(double stamp) const
{
  const std::size_t i = segmentAt(stamp);
  return odometry_.stamps[i + 1] - odometry_.stamps[i];
}

TimeFormat
MotionCorrection::timeFormat(const FieldValues& times, double stamp) const
{
  requireFinite(times);
  const double limit = kLongestShare * period(stamp);
  // Unit by unit: 1.7e9 s since 1970 would also be 1.7 s in ns since the stamp.
  for (const auto& unit : kUnits)
    for (const bool is_absolute : {false, true}) {
      const TimeFormat format = {unit.seconds, is_absolute};
      if (!mayHave(times, unit))
        continue;
      // Units are a factor of 1000 apart: seconds just beyond the limit are no milliseconds.
      const double largest = farthest(times, format, stamp);
      const bool is_long =
          times.is_integer || unit.seconds == 1 || largest > kLeastShare * limit;
      if (is_long && largest <= limit)
        return format;
    }
  const TimeFormat plain = {times.is_integer ? 1e-9 : 1, false};
  require(false,
          ("largest field " + times.name + " " + toString(plain)).c_str(),
          farthest(times, plain, stamp) / plain.unit,
          "within 1.5 x the scan's period of " + std::to_string(period(stamp)) + " s");
  return plain;
}

std::vector<double>
MotionCorrection::timesOf(const FieldValues& times,
                          const TimeFormat& format,
                          double stamp) const
{
  requireFinite(times);
  const double largest = farthest(times, format, stamp);
  require(largest <= kLongestShare * period(stamp),
          ("largest time between a point and its scan's stamp, field " + times.name +
           " " + toString(format))
              .c_str(),
          largest,
          "within 1.5 x the scan's period of " + std::to_string(period(stamp)) + " s");
  std::vector<double> seconds;
  for (const double value : times.values)
    seconds.push_back(sinceStamp(value, format, stamp));
  return seconds;
}

void
MotionCorrection::correct(Points& points,
                          const std::vector<double>& times,
                          double stamp,
                          unsigned num_threads) const
{
  require(times.size() == points.size(),
          "number of times",
          times.size(),
          "one per point, " + std::to_string(points.size()));
  const Eigen::Isometry3d T_scan_world = poseAt(stamp).inverse();
  parallelBlocks(points.size(), kPointsPerBlock, num_threads, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i)
      points[i] = (T_scan_world * (poseAt(stamp + times[i]) * points[i].cast<double>()))
                      .cast<float>();
  });
}

} // namespace pcl6d
