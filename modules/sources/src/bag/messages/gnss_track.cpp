// SPDX-License-Identifier: BSD-3-Clause
#include "bag/messages/gnss_track.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/portable_math.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace pcl6d::sources {

namespace {
// WGS84 (NIMA TR8350.2): half axis and flattening.
constexpr double kHalfAxis = 6378137; // [m]
constexpr double kFlattening = 1 / 298.257223563;
constexpr double kEccentricitySq = kFlattening * (2 - kFlattening);

// A heading needs a distance longer than the noise of the end points: three standard
// deviations, or a metre if the receiver reports no deviation, sufficient with corrections.
constexpr double kShortestWay = 1; // [m]
constexpr double kDeviations = 3;

/** \brief A position in time. */
struct TimedPosition {
  std::int64_t time = 0; ///< [ns]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double way = kShortestWay; ///< [m] sufficient for a heading here
};

double
levelDistance(const TimedPosition& a, const TimedPosition& b)
{
  return (b.position - a.position).head<2>().norm();
}

/** \return for each position the next position far enough away for a heading, not before the
 * result of the previous position, so that one pass suffices; the position itself if not found */
std::vector<std::size_t>
nextFarPlaces(const std::vector<TimedPosition>& track)
{
  std::vector<std::size_t> next;
  std::size_t j = 0;
  for (std::size_t i = 0; i < track.size(); ++i) {
    j = std::max(j, i + 1);
    while (j < track.size() && levelDistance(track[i], track[j]) < track[i].way)
      ++j;
    next.push_back(j < track.size() ? j : i);
  }
  return next;
}

/** \return nextFarPlaces() in backward direction */
std::vector<std::size_t>
lastFarPlaces(const std::vector<TimedPosition>& track)
{
  const std::size_t count = track.size();
  std::vector<std::size_t> last =
      nextFarPlaces({track.rbegin(), track.rend()}); // indices from the end
  std::reverse(last.begin(), last.end());
  for (std::size_t& place : last)
    place = count - 1 - place;
  return last;
}

/** \return level rotations along the motion; the identity if the whole track stands still */
std::vector<Eigen::Matrix3d>
headings(const std::vector<TimedPosition>& track)
{
  const std::vector<std::size_t> last = lastFarPlaces(track),
                                 next = nextFarPlaces(track);
  std::vector<Eigen::Matrix3d> rotations;
  for (std::size_t i = 0; i < track.size(); ++i) {
    const Eigen::Vector2d way =
        (track[next[i]].position - track[last[i]].position).head<2>();
    const double length = way.norm();
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    if (length > 0)
      rotation.topLeftCorner<2, 2>() << way.x() / length, -way.y() / length,
          way.y() / length, way.x() / length;
    rotations.push_back(rotation);
  }
  return rotations;
}

std::vector<TimedPosition>
sorted(std::vector<TimedPosition> track)
{
  std::stable_sort(track.begin(), track.end(), [](const auto& a, const auto& b) {
    return a.time < b.time;
  });
  return track;
}
} // namespace

Eigen::Vector3d
earthFixed(const GeodeticPosition& position)
{
  const SinCos latitude = portableSinCos(position.latitude * kDegree);
  const SinCos longitude = portableSinCos(position.longitude * kDegree);
  const double normal =
      kHalfAxis / std::sqrt(1 - kEccentricitySq * latitude.sin * latitude.sin);
  const double from_axis = (normal + position.altitude) * latitude.cos;
  return {from_axis * longitude.cos,
          from_axis * longitude.sin,
          (normal * (1 - kEccentricitySq) + position.altitude) * latitude.sin};
}

Eigen::Vector3d
eastNorthUp(const GeodeticPosition& position, const GeodeticPosition& origin)
{
  const SinCos latitude = portableSinCos(origin.latitude * kDegree);
  const SinCos longitude = portableSinCos(origin.longitude * kDegree);
  const Eigen::Vector3d east(-longitude.sin, longitude.cos, 0);
  const Eigen::Vector3d north(
      -latitude.sin * longitude.cos, -latitude.sin * longitude.sin, latitude.cos);
  const Eigen::Vector3d up(
      latitude.cos * longitude.cos, latitude.cos * longitude.sin, latitude.sin);
  const Eigen::Vector3d way = earthFixed(position) - earthFixed(origin);
  return {east.dot(way), north.dot(way), up.dot(way)};
}

void
GnssTrack::add(const SatelliteFix& fix, std::int64_t recorded)
{
  if (!fix.position) {
    ++num_without_fix_;
    return;
  }
  if (fixes_.empty())
    frame_ = fix.header.frame;
  fixes_.push_back({fix, recorded});
}

void
GnssTrack::add(const InertialOrientation& inertial, std::int64_t recorded)
{
  if (inertial.orientation)
    orientations_.push_back({inertial, recorded});
  else
    ++num_without_orientation_;
}

std::string
GnssTrack::originText() const
{
  if (fixes_.empty())
    return "";
  const GeodeticPosition& origin = *fixes_.front().fix.position;
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed << std::setprecision(8) << origin.latitude << ' '
       << origin.longitude << ' ' << std::setprecision(3) << origin.altitude << " m";
  return text.str();
}

PoseSeries
GnssTrack::poses(bool uses_record,
                 const FrameTree& tree,
                 const std::filesystem::path& path,
                 const std::string& fix_title,
                 const std::string& inertial_title,
                 std::vector<std::string>& notes) const
{
  if (fixes_.empty())
    text::fail(path,
               fix_title +
                   " has no position: " + text::counted(num_without_fix_, "message") +
                   " without a fix (status -1) or with infinite numbers or NaN; "
                   "--odometry none uses no poses");
  if (num_without_fix_ > 0)
    notes.push_back(text::counted(num_without_fix_, "message") + " of " + fix_title +
                    " without a fix left out");
  std::vector<TimedPosition> track;
  for (const Fix& fix : fixes_)
    track.push_back({uses_record ? fix.recorded : fix.fix.header.stamp,
                     eastNorthUp(*fix.fix.position, *fixes_.front().fix.position),
                     std::max(kShortestWay, kDeviations * fix.fix.sigma)});
  track = sorted(std::move(track));
  PoseSeries turns = orientations(uses_record, tree, path, inertial_title, notes);
  const std::vector<Eigen::Matrix3d> along = headings(track);
  PoseSeries series;
  for (std::size_t i = 0; i < track.size(); ++i) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = along[i];
    if (!inertial_title.empty()) {
      const auto turn = turns.at(track[i].time);
      if (!turn)
        continue;
      pose.linear() = turn->linear();
    }
    pose.translation() = track[i].position;
    series.add(track[i].time, pose);
  }
  series.finish();
  return series;
}

PoseSeries
GnssTrack::orientations(bool uses_record,
                        const FrameTree& tree,
                        const std::filesystem::path& path,
                        const std::string& title,
                        std::vector<std::string>& notes) const
{
  PoseSeries turns;
  if (title.empty())
    return turns;
  if (orientations_.empty())
    text::fail(path,
               title + " has no orientations (orientation_covariance[0] is -1, or the "
                       "quaternion is 0); without --imu the heading of the motion is "
                       "taken");
  if (num_without_orientation_ > 0)
    notes.push_back(text::counted(num_without_orientation_, "message") + " of " +
                    title + " without an orientation left out");
  bool is_linked = true;
  for (const Orientation& of : orientations_) {
    const std::int64_t time = uses_record ? of.recorded : of.inertial.header.stamp;
    const std::string& imu = of.inertial.header.frame;
    Eigen::Isometry3d pose(*of.inertial.orientation);
    if (imu != frame_ && !imu.empty() && !frame_.empty()) {
      const auto T_imu_antenna = tree.poseIn(frame_, imu, time);
      is_linked = is_linked && T_imu_antenna;
      if (T_imu_antenna)
        pose.linear() = pose.linear() * T_imu_antenna->linear();
    }
    turns.add(time, pose);
  }
  turns.finish();
  if (!is_linked)
    notes.push_back("no transform from " + text::quoted(frame_) + " to " +
                    text::quoted(orientations_.front().inertial.header.frame) +
                    " (tf): their axes are taken for parallel");
  return turns;
}

} // namespace pcl6d::sources
