// SPDX-License-Identifier: BSD-3-Clause
// Prediction and match of a sweep, and the update of the expected deviations.
#include "sweep_track.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/pose.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

using odometry::Matrix6;
using odometry::SweepMatch;
using odometry::SweepPrior;

namespace {
/** The gate, in standard deviations of the predictions (KISS-ICP). */
constexpr double kGateDeviations = 3;

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

/** A sweep follows without a pause if the time in between is at most this share of
 * its own duration. */
constexpr double kNoPause = 0.1;

/** [sweeps] Longest pause that counts; the velocity after a longer pause is unknown anyway. */
constexpr double kLongestPause = 20;
} // namespace

/** \return the motion at constant velocity with its uncertainty */
SweepPrior
SweepTracker::Track::priorOf(const Current& now) const
{
  SweepPrior prior;
  const double per_time = 1 / last_length_;
  const double pause = now.begin - (now.is_timed ? last_end_ : last_begin_);
  const double steps = std::clamp(pause * per_time, 0.0, kLongestPause);
  const bool goes_on = now.is_timed && steps <= kNoPause;
  const Eigen::Isometry3d from = now.is_timed ? last_.end() : last_.begin;
  prior.motion.begin =
      now.prediction ? *now.prediction
      : goes_on      ? exactlyRigid(from)
                     : exactlyRigid(from * motionFromTwist(steps * last_.velocity));
  prior.motion.velocity =
      now.is_timed ? Twist(last_.velocity * (now.length * per_time)) : last_.velocity;
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
  if (goes_on && num_lost_ == 0 && num_matched_ > 1)
    covariance += inverted<6>(odometry::movedInformation(
        end_information_, information_centre_, prior.centre));
  prior.begin_information = inverted<6>(covariance);
  return prior;
}

SweepMatch
SweepTracker::Track::match(const Current& now,
                           const SweepPrior& prior,
                           double gate) const
{
  odometry::SweepMatchOptions options;
  options.gate = gate;
  options.noise = noise_;
  options.correlation = correlation_;
  options.num_threads = options_.num_threads;
  return odometry::matchSweep(*map_, now.sample, prior, options);
}

bool
SweepTracker::Track::isMatched(const SweepMatch& match) const
{
  return (match.status == Status::kOk || match.status == Status::kMaxIterations) &&
         match.overlap >= kLeastOverlap && match.fit >= kMatchedAbove * usual_fit_;
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

/** Matches from constant velocity; where the fit is worse than usual, again with the widest gate
 * and a weak prior, from constant velocity and from the end of the sweep before. */
SweepMatch
SweepTracker::Track::bestMatch(const Current& now, const SweepPrior& prior) const
{
  const double voxel = map_->options().voxel;
  const double widest = 0.5 * std::ldexp(voxel, map_->options().levels - 1);
  const auto gated = [&](const SweepPrior& start) {
    return match(now, start, std::clamp(start.gate, 2 * voxel, widest));
  };
  SweepMatch best = gated(prior);
  SweepPrior wider = prior;
  for (int round = 0; round < kWidenings && widen(best, wider); ++round)
    best = gated(wider);
  if (isMatched(best) && best.fit >= kRetryBelow * usual_fit_ &&
      (best.overlap >= kRetryBelow * usual_overlap_ || !prior.goes_on))
    return best;
  // After a pause much is new even at the right pose: the fit decides, and the first match stays
  // unless another is clearly better. Otherwise the overlap decides.
  const auto attempt = [&](const SweepPrior& start) {
    const SweepMatch found = match(now, start, widest);
    const bool is_better = prior.goes_on ? found.overlap > best.overlap
                                         : kRetryBelow * found.fit > best.fit;
    if (isMatched(found) && (is_better || !isMatched(best)))
      best = found;
  };
  SweepPrior loose = wider;
  loose.translation = std::max(kDisconnecting * wider.translation, widest);
  loose.rotation = std::max(kDisconnecting * wider.rotation, widest / range_);
  loose.begin_information /= kDisconnecting * kDisconnecting;
  attempt(loose);
  loose.motion.begin = exactlyRigid(now.is_timed ? last_.end() : last_.begin);
  if (prior.goes_on)
    loose.motion.velocity.setZero();
  attempt(loose);
  return best;
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
  translation_sq_ =
      std::max(floor_sq, mixed(translation_sq_, change.head<3>().squaredNorm()));
  rotation_sq_ = std::max(floor_sq / (range_ * range_),
                          mixed(rotation_sq_, change.tail<3>().squaredNorm()));
  usual_overlap_ = usual_overlap_ > 0
                       ? kMemory * usual_overlap_ + (1 - kMemory) * match.overlap
                       : match.overlap;
  usual_fit_ =
      usual_fit_ > 0 ? kMemory * usual_fit_ + (1 - kMemory) * match.fit : match.fit;
}

} // namespace pcl6d
