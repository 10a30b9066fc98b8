// SPDX-License-Identifier: BSD-3-Clause
// Estimates the motion within a scan, and tests whether the scan is to be deskewed.
#include <pcl6d/common/angle.h>
#include <pcl6d/common/median.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/deskew/motion_correction.h>
#include <pcl6d/deskew/motion_tracker.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::deskew {

namespace {
/** Shares of the noise. Below the first, the motion of the median point is undetectable. Below the
 * second it is within matching errors, and the points must agree clearly better with the motion. */
constexpr double kLeastNoises = 0.25, kSureNoises = 2;

constexpr double kLeastOverlap =
    0.1; ///< share of points on planes, like in Slam6DOptions
constexpr std::size_t kWindow = 10;   ///< number of scans tested together
constexpr double kSureDeviations = 5; ///< large, because many scans are tested, see
                                      ///< StageAgreement

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

/** \return the mean over the points with a plane; points in unmapped space do not count. The
 * denominator is at least a third of all points: a few that agree may be chance. */
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

/** Matches a scan as a rigid body. */
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
  // Directions without constraint keep their start value; 1e-3 of the noise counts as rigid.
  start.terms.push_back(rigidTerm(0, 1, map_options_.cell));
  for (std::size_t k = 0; k + 1 < start.knots.poses.size(); ++k)
    start.terms.push_back(rigidTerm(k + 1, k + 2, 1e-3 * icp_.noise));
  MotionIcpResult rigid = motionIcp(map_, half, start, icp_);
  for (auto& pose : rigid.knots.poses)
    pose = rigid.knots.poses.front();
  return rigid;
}

/** \return whether a scan, alone or with the latest scans, agrees clearly better with its motion */
bool
MotionTracker::isSure(const AgreementChange& gain) const
{
  std::vector<AgreementChange> last = {gain};
  for (std::size_t i = scans_.size(); i > 0 && last.size() < kWindow; --i)
    last.push_back(scans_[i - 1].gain);
  return gain.isGain(kSureDeviations) || pooled(last).isGain(kSureDeviations);
}

/** \param[in] half points not used for the estimation
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
    found.rejection = {RejectReason::kNoMotionSeen, way, kLeastNoises};
  else if (found.gain.isLoss()) {
    found.is_guide = false;
    found.rejection = {
        RejectReason::kDeskewedAgreesLess, found.gain.after, found.gain.before};
  }
  else if (!isContinued(scan) && !assumes_moving_ && !is_sure)
    found.rejection = {
        RejectReason::kDeskewedNotBetter, found.gain.after, found.gain.before};
  if (found.rejection)
    found.fit = still;
  return !found.rejection;
}

/** Compares the pose with the odometry's, if available: how much better the points agree. */
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

/** \return the match from a start, and how well the points lie on the map then */
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
  // A match without motion prior is scored with the prior, too.
  const MotionStart rules = startOf(start, true);
  std::vector<Eigen::Isometry3d> world = rules.held.poses;
  world.insert(
      world.end(), attempt.found.knots.poses.begin(), attempt.found.knots.poses.end());
  for (const ElasticTerm& term : rules.terms)
    attempt.broken += term.cost(world);
  // A point on a plane is about e times as likely as a point off every plane.
  attempt.score =
      static_cast<double>(half.points.size()) / 2 * attempt.fit - attempt.broken;
  return attempt;
}

/** \return the better of two matches: the scan as a whole, and grown knot by knot */
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

/** \return the usual share of points on the map; 0: unknown */
double
MotionTracker::usualFit() const
{
  std::vector<double> fits;
  for (std::size_t i = scans_.size(); i > 0 && fits.size() < kWindow; --i)
    if (!scans_[i - 1].fit.empty())
      fits.push_back(onPlanes(scans_[i - 1].fit));
  return upperMedian(std::move(fits));
}

/** Matches from the best-fitting start. If the result fits much worse than usual or than a rigid
 * scan, or is too sudden, the remaining starts follow, also without motion prior. */
MotionIcpResult
MotionTracker::match(const MovingScan& scan,
                     const TimedPoints& half,
                     MotionIcpResult& rigid) const
{
  constexpr double kUsual = 0.9; // fits of good scans differ by less
  constexpr double kSudden = 10; // a motion prior is violated by this much once in e^10
                                 // scans
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

/** \return the largest turn between two knots by odometry [rad]; 0 without odometry */
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

/** Treats a scan as rigid that turned too fast for chords between knots. */
void
MotionTracker::leaveTurned(double turn, TrackedScan& found)
{
  found.is_moved = found.is_guide = false;
  found.rejection = {RejectReason::kTurnTooLarge,
                     std::round(turn / kDegree),
                     std::round(kLargestTurn / kDegree)};
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
    found.rejection = {RejectReason::kNoPreviousScanMet, overlap, kLeastOverlap};
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

} // namespace pcl6d::deskew
