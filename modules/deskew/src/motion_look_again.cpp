// SPDX-License-Identifier: BSD-3-Clause
// Scans of several knots are matched again when later scans are known: a scan that begins to turn
// sees surfaces that the scans before have often not seen.
#include "carried_on.h"

#include <pcl6d/common/rotation.h>
#include <pcl6d/deskew/motion_correction.h>
#include <pcl6d/deskew/motion_tracker.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl6d::deskew {

namespace {
constexpr int kRounds = 3; ///< of forward and backward passes; later rounds rarely help
constexpr int kRoughIterations =
    10; ///< of a partial fit: later fits with more points continue

/** \return the points of a time [s] */
TimedPoints
pointsBetween(const TimedPoints& points, double begin, double end)
{
  TimedPoints part;
  for (std::size_t i = 0; i < points.points.size(); ++i)
    if (points.times[i] >= begin && points.times[i] <= end) {
      part.points.push_back(points.points[i]);
      part.times.push_back(points.times[i]);
    }
  return part;
}

/** \return the knots from first to last, both included */
Trajectory
partOf(const Trajectory& knots, std::size_t first, std::size_t last)
{
  const auto from = static_cast<std::ptrdiff_t>(first);
  const auto to = static_cast<std::ptrdiff_t>(last) + 1;
  Trajectory part;
  part.stamps = {knots.stamps.begin() + from, knots.stamps.begin() + to};
  part.poses = {knots.poses.begin() + from, knots.poses.begin() + to};
  return part;
}

constexpr double kSpeeds[] = {1, 0.5, 0}; ///< of the step before, for vehicles that
                                          ///< brake
constexpr double kSureShares = 3; ///< deviations by which another step must fit better

/** \return candidate poses at the time of a third knot, extrapolated from two: constant velocity
 * first, then braked and turned about each axis
 * \param[in] angle [rad] of one turn, \param[in] most largest turn [rad] */
std::vector<Eigen::Isometry3d>
waysOn(const Trajectory& knots,
       std::size_t from,
       std::size_t to,
       std::size_t next,
       double angle,
       double most)
{
  const auto& stamps = knots.stamps;
  const double share = (stamps[next] - stamps[from]) / (stamps[to] - stamps[from]);
  std::vector<Eigen::Isometry3d> ways;
  for (const double speed : kSpeeds) {
    const Eigen::Isometry3d way =
        carriedOn(knots.poses[from], knots.poses[to], 1 + speed * (share - 1));
    ways.push_back(way);
    for (double turn = angle; turn <= most; turn += angle)
      for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1, 1}) {
          const Eigen::Vector3d vector = side * turn * Eigen::Vector3d::Unit(axis);
          ways.push_back(way);
          ways.back().linear() =
              nearestRotation(way.linear() * rotationFromVector(vector));
        }
  }
  return ways;
}
} // namespace

/** \return the pose of the next knot, extrapolated from two: constant velocity, unless the points
 * of its time interval clearly fit better otherwise. Turns beyond the convergence basin of
 * matching are tried in steps, up to the limit of plausible accelerations. */
Eigen::Isometry3d
MotionTracker::nextPose(const Trajectory& knots,
                        std::size_t from,
                        std::size_t to,
                        std::size_t next,
                        const TimedPoints& half) const
{
  const std::size_t first = std::min(to, next);
  Trajectory step = partOf(knots, first, first + 1);
  const TimedPoints seen = pointsBetween(half, step.stamps[0], step.stamps[1]);
  const double time = step.stamps[1] - step.stamps[0];
  const double most =
      std::min(MotionNoise::plausible().angular * time * time, kLargestTurn / 2);
  const double angle = icp_.max_distance_start / std::max(reach_, map_options_.cell);
  const auto ways = waysOn(knots, from, to, next, angle, most);
  std::size_t best = 0;
  double best_fit = 0;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    step.poses[next - first] = ways[i];
    const double fit = meanOf(fitOf(map_,
                                    worldPoints(seen, step, icp_.num_threads),
                                    map_options_.cell / 4, // tolerance of rough starts
                                    icp_.num_threads));
    if (i == 0) // a share of n points spreads by 1 / (2 root n)
      best_fit = fit + kSureShares / 2 /
                           std::sqrt(1.0 + static_cast<double>(seen.points.size()));
    else if (fit > best_fit) {
      best = i;
      best_fit = fit;
    }
  }
  return ways[best];
}

/** Adds knots in order of time. Each partial scan is matched with the points up to its last knot,
 * starting at the extrapolated pose. This follows a scan that begins to turn; matching the whole
 * scan at once would pair its last points with wrong surfaces. */
Trajectory
MotionTracker::grown(const Trajectory& start,
                     bool goes_on,
                     const TimedPoints& half) const
{
  MotionIcpOptions rough = icp_;
  rough.max_iterations = kRoughIterations;
  Trajectory knots = start;
  for (std::size_t k = 1; k < start.poses.size(); ++k) {
    if (k > 1)
      knots.poses[k] = nextPose(knots, k - 2, k - 1, k, half);
    Trajectory part = partOf(knots, 0, k);
    const TimedPoints seen =
        pointsBetween(half, part.stamps.front(), part.stamps.back());
    part = motionIcp(map_, seen, startOf(part, goes_on), rough).knots;
    std::copy(part.poses.begin(), part.poses.end(), knots.poses.begin());
  }
  return knots;
}

/** grown(), backwards from the last knot. */
Trajectory
MotionTracker::grownBack(const Trajectory& start, const TimedPoints& half) const
{
  MotionIcpOptions rough = icp_;
  rough.max_iterations = kRoughIterations;
  Trajectory knots = start;
  const std::size_t last = start.poses.size() - 1;
  for (std::size_t k = last; k-- > 0;) {
    if (k + 2 <= last)
      knots.poses[k] = nextPose(knots, k + 2, k + 1, k, half);
    Trajectory part = partOf(knots, k, last);
    const TimedPoints seen =
        pointsBetween(half, part.stamps.front(), part.stamps.back());
    part = motionIcp(map_, seen, startOf(part, false), rough).knots;
    std::copy(part.poses.begin(),
              part.poses.end(),
              knots.poses.begin() + static_cast<std::ptrdiff_t>(k));
  }
  return knots;
}

/** \return whether the scan's velocity may change within the scan */
bool
MotionTracker::isSteered(const TrackedScan& scan) const
{
  return scan.is_timed && scan.is_matched && scan.knots.poses.size() > 2;
}

/** \return the map of the scans before and after a scan, without the scan itself */
SurfaceMap
MotionTracker::mapAround(std::size_t number) const
{
  SurfaceMap map(map_options_);
  const std::size_t end = std::min(number + kLater + 1, scans_.size());
  const Eigen::Vector3d place = scans_[number].pose().translation();
  for (std::size_t i = number - std::min(number, 2 * kLater); i < end; ++i)
    if (i != number && scans_[i].is_matched &&
        (scans_[i].pose().translation() - place).norm() <= 2 * reach_)
      map.add(worldPoints(scans_[i].sample, scans_[i].knots, icp_.num_threads));
  return map;
}

/** \return the scan matched anew to the map, from its previous trajectory */
TrackedScan
MotionTracker::foundAgain(TrackedScan scan) const
{
  const TimedPoints half = halfOf(scan.sample, 0);
  Attempt best = attempt(scan.knots, true, half);
  const auto take = [&](const Trajectory& start, bool goes_on) {
    Attempt other = attempt(start, goes_on, half);
    if (other.score > best.score)
      best = std::move(other);
  };
  for (int round = 0; round < kRounds; ++round) {
    const double score = best.score;
    const Trajectory from = best.fit < 0 ? scan.knots : best.found.knots;
    take(grown(from, true, half), true);
    take(grownBack(from, half), false);
    if (best.score <= score)
      break;
  }
  if (best.fit < 0)
    return scan;
  MovingScan measured;
  measured.measured = scan.sample;
  measured.stamp = scan.stamp;
  const MotionIcpResult rigid = matchRigid(measured, half, best.found);
  scan.knots = best.found.knots;
  scan.rejection = {};
  scan.rigid_pose = rigid.knots.poses.front();
  scan.moved_pose = scan.pose();
  scan.is_moved = isMoved(measured, halfOf(scan.sample, 1), rigid.knots, scan);
  if (!scan.is_moved)
    scan.knots = rigid.knots;
  return scan;
}

/** Matches a scan again, on a map of its earlier and later neighbours. */
void
MotionTracker::lookAgain(std::size_t number)
{
  if (number == 0 || !isSteered(scans_[number]))
    return;
  const auto place = scans_.begin() + static_cast<std::ptrdiff_t>(number);
  SurfaceMap around = mapAround(number);
  std::vector<TrackedScan> later = {std::make_move_iterator(place),
                                    std::make_move_iterator(scans_.end())};
  scans_.erase(place, scans_.end());
  std::swap(map_, around);
  later.front() = foundAgain(std::move(later.front()));
  std::swap(map_, around);
  scans_.insert(scans_.end(),
                std::make_move_iterator(later.begin()),
                std::make_move_iterator(later.end()));
}

/** \param[in] later number of following scans to wait for */
void
MotionTracker::settle(std::size_t later)
{
  while (num_settled_ < scans_.size() &&
         (num_settled_ + later < scans_.size() || !isSteered(scans_[num_settled_])))
    lookAgain(num_settled_++);
}

void
MotionTracker::finish()
{
  settle(0);
}

} // namespace pcl6d::deskew
