// SPDX-License-Identifier: BSD-3-Clause
#include "carried_on.h"
#include "motion_tracker.h"

#include <pcl6d/common/median.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/filters/motion_correction.h>
#include <pcl6d/io/text.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace pcl6d::slam6d {

namespace {
/** A motion that moves the median point less than this share of the noise cannot be seen; one
 * that moves it by two, as errors of matching may, must show by points that agree clearly better. */
constexpr double kLeastNoises = 0.25, kSureNoises = 2;

/** Of the way: wheels slip. Only the first knot is held, which is about where the stamp is. */
constexpr double kOdometryError = 0.1;

/** Where two scans meet is as exact as their poses: the mean of a hundred planes. */
constexpr double kSlack = 0.1;

constexpr double kLeastOverlap =
    0.1;                            ///< share of points on planes, as of Slam6DOptions
constexpr std::size_t kWindow = 10; ///< scans that are looked at together
constexpr double kSureDeviations = 5; ///< as many scans are asked, see StageAgreement

double
largestTurn(const Trajectory& knots)
{
  double largest = 0;
  for (std::size_t k = 0; k + 1 < knots.poses.size(); ++k)
    largest = std::max(largest,
                       rotationAngle(knots.poses[k + 1].linear() *
                                     knots.poses[k].linear().transpose()));
  return largest;
}

double
meanOf(const std::vector<double>& values)
{
  return values.empty() ? 0
                        : std::accumulate(values.begin(), values.end(), 0.0) /
                              static_cast<double>(values.size());
}

bool
isOk(const MotionIcpResult& result)
{
  return result.status == Status::kOk || result.status == Status::kMaxIterations;
}

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

/** Half of a sample finds the motion: a hundred times the unknowns of a scan's two poses, and
 * as many again for each further one, up to ten. */
std::size_t
sampleSize(const Trajectory& knots)
{
  return 2400 * std::min<std::size_t>(knots.poses.size() - 1, 5);
}

/** \return what may have happened since the scan before: knots of the scan each */
std::vector<Trajectory>
MotionTracker::startsOf(const MovingScan& scan) const
{
  const TrackedScan& last = scans_.back();
  const Trajectory& before = last.knots;
  const Trajectory times = restingKnots(scan, before.poses.back());
  std::vector<Trajectory> starts = {times}; // it stands still
  const std::size_t k = before.poses.size() - 2;
  const double step = before.stamps[k + 1] - before.stamps[k];
  if (last.is_moved) // it goes on as it was
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
  if (!last_step_)
    return starts;
  const Eigen::Isometry3d there = pose * *last_step_; // as the odometry says
  starts.push_back(restingKnots(scan, there));
  if (scan.step && scan.step_time > 0)
    starts.push_back(knotsAlong(times, [&](double t) {
      return carriedOn(there, there * *scan.step, (t - scan.stamp) / scan.step_time);
    }));
  if (last_step_time_ > 0)
    starts.push_back(knotsAlong(times, [&](double t) {
      return carriedOn(pose, there, (t - last.stamp) / last_step_time_);
    }));
  return starts;
}

/** Puts the starts in order: first the one at which most points lie on the map. */
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

/** \return the start with what is known of the motion: that it goes on from the last two knots
 * before, or if these do not tell, that it is about that of the start */
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
  if (last_step_ && goes_on) { // the odometry is not believed far beyond its error
    start.held.poses.push_back(last.pose() * *last_step_);
    start.held.stamps.push_back(knots.stamps[0]);
    const double error =
        kOdometryError * last_step_->translation().norm() + map_options_.cell;
    for (ElasticTerm& term : start.terms) // behind it
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

/** First with constant velocity over all of the scan, then with twice as many steps each time:
 * few unknowns come near from far away. */
Trajectory
MotionTracker::refined(const Trajectory& start,
                       bool goes_on,
                       const TimedPoints& half) const
{
  MotionIcpOptions rough = icp_;
  rough.max_iterations = 10; // the next ones go on
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

/** The same scan as if it had not moved. */
MotionIcpResult
MotionTracker::matchRigid(const MovingScan& scan,
                          const TimedPoints& half,
                          const MotionIcpResult& found) const
{
  const Eigen::Isometry3d middle =
      MotionCorrection(found.knots)
          .poseAt((found.knots.stamps.front() + found.knots.stamps.back()) / 2);
  MotionStart start;
  start.knots = restingKnots(scan, middle);
  start.held.poses = {middle};
  start.held.stamps = {scan.stamp};
  // What the surfaces do not fix stays; a thousandth of the noise is rigid.
  start.terms.push_back(rigidTerm(0, 1, map_options_.cell));
  for (std::size_t k = 0; k + 1 < start.knots.poses.size(); ++k)
    start.terms.push_back(rigidTerm(k + 1, k + 2, 1e-3 * icp_.noise));
  MotionIcpResult rigid = motionIcp(map_, half, start, icp_);
  for (auto& pose : rigid.knots.poses)
    pose = rigid.knots.poses.front();
  return rigid;
}

/** \return whether a scan, or the last ones with it, agrees clearly better with its motion */
bool
MotionTracker::isSure(const AgreementChange& gain) const
{
  std::vector<AgreementChange> last = {gain};
  for (std::size_t i = scans_.size(); i > 0 && last.size() < kWindow; --i)
    last.push_back(scans_[i - 1].gain);
  return gain.isGain(kSureDeviations) || pooled(last).isGain(kSureDeviations);
}

/** \param[in] half points that took no part in finding it
 * \param[in,out] found gets gain and reason */
bool
MotionTracker::isMoved(const MovingScan& scan,
                       const TimedPoints& half,
                       const Trajectory& rigid,
                       TrackedScan& found) const
{
  const auto fit = [&](const Trajectory& knots) {
    return fitOf(
        map_, worldPoints(half, knots, icp_.num_threads), icp_.noise, icp_.num_threads);
  };
  const std::vector<double> still = fit(rigid);
  found.fit = fit(found.knots);
  found.gain = changeOf(still, found.fit, half.points, cube_);
  const Points undone = undoMotion(half, found.knots, scan.stamp, icp_.num_threads);
  std::vector<double> ways;
  for (std::size_t i = 0; i < undone.size(); ++i)
    ways.push_back((undone[i] - half.points[i]).norm());
  const double way = upperMedian(std::move(ways)) / icp_.noise;
  const bool is_sure = isSure(found.gain);
  found.is_guide = true;
  if (way < kLeastNoises || (way < kSureNoises && !is_sure))
    found.reason = "no motion that could be seen";
  else if (found.gain.isLoss()) {
    found.is_guide = false;
    found.reason = "its points agree less with the motion undone";
  }
  else if (!isContinued(scan) && !assumes_moving_ && !is_sure)
    found.reason = "its points do not agree clearly better with the motion undone";
  if (!found.reason.empty())
    found.fit = still;
  return found.reason.empty();
}

/** Tells how much better the pose is than that of the odometry, if there is one. */
void
MotionTracker::compareWithOdometry(const TimedPoints& half, TrackedScan& found) const
{
  if (!last_step_)
    return;
  const Eigen::Isometry3d pose = found.pose();
  const Eigen::Isometry3d there = scans_.back().pose() * *last_step_;
  found.odometry_error = (there.translation() - pose.translation()).norm();
  Trajectory moved = found.knots;
  for (Eigen::Isometry3d& knot : moved.poses)
    knot = there * (pose.inverse() * knot);
  const auto fit = [&](const Trajectory& knots) {
    return fitOf(
        map_, worldPoints(half, knots, icp_.num_threads), icp_.noise, icp_.num_threads);
  };
  found.odometry = changeOf(fit(moved), fit(found.knots), half.points, cube_);
}

/** \return how a scan is found from a start, and how well its points lie then */
MotionTracker::Attempt
MotionTracker::attempt(const Trajectory& rough,
                       bool goes_on,
                       const TimedPoints& half) const
{
  const Trajectory first =
      rough.poses.size() == 2 ? rough : refined(rough, goes_on, half);
  const MotionStart start = startOf(first, goes_on);
  Attempt attempt;
  attempt.found = motionIcp(map_, half, start, icp_);
  if (!isOk(attempt.found))
    return attempt;
  attempt.fit = meanOf(fitOf(map_,
                             worldPoints(half, attempt.found.knots, icp_.num_threads),
                             icp_.noise,
                             icp_.num_threads));
  std::vector<Eigen::Isometry3d> world = start.held.poses;
  world.insert(
      world.end(), attempt.found.knots.poses.begin(), attempt.found.knots.poses.end());
  for (const ElasticTerm& term : start.terms)
    attempt.broken += term.cost(world);
  // A point that lies on a plane is about e times as likely as one that does not.
  attempt.score =
      static_cast<double>(half.points.size()) / 2 * attempt.fit - attempt.broken;
  return attempt;
}

/** \return the share of points that usually lies on the map; 0 if that is not known */
double
MotionTracker::usualFit() const
{
  std::vector<double> fits;
  for (std::size_t i = scans_.size(); i > 0 && fits.size() < kWindow; --i)
    if (!scans_[i - 1].fit.empty())
      fits.push_back(meanOf(scans_[i - 1].fit));
  return upperMedian(std::move(fits));
}

/** From the start that fits best; if what is found is much worse than usual, or than no motion,
 * or too sudden, from the others, and freely. */
MotionIcpResult
MotionTracker::match(const MovingScan& scan,
                     const TimedPoints& half,
                     MotionIcpResult& rigid) const
{
  constexpr double kUsual = 0.9; // fits of good scans differ by less
  constexpr double kSudden = 10; // rules are broken by as much once in e^10 scans
  std::vector<Trajectory> starts = startsOf(scan);
  sortByFit(half, starts);
  Attempt best = attempt(starts[0], true, half);
  const auto take = [&](const Attempt& other) {
    if (other.score > best.score)
      best = other;
  };
  for (std::size_t i = 1;
       i < starts.size() && (best.fit < kUsual * usualFit() || best.broken > kSudden);
       ++i)
    for (const bool goes_on : {true, false})
      take(attempt(starts[i], goes_on, half));
  if (!isOk(best.found))
    return best.found;
  rigid = matchRigid(scan, half, best.found);
  const double still = meanOf(fitOf(map_,
                                    worldPoints(half, rigid.knots, icp_.num_threads),
                                    icp_.noise,
                                    icp_.num_threads));
  if (isOk(rigid) && best.fit < still)
    take(attempt(rigid.knots, false, half));
  return best.found;
}

/** \return the largest turn between two knots that the odometry tells of [rad]; 0 without any */
double
MotionTracker::turnOfOdometry(const MovingScan& scan) const
{
  const Trajectory times = restingKnots(scan, Eigen::Isometry3d::Identity());
  const double step = times.stamps[1] - times.stamps[0];
  const auto turn = [&](const std::optional<Eigen::Isometry3d>& motion, double time) {
    return motion && time > 0 ? rotationAngle(motion->linear()) * step / time : 0;
  };
  return std::max(turn(scan.step, scan.step_time), turn(last_step_, last_step_time_));
}

/** Takes a scan for rigid that turned too fast for straight steps between knots. */
void
MotionTracker::leaveTurned(double turn, TrackedScan& found)
{
  found.is_moved = found.is_guide = false;
  found.reason = "it turns by " + std::to_string(std::lround(turn * 180 / M_PI)) +
                 " deg between two knots, more than a right angle";
}

TrackedScan
MotionTracker::find(const MovingScan& scan)
{
  TrackedScan found;
  found.stamp = scan.stamp;
  found.knots = restingKnots(scan, scans_.back().pose());
  found.sample = sampler_.draw(scan.measured, sampleSize(found.knots));
  const TimedPoints half = halfOf(found.sample, 0);
  const double told = turnOfOdometry(scan);
  MotionIcpResult match, rigid;
  if (told > kLargestTurn) {
    match.knots = best(startsOf(scan), half);
    match = rigid = matchRigid(scan, half, match);
  }
  else
    match = this->match(scan, half, rigid);
  const double overlap =
      static_cast<double>(match.pairs) / static_cast<double>(half.points.size());
  found.is_matched = isOk(match) && overlap >= kLeastOverlap;
  if (!found.is_matched) {
    const Trajectory start = best(startsOf(scan), half);
    found.reason = "it does not meet the scans before";
    found.knots = restingKnots(scan, MotionCorrection(start).poseAt(scan.stamp));
    return found;
  }
  found.knots = match.knots;
  found.moved_pose = found.pose();
  found.rigid_pose = rigid.knots.poses.front();
  compareWithOdometry(halfOf(found.sample, 1), found);
  const double turn = std::max(told, largestTurn(match.knots));
  if (turn > kLargestTurn)
    leaveTurned(turn, found);
  else
    found.is_moved = isMoved(scan, halfOf(found.sample, 1), rigid.knots, found);
  if (!found.is_moved)
    found.knots = rigid.knots;
  return found;
}

} // namespace pcl6d::slam6d
