// SPDX-License-Identifier: BSD-3-Clause
// Prediction and match of a sweep, and the update of the expected deviations.
#include "sweep_track.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/pose.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

using odometry::kGateDeviations;
using odometry::Matrix6;
using odometry::SweepMatch;
using odometry::SweepMotion;
using odometry::SweepPrior;

namespace {
/** Deviation of the motion within a sweep from a linear change of velocity, as a share of the
 * deviation of predictions: an eighth is the sagitta of a sudden change. */
constexpr double kUnevenShare = 0.125;

/** Most times that a match with an unexpected change of velocity widens the prior. */
constexpr int kWidenings = 2;

/** Factor per sweep by which past values lose weight: about the last ten count. At the start the
 * first deviations are guesses, and are forgotten sooner. */
constexpr double kMemory = 0.9, kMemoryAtStart = 0.5;
constexpr std::size_t kWarmUp = 10; ///< sweeps

/** Factor on the standard deviations of the priors in a second attempt. */
constexpr double kDisconnecting = 10;

/** Shares of the usual fit: below the first, a match is tried again with the widest gate; below the
 * second, or below the least overlap, the sweep is not matched. */
constexpr double kRetryBelow = 0.9, kMatchedAbove = 0.7, kLeastOverlap = 0.25;

/** Deviation of distances from surfaces, in usual deviations. Calibrated by simulated drives
 * (corridor, campus, multilevel with vlp16). Right poses: up to 2 where points have times, up to
 * 10 without times at the begin of a bend of 10 degrees a sweep, with at least 0.74 of the usual
 * overlap. False poses after ten missing sweeps: 5 to 38, with 0.26 to 0.84 of the usual overlap.
 * From kSuspicious on, other poses are tried; where the sweep has lost overlap, too, or from
 * kElsewhere on, it is not matched. */
constexpr double kSuspicious = 3, kElsewhere = 12, kOverlapElsewhere = 0.7;

/** A pose replaces a suspicious one if it halves the deviation: chance changes it by a tenth. */
constexpr double kClearlyNearer = 2;

/** A sweep follows without a pause if the time in between is at most this share of
 * its own duration. */
constexpr double kNoPause = 0.1;

/** [sweeps] Longest pause that counts; the velocity after a longer pause is unknown anyway. */
constexpr double kLongestPause = 20;
} // namespace

/** \return whether stamps tell a pause before the sweep, or sweeps before it were lost */
bool
SweepTracker::Track::hasPause(const Current& now) const
{
  const double steps =
      (now.begin - (now.is_timed ? last_end_ : last_begin_ + last_length_)) /
      last_length_;
  return steps > kNoPause || num_lost_ > 0;
}

/** \return the motion at constant velocity, or by the prediction \param[in] pause [sweeps] before it
 * \param[in] is_open surfaces fix no velocity: it follows from the prediction, too */
SweepMotion
SweepTracker::Track::expectedMotion(const Current& now,
                                    double pause,
                                    bool is_open) const
{
  const Eigen::Isometry3d from = now.is_timed ? last_.end() : last_.begin;
  SweepMotion motion;
  motion.velocity = now.is_timed ? Twist(last_.velocity * (now.length / last_length_))
                                 : last_.velocity;
  if (!now.prediction) {
    motion.begin = exactlyRigid(from * motionFromTwist(pause * last_.velocity));
    return motion;
  }
  motion.begin = exactlyRigid( // the prediction is at the stamp
      *now.prediction * motionFromTwist(now.span.begin / now.length * motion.velocity));
  if (is_open) {
    const double steps = (now.begin - last_begin_) / now.length;
    motion.velocity =
        twistFromMotion(last_.begin.inverse() * motion.begin) / std::max(steps, 0.1);
  }
  return motion;
}

/** \return the expected motion with its uncertainty */
SweepPrior
SweepTracker::Track::priorOf(const Current& now) const
{
  SweepPrior prior;
  const double pause = now.begin - (now.is_timed ? last_end_ : last_begin_);
  const double steps = std::clamp(pause / last_length_, 0.0, kLongestPause);
  prior.holds_open = now.prediction && is_open_;
  const bool goes_on = now.is_timed && steps <= kNoPause && !prior.holds_open;
  prior.motion = expectedMotion(now, goes_on ? 0 : steps, prior.holds_open);
  prior.goes_on = goes_on && num_lost_ == 0;
  prior.centre = prior.motion.end().translation();
  const auto wider = 1 + static_cast<double>(num_lost_);
  prior.translation = wider * std::sqrt(translation_sq_);
  prior.rotation = wider * std::sqrt(rotation_sq_);
  // Changes of velocity add up as a random walk.
  const double spread =
      goes_on ? kUnevenShare : std::max(1.0, steps * std::sqrt(steps));
  prior.gate = kGateDeviations * std::max(1.0, spread) *
               (prior.translation + range_ * prior.rotation);
  Matrix6 covariance = Matrix6::Zero();
  const double t = spread * prior.translation, r = spread * prior.rotation;
  covariance.diagonal() << Eigen::Vector3d::Constant(t * t),
      Eigen::Vector3d::Constant(r * r);
  if (goes_on && num_lost_ == 0 && num_matched_ > 1) {
    const odometry::Matrix12 before =
        odometry::movedCovariance(last_covariance_, last_centre_, prior.centre);
    const Matrix6 end = before.bottomRightCorner<6, 6>(),
                  both = before.bottomLeftCorner<6, 6>();
    covariance += end;
    if (!now.prediction) { // else the begin is not that of the sweep before
      prior.velocity_with_begin = end - both.transpose();
      prior.velocity_covariance =
          end + before.topLeftCorner<6, 6>() - both - both.transpose();
    }
  }
  prior.begin_information = inverted<6>(covariance);
  return prior;
}

SweepMatch
SweepTracker::Track::match(const LocalMap& map,
                           const Current& now,
                           const SweepPrior& prior,
                           double gate) const
{
  odometry::SweepMatchOptions options;
  options.gate = gate;
  options.noise = noise_;
  options.correlation = correlation_;
  options.num_threads = options_.num_threads;
  SweepMatch found = odometry::matchSweep(map, now.sample, prior, options);
  if (!now.is_timed) { // half of the turn, on the mean over the sweep
    const double turn = distanceBetween(last_.begin, found.motion.begin).rotation;
    found.distortion = 0.5 * range_ * std::abs(turn - last_.velocity.tail<3>().norm());
  }
  return found;
}

bool
SweepTracker::Track::isMatched(const SweepMatch& match) const
{
  return (match.status == Status::kOk || match.status == Status::kMaxIterations) &&
         match.overlap >= kLeastOverlap && match.fit >= kMatchedAbove * usual_fit_ &&
         !isElsewhere(match);
}

/** \return the deviation of distances, in usual ones; surfaces are not expected to be thinner than
 * the noise */
double
SweepTracker::Track::deviationOf(const SweepMatch& match) const
{
  return usual_deviation_ > 0 ? match.deviation / std::max(1.0, usual_deviation_) : 1;
}

/** The fit alone does not tell: its limit for a point grows with the deviation. At the begin of a
 * bend, sweeps without times are distorted by the turn, and that explains deviations.
 * \return whether the sweep only seems to fit, e.g. shifted along a corridor because sweeps are
 * missing */
bool
SweepTracker::Track::isElsewhere(const SweepMatch& match) const
{
  const double deviation =
      std::min(deviationOf(match),
               match.deviation * noise_ / std::max(match.distortion, noise_));
  return deviation > kElsewhere || (deviation > kSuspicious &&
                                    match.overlap < kOverlapElsewhere * usual_overlap_);
}

/** Widens the prior to the change of velocity of a match, if larger than expected: at the begin of
 * a bend the prior would hold the match back. \return whether the prior was widened */
bool
SweepTracker::Track::widen(const SweepMatch& found, SweepPrior& prior) const
{
  constexpr double kExpected = 2; // deviations: exceeded in one of twenty
  const Twist change = found.motion.velocity - prior.motion.velocity;
  const double translation = change.head<3>().norm(),
               rotation = change.tail<3>().norm();
  if (!(translation > kExpected * prior.translation ||
        rotation > kExpected * prior.rotation))
    return false;
  prior.translation = std::max(prior.translation, translation);
  prior.rotation = std::max(prior.rotation, rotation);
  prior.gate =
      std::max(prior.gate, kGateDeviations * (translation + range_ * rotation));
  Matrix6 covariance = inverted<6>(prior.begin_information);
  const double t = kUnevenShare * prior.translation, r = kUnevenShare * prior.rotation;
  covariance.diagonal() +=
      (Twist() << Eigen::Vector3d::Constant(t * t), Eigen::Vector3d::Constant(r * r))
          .finished();
  prior.begin_information = inverted<6>(covariance);
  return true;
}

/** \return whether another match is to replace the best so far. After a pause much is new even at
 * the right pose: the fit decides, and the first match stays unless another is clearly better.
 * Otherwise the overlap decides */
bool
SweepTracker::Track::isBetter(const SweepMatch& found,
                              const SweepMatch& best,
                              bool goes_on) const
{
  if (!isMatched(found) || !isMatched(best))
    return isMatched(found);
  if (deviationOf(best) > kSuspicious || deviationOf(found) > kSuspicious)
    return kClearlyNearer * found.deviation < best.deviation &&
           found.overlap >= best.overlap;
  return goes_on ? found.overlap > best.overlap : kRetryBelow * found.fit > best.fit;
}

/** Matches from constant velocity with the adaptive gate. Where the velocity changes more than
 * expected, again with a wider prior, and with a sudden change. \param[in,out] wider prior */
SweepMatch
SweepTracker::Track::matchGated(const Current& now, SweepPrior& wider) const
{
  const SweepPrior prior = wider;
  const auto gated = [&](const SweepPrior& start) {
    return match(
        now, start, std::clamp(start.gate, 2 * map_->options().voxel, widestGate()));
  };
  SweepMatch best = gated(prior);
  bool is_expected = true;
  for (int round = 0; round < kWidenings; ++round) {
    SweepPrior next = wider;
    if (!widen(best, next))
      break;
    is_expected = false;
    const SweepMatch found = gated(next);
    if (found.overlap < best.overlap) // a false match would widen the prior without end
      break;
    best = found;
    wider = next;
  }
  if (!is_expected)
    tryUneven(now, prior, best);
  return best;
}

/** Matches from constant velocity; where the fit is worse than usual, again with the widest gate
 * and a weak prior, from constant velocity and from the end of the sweep before. If nothing fits,
 * sweeps may be missing: further along the way. */
SweepMatch
SweepTracker::Track::bestMatch(const Current& now, const SweepPrior& prior) const
{
  const double voxel = map_->options().voxel, widest = widestGate();
  SweepPrior wider = prior;
  SweepMatch best = matchGated(now, wider);
  const bool is_usual = isMatched(best) && deviationOf(best) <= kSuspicious;
  if (is_usual && best.fit >= kRetryBelow * usual_fit_ &&
      (best.overlap >= kRetryBelow * usual_overlap_ || hasPause(now)))
    return best;
  const auto attempt = [&](const SweepPrior& start) {
    const SweepMatch found = match(now, start, widest);
    if (isBetter(found, best, prior.goes_on))
      best = found;
  };
  SweepPrior loose = wider;
  loose.translation = std::max(kDisconnecting * wider.translation, widest);
  loose.rotation = std::max(kDisconnecting * wider.rotation, widest / range_);
  loose.begin_information /= kDisconnecting * kDisconnecting;
  loose.velocity_covariance.setZero();
  loose.velocity_with_begin.setZero();
  attempt(loose);
  loose.motion.begin = exactlyRigid(now.is_timed ? last_.end() : last_.begin);
  if (prior.goes_on)
    loose.motion.velocity.setZero();
  attempt(loose);
  tryUneven(now, prior, best);
  const bool is_bend = best.distortion > voxel; // shows new parts, too
  if (!isMatched(best) ||
      (!is_bend && (!hasPause(now) || deviationOf(best) > kSuspicious)))
    tryFurther(now, prior, loose, best);
  return best;
}

/** Matches with a velocity that changes suddenly within the sweep: a robot that turns on the spot,
 * or a corner of a simulated way. Starts from the best match, near where the change comes early, and
 * from the expected motion, near where it comes late. */
void
SweepTracker::Track::tryUneven(const Current& now,
                               const SweepPrior& prior,
                               SweepMatch& best) const
{
  if (!now.is_timed || best.status == Status::kTooFewPairs)
    return;
  SweepPrior wider = prior;
  widen(best, wider);
  const double gate = std::clamp(wider.gate, 2 * map_->options().voxel, widestGate());
  for (const SweepMotion& start : {best.motion, prior.motion}) {
    wider.uneven = start;
    const SweepMatch found = match(now, wider, gate);
    if (isBetter(found, best, true))
      best = found;
  }
}

/** Matches further along the way, where more of the sweep is seen: sweeps may be missing without a
 * stamp that tells. \param[in] loose a weak prior \param[in,out] best match */
void
SweepTracker::Track::tryFurther(const Current& now,
                                const SweepPrior& prior,
                                SweepPrior loose,
                                SweepMatch& best) const
{
  const auto isUsual = [&](const SweepMatch& one) {
    return isMatched(one) && deviationOf(one) <= kSuspicious;
  };
  const auto isWhole = [&] {
    return isUsual(best) && best.overlap >= kRetryBelow * usual_overlap_;
  };
  // [sweeps] The widest gate reaches twice as far as from one start to the next.
  const double between = std::max(
      1.0, 0.5 * widestGate() / std::max(last_.velocity.head<3>().norm(), noise_));
  loose.motion.velocity = prior.motion.velocity;
  for (double missing = between; missing <= kLongestPause && !isWhole();
       missing += between) {
    loose.motion.begin =
        exactlyRigid(prior.motion.begin * motionFromTwist(missing * last_.velocity));
    loose.centre = loose.motion.end().translation();
    SweepMatch found = match(now, loose, widestGate());
    const bool sees_more = kRetryBelow * found.overlap > best.overlap &&
                           found.fit >= best.fit && isUsual(found);
    if (!sees_more && (isMatched(best) || !isMatched(found)))
      continue;
    best = found;
    best.is_further = true;
  }
}

/** Updates the usual deviation of the velocity from its prediction, and the usual
 * overlap and fit. */
void
SweepTracker::Track::learn(const SweepPrior& prior, const SweepMatch& match)
{
  const Twist change = match.motion.velocity - prior.motion.velocity;
  const double floor_sq = noise_ * noise_;
  const double memory = num_matched_ > kWarmUp ? kMemory : kMemoryAtStart;
  const auto mixed = [memory](double before, double now) {
    return memory * before + (1 - memory) * now;
  };
  // A part of the change is the error of the velocity before.
  const Twist known_sq = prior.velocity_covariance.diagonal();
  const auto beyond = [](double change_sq, double explained_sq) {
    return std::max(0.0, change_sq - explained_sq);
  };
  translation_sq_ =
      std::max(floor_sq,
               mixed(translation_sq_,
                     beyond(change.head<3>().squaredNorm(), known_sq.head<3>().sum())));
  rotation_sq_ =
      std::max(floor_sq / (range_ * range_),
               mixed(rotation_sq_,
                     beyond(change.tail<3>().squaredNorm(), known_sq.tail<3>().sum())));
  usual_overlap_ = usual_overlap_ > 0
                       ? kMemory * usual_overlap_ + (1 - kMemory) * match.overlap
                       : match.overlap;
  usual_deviation_ = usual_deviation_ > 0
                         ? kMemory * usual_deviation_ + (1 - kMemory) * match.deviation
                         : match.deviation;
  usual_fit_ =
      usual_fit_ > 0 ? kMemory * usual_fit_ + (1 - kMemory) * match.fit : match.fit;
}

} // namespace pcl6d
