// SPDX-License-Identifier: BSD-3-Clause
// Scans that were taken on the move, as a run takes them.
#include "slam_run.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/slam6d/scan_preparation.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace pcl6d::slam6d {

namespace {
/** Scans that stand still, before the first one that moves: what it is compared with. */
constexpr std::size_t kLastStill = 10;

void
requireTimes(const std::string& name,
             const Points& points,
             const std::vector<double>& times)
{
  if (times.size() != points.size())
    throw BadArgument(name + ": " + std::to_string(times.size()) + " times for " +
                      std::to_string(points.size()) + " points, but each needs one");
  const auto bad = std::count_if(
      times.begin(), times.end(), [](double t) { return !std::isfinite(t); });
  if (bad > 0)
    throw BadArgument(name + ": " + std::to_string(bad) +
                      " points have a time that is not finite");
}
} // namespace

void
SlamRun::addStill(const Points& points,
                  const ScanResult& scan,
                  const std::string& given_name)
{
  addUndone(true);
  addScan(points, scan, given_name);
  if (!options_.motion.keep_still)
    return;
  last_still_.emplace_back(points, result_.scans.back().T_world_scan);
  if (last_still_.size() > kLastStill)
    last_still_.pop_front();
}

void
SlamRun::addMoving(const Points& points,
                   const ScanTimes& times,
                   const Eigen::Isometry3d& pose,
                   const std::string& given_name)
{
  const std::string name = nameOf(given_name);
  if (sharing)
    throw BadArgument(name + ": the motion within scans is not found by several "
                             "processes that share the work");
  const std::size_t finite = countFinite(points);
  if (finite < 3)
    throw BadArgument(tooFewPoints(name, finite, "with finite coordinates"));
  if (!isRigid(pose))
    throw BadArgument(name + ": the initial pose is not a rigid motion");
  requireTimes(name, points, times.times);
  for (const auto& [still, still_pose] : std::exchange(last_still_, {}))
    motion_.addStill(still, still_pose);
  const auto start = std::chrono::steady_clock::now();
  motion_.add(
      result_.scans.size() + motion_.numWaiting(), points, times, pose, given_name);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  result_.motion_seconds += spent.count();
  addUndone(false);
}

void
SlamRun::addUndone(bool all)
{
  const auto start = std::chrono::steady_clock::now();
  std::vector<MotionStage::Ready> undone = motion_.take(all);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  result_.motion_seconds += spent.count();
  for (MotionStage::Ready& ready : undone) {
    ScanResult scan;
    scan.initial_pose = scan.T_world_scan = ready.pose;
    addScan(ready.points, scan, ready.name);
  }
}

void
SlamRun::relaxMotions()
{
  motion_.describe(result_.scans);
  if (num_relaxed_ == result_.scans.size() || !motion_.anyMoved())
    return;
  if (progress)
    progress({"motion within scans", 0, 1});
  motion_.relax(matcher_->matcher(), scans_, result_);
  motion_.describe(result_.scans);
  num_relaxed_ = result_.scans.size();
  startAnew(num_relaxed_); // further scans meet the new points
}

} // namespace pcl6d::slam6d
