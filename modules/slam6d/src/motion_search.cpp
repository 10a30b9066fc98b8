// SPDX-License-Identifier: BSD-3-Clause
// What is found of the motion within a scan, and whether it counts.
#include "motion_tracker.h"

#include <pcl6d/common/median.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/filters/motion_correction.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::slam6d {

namespace {
/** A motion that moves the median point less than this share of the noise cannot be seen; one
 * that moves it by two, as errors of matching may, must show by points that agree clearly better. */
constexpr double kLeastNoises = 0.25, kSureNoises = 2;

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

/** \return the mean of those that have a plane: others, where nothing is known yet, speak neither
 * for nor against. A third at least counts: few that agree are chance. */
double
onPlanes(const std::vector<double>& fit)
{
  const auto known = static_cast<double>(
      std::count_if(fit.begin(), fit.end(), [](double f) { return f > 0; }));
  const auto count = static_cast<double>(fit.size());
  return fit.empty() ? 0 : meanOf(fit) * count / std::max(known, count / 3);
}

bool
isOk(const MotionIcpResult& result)
{
  return result.status == Status::kOk || result.status == Status::kMaxIterations;
}

} // namespace

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
  if (!scans_.back().step)
    return;
  const Eigen::Isometry3d pose = found.pose();
  const Eigen::Isometry3d there = scans_.back().pose() * *scans_.back().step;
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
MotionTracker::attempt(const Trajectory& start,
                       bool goes_on,
                       const TimedPoints& half) const
{
  Attempt attempt;
  attempt.found = motionIcp(map_, half, startOf(start, goes_on), icp_);
  if (!isOk(attempt.found))
    return attempt;
  attempt.fit = onPlanes(fitOf(map_,
                               worldPoints(half, attempt.found.knots, icp_.num_threads),
                               icp_.noise,
                               icp_.num_threads));
  // What was looked for freely is to go on, too.
  const MotionStart rules = startOf(start, true);
  std::vector<Eigen::Isometry3d> world = rules.held.poses;
  world.insert(
      world.end(), attempt.found.knots.poses.begin(), attempt.found.knots.poses.end());
  for (const ElasticTerm& term : rules.terms)
    attempt.broken += term.cost(world);
  // A point that lies on a plane is about e times as likely as one that does not.
  attempt.score =
      static_cast<double>(half.points.size()) / 2 * attempt.fit - attempt.broken;
  return attempt;
}

/** \return the better one of what is found of all of a scan, and then step after step */
MotionTracker::Attempt
MotionTracker::attemptBoth(const Trajectory& rough,
                           bool goes_on,
                           const TimedPoints& half) const
{
  if (rough.poses.size() == 2)
    return attempt(rough, goes_on, half);
  Attempt whole = attempt(refined(rough, goes_on, half), goes_on, half);
  const Trajectory& begin = isOk(whole.found) ? whole.found.knots : rough;
  Attempt stepwise = attempt(grown(begin, goes_on, half), goes_on, half);
  return stepwise.score > whole.score ? stepwise : whole;
}

/** \return the share of points that usually lies on the map; 0 if that is not known */
double
MotionTracker::usualFit() const
{
  std::vector<double> fits;
  for (std::size_t i = scans_.size(); i > 0 && fits.size() < kWindow; --i)
    if (!scans_[i - 1].fit.empty())
      fits.push_back(onPlanes(scans_[i - 1].fit));
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
  Attempt best = attemptBoth(starts[0], true, half);
  const auto take = [&](const Attempt& other) {
    if (other.score > best.score)
      best = other;
  };
  const double usual = usualFit();
  for (std::size_t i = 1;
       i < starts.size() &&
       (usual == 0 || best.fit < kUsual * usual || best.broken > kSudden);
       ++i)
    for (const bool goes_on : {true, false})
      take(attemptBoth(starts[i], goes_on, half));
  if (!isOk(best.found))
    return best.found;
  rigid = matchRigid(scan, half, best.found);
  const double still = onPlanes(fitOf(map_,
                                      worldPoints(half, rigid.knots, icp_.num_threads),
                                      icp_.noise,
                                      icp_.num_threads));
  if (isOk(rigid) && best.fit < still)
    take(attemptBoth(rigid.knots, false, half));
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
  return std::max(turn(scan.step, scan.step_time),
                  turn(scans_.back().step, scans_.back().step_time));
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
