// SPDX-License-Identifier: BSD-3-Clause
// Start values for the estimation of the motion within a scan.
#include "carried_on.h"

#include <pcl6d/common/rotation.h>
#include <pcl6d/deskew/motion_correction.h>
#include <pcl6d/deskew/motion_tracker.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl6d::deskew {

namespace {
/** Share of the distance: wheels slip. Only the first knot is fixed, at about the stamp. */
constexpr double kOdometryError = 0.1;

/** Share of the noise. The transition between two scans is as exact as their poses: the mean of a
 * hundred planes. */
constexpr double kSlack = 0.1;

/** \return the knots with the poses of a path at their times */
template <typename Path>
Trajectory
knotsAlong(const Trajectory& knots, const Path& path)
{
  Trajectory along = knots;
  for (std::size_t k = 0; k < along.poses.size(); ++k)
    along.poses[k] = path(along.stamps[k]);
  return along;
}
} // namespace

Eigen::Isometry3d
carriedOn(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double s)
{
  const Eigen::Isometry3d step = a.inverse() * b;
  const double whole = std::floor(std::clamp(s, -1000.0, 1000.0));
  const double rest = std::clamp(s, -1000.0, 1000.0) - whole;
  Eigen::Isometry3d pose = a;
  const Eigen::Isometry3d one = whole < 0 ? step.inverse() : step;
  for (double k = 0; k < std::abs(whole); ++k)
    pose = pose * one;
  Eigen::Isometry3d part = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d turn = rotationVector(step.linear());
  // Half of the turn on the way: the chord of the arc.
  part.translation() =
      rest * (rotationFromVector((rest - 1) / 2 * turn) * step.translation());
  part.linear() = rotationFromVector(rest * turn);
  pose = pose * part;
  pose.linear() = nearestRotation(pose.linear());
  return pose;
}

/** Half of a sample serves the estimation: a hundred times the unknowns of a scan's two poses, and
 * a hundred times the unknowns of each further pose, up to ten. */
std::size_t
sampleSize(const Trajectory& knots)
{
  return 2400 * std::min<std::size_t>(knots.poses.size() - 1, 5);
}

/** \return candidate motions since the previous scan, as knots of the new scan */
std::vector<Trajectory>
MotionTracker::startsOf(const MovingScan& scan) const
{
  const TrackedScan& last = scans_.back();
  const Trajectory& before = last.knots;
  const Trajectory times = restingKnots(scan, before.poses.back());
  std::vector<Trajectory> starts = {times}; // standstill
  const std::size_t k = before.poses.size() - 2;
  const double step = before.stamps[k + 1] - before.stamps[k];
  if (last.is_moved) // constant velocity
    starts.push_back(knotsAlong(times, [&](double t) {
      return carriedOn(
          before.poses[k], before.poses[k + 1], (t - before.stamps[k]) / step);
    }));
  const Eigen::Isometry3d pose = last.pose();
  if (scans_.size() > 1 && last.is_matched) { // ... from scan to scan
    const TrackedScan& earlier = scans_[scans_.size() - 2];
    const double period = last.stamp - earlier.stamp;
    if (period > 0) {
      const Eigen::Isometry3d from = earlier.pose();
      const auto path = [&](double t) {
        return carriedOn(from, pose, (t - earlier.stamp) / period);
      };
      starts.push_back(knotsAlong(times, path));
      starts.push_back(restingKnots(scan, path(scan.stamp)));
    }
  }
  if (!last.step)
    return starts;
  const Eigen::Isometry3d there = pose * *last.step; // by odometry
  starts.push_back(restingKnots(scan, there));
  if (scan.step && scan.step_time > 0)
    starts.push_back(knotsAlong(times, [&](double t) {
      return carriedOn(there, there * *scan.step, (t - scan.stamp) / scan.step_time);
    }));
  if (last.step_time > 0)
    starts.push_back(knotsAlong(times, [&](double t) {
      return carriedOn(pose, there, (t - last.stamp) / last.step_time);
    }));
  return starts;
}

/** Sorts the starts by the share of points on the map, best first. */
void
MotionTracker::sortByFit(const TimedPoints& half, std::vector<Trajectory>& starts) const
{
  std::vector<std::pair<double, std::size_t>> fits;
  for (std::size_t i = 0; i < starts.size(); ++i)
    // Rough starts are compared roughly: by a quarter of a cell.
    fits.emplace_back(-meanOf(fitOf(map_,
                                    worldPoints(half, starts[i], icp_.num_threads),
                                    map_options_.cell / 4,
                                    icp_.num_threads)),
                      i);
  std::sort(fits.begin(), fits.end());
  std::vector<Trajectory> sorted;
  for (const auto& [fit, i] : fits)
    sorted.push_back(std::move(starts[i]));
  starts = std::move(sorted);
}

Trajectory
MotionTracker::best(std::vector<Trajectory> starts, const TimedPoints& half) const
{
  sortByFit(half, starts);
  return starts.front();
}

/** \return the start with prior terms: constant velocity from the last two knots of the previous
 * scan or, without a reliable previous motion, the velocity of the start */
MotionStart
MotionTracker::startOf(const Trajectory& knots, bool goes_on) const
{
  const TrackedScan& last = scans_.back();
  MotionStart start;
  start.knots = knots;
  MotionNoise noise = MotionNoise::usual();
  double slack = map_options_.cell;
  if (last.is_guide && goes_on) {
    noise = motionNoise();
    slack = kSlack * icp_.noise;
    start.held.poses = {last.knots.poses.end() - 2, last.knots.poses.end()};
    start.held.stamps = {last.knots.stamps.end() - 2, last.knots.stamps.end()};
  }
  else {
    const double step = knots.stamps[1] - knots.stamps[0];
    start.held.poses = {carriedOn(knots.poses[0], knots.poses[1], -1), knots.poses[0]};
    start.held.stamps = {knots.stamps[0] - step, knots.stamps[0]};
  }
  start.terms = elasticTermsBetween({0, start.held.stamps[0]},
                                    {1, start.held.stamps[1]},
                                    {2, knots.stamps[0]},
                                    {3, knots.stamps[1]},
                                    noise,
                                    slack,
                                    slack / std::max(reach_, map_options_.cell));
  std::size_t first = 2;
  if (last.step && goes_on) { // the odometry is a prior with its error
    start.held.poses.push_back(last.pose() * *last.step);
    start.held.stamps.push_back(knots.stamps[0]);
    const double error =
        kOdometryError * last.step->translation().norm() + map_options_.cell;
    for (ElasticTerm& term : start.terms) // indices move up by one
      for (std::size_t k = 2; k < 4; ++k)
        ++term.knots[k];
    ++first;
    ElasticTerm near = rigidTerm(2, first, error);
    near.translation_least = near.rotation_least = 0;
    start.terms.push_back(near);
  }
  const auto within = elasticTermsWithin(knots.stamps, first, noise);
  start.terms.insert(start.terms.end(), within.begin(), within.end());
  return start;
}

/** Estimates constant velocity over the whole scan, then doubles the number of steps each time: few
 * unknowns converge from far away. */
Trajectory
MotionTracker::refined(const Trajectory& start,
                       bool goes_on,
                       const TimedPoints& half) const
{
  MotionIcpOptions rough = icp_;
  rough.max_iterations = 10; // later steps continue
  const std::size_t all = start.poses.size() - 1;
  Trajectory knots;
  knots.poses = {start.poses.front(), start.poses.back()};
  knots.stamps = {start.stamps.front(), start.stamps.back()};
  for (std::size_t steps = 1;; steps = std::min(2 * steps, all)) {
    const MotionCorrection path(knots);
    Trajectory finer;
    for (std::size_t k = 0; k <= steps; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(steps);
      finer.stamps.push_back(
          k == steps ? start.stamps.back()
                     : start.stamps.front() +
                           share * (start.stamps.back() - start.stamps.front()));
      finer.poses.push_back(path.poseAt(finer.stamps.back()));
    }
    if (steps == all)
      return finer;
    knots = motionIcp(map_, half, startOf(finer, goes_on), rough).knots;
  }
}

} // namespace pcl6d::deskew
