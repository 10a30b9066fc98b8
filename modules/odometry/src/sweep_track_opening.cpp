// SPDX-License-Identifier: BSD-3-Clause
// The first sweeps of a map, and the motion within the first one.
#include "sweep_track.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/pose.h>

#include <algorithm>
#include <utility>

namespace pcl6d {

using odometry::SweepMatch;
using odometry::SweepMotion;
using odometry::SweepPrior;

namespace {
/** Sweeps from the first on that are tracked again backward: by then, the tracker has learned the
 * usual deviations (kWarmUp). */
constexpr std::size_t kSweepsOfOpening = 10;
} // namespace

/** The map begins with this sweep, assumed at rest. */
TrackedSweep
SweepTracker::Track::begin(const Current& now)
{
  if (num_sweeps_ > 1 && num_lost_ > 0)
    ++segment_;
  const Eigen::Isometry3d predicted =
      now.prediction ? *now.prediction : exactlyRigid(last_.end());
  last_ = SweepMotion();
  last_.begin = predicted;
  last_begin_ = now.begin;
  last_length_ = now.length;
  last_end_ = now.begin + (now.is_timed ? now.length : 0);
  num_matched_ = 1;
  num_lost_ = 0;
  is_open_ = true;
  usual_fit_ = usual_overlap_ = usual_deviation_ = 0;
  map_ = emptyMap();
  const auto places = reducedPlaces(now, last_);
  addToMap(places, last_);
  const double widest = widestGate();
  translation_sq_ = widest * widest;
  rotation_sq_ = translation_sq_ / (range_ * range_);
  opening_ = {now};
  opening_motions_ = {last_};
  backward_start_.reset();
  TrackedSweep first = placed(now, last_, places);
  first.status = SweepStatus::kFirst;
  keyframe_ = VoxelNumbers();
  markKeyframe(now, last_, places, first);
  corrected_ = {first};
  return first;
}

/** The motion within the first sweep is taken from the motion between the first and the second
 * sweep; both are matched anew until the motion converges. */
TrackedSweep
SweepTracker::Track::second(const Current& now)
{
  constexpr double kSettled = 0.2; // of the noise: below the resolution of the points
  constexpr int kRounds = 12;      // needed by weak directions of sparse rings
  const SweepMotion at_rest = last_;
  SweepPrior prior;
  SweepMatch found;
  for (int round = 0; round < kRounds; ++round) {
    prior = priorOf(now);
    found = bestMatch(now, prior);
    if (!isMatched(found))
      break;
    const Twist before = last_.velocity;
    const double steps = (now.begin - last_begin_) / last_length_;
    last_.velocity = twistFromMotion(last_.begin.inverse() * found.motion.begin) /
                     std::max(steps, 0.1);
    map_ = emptyMap();
    const SweepMotion& motion = opening_.front().is_timed ? last_ : at_rest;
    addToMap(reducedPlaces(opening_.front(), motion), motion);
    const Twist change = last_.velocity - before;
    if (change.head<3>().norm() + range_ * change.tail<3>().norm() < kSettled * noise_)
      break;
  }
  if (!isMatched(found)) { // the first sweep may be at fault
    last_ = at_rest;
    num_lost_ = 1;
    return begin(now);
  }
  const SweepMotion& motion = opening_.front().is_timed ? last_ : at_rest;
  opening_motions_ = {motion};
  correct(0, placed(opening_.front(), motion, reducedPlaces(opening_.front(), motion)));
  TrackedSweep accepted = accept(now, prior, found);
  accepted.corrects_opening = true;
  return accepted;
}

/** \return the sweep with the time running backward */
SweepTracker::Track::Current
SweepTracker::Track::timeReversed(Current sweep)
{
  sweep.prediction.reset();
  sweep.begin = -(sweep.begin + sweep.length);
  for (auto* points : {&sweep.span.points, &sweep.sample})
    for (odometry::SweepPoint& point : *points)
      point.share = 1 - point.share;
  return sweep;
}

/** Replaces what follows from the motion of a sweep of the opening. */
void
SweepTracker::Track::correct(std::size_t number, TrackedSweep placed)
{
  TrackedSweep& known = corrected_[number];
  known.T_world_sweep = placed.T_world_sweep;
  known.T_world_begin = placed.T_world_begin;
  known.T_world_end = placed.T_world_end;
  known.path = std::move(placed.path);
  known.reduced = std::move(placed.reduced);
}

/** Keeps the sweeps of the opening, and a map of as many behind it. Without times nothing is to be
 * corrected.
 * \param[in,out] found the sweep; told whether it corrects the opening */
void
SweepTracker::Track::keepOpening(const Current& now,
                                 const SweepPrior& prior,
                                 const SweepMatch& match,
                                 const Places& places,
                                 TrackedSweep& found)
{
  if (!now.is_timed || !opening_.front().is_timed) {
    opening_.clear();
    backward_start_.reset();
    return;
  }
  if (opening_.size() < kSweepsOfOpening) {
    opening_.push_back(now);
    opening_motions_.push_back(last_);
    corrected_.push_back(found);
    return;
  }
  if (!backward_start_)
    backward_start_ = BackwardStart{emptyMap(),
                                    0,
                                    last_,
                                    last_begin_,
                                    last_end_,
                                    last_length_,
                                    inverted<6>(match.begin_covariance),
                                    prior.centre};
  backward_start_->map.add(places, last_.begin.translation());
  if (++backward_start_->sweeps == kSweepsOfOpening)
    found.corrects_opening = trackBackward();
}

/** \return [m] sum of the changes of the velocity from sweep to sweep, at the typical range; without
 * the first sweep, whose velocity is the unknown one */
double
SweepTracker::Track::unevenness(const std::vector<SweepMotion>& motions) const
{
  double sum = 0;
  for (std::size_t k = 2; k < motions.size(); ++k) {
    const Twist change = motions[k].velocity - motions[k - 1].velocity;
    sum += change.head<3>().norm() + range_ * change.tail<3>().norm();
  }
  return sum;
}

/** Only the motion to the second sweep told the motion within the first one, and both may differ: a
 * drive may begin in a turn. The next sweeps were matched with a distorted map. All are tracked again
 * with the time running backward, from a map of the sweeps behind them, and with the usual fit and
 * the deviations learned so far. The first one is then known better; of the others, the more even
 * motion counts: errors of single sweeps look like jerks. Where the map leaves a direction free
 * and a prediction was given, all stays: only the prediction knows the direction.
 * \return whether a sweep was corrected */
bool
SweepTracker::Track::trackBackward()
{
  const std::vector<Current> opening = std::exchange(opening_, {});
  BackwardStart start = *std::exchange(backward_start_, std::nullopt);
  Track back(*this);
  back.map_ = std::move(start.map);
  back.last_ = odometry::reversed(start.motion);
  back.last_begin_ = -start.end;
  back.last_end_ = -start.begin;
  back.last_length_ = start.length;
  back.end_information_ = start.begin_information;
  back.information_centre_ = start.centre;
  std::vector<SweepMotion> motions(opening.size());
  for (std::size_t k = opening.size(); k-- > 0;) {
    const TrackedSweep found = back.next(timeReversed(opening[k]));
    const bool is_predicted = found.free_directions > 0 && opening[k].prediction;
    if (found.status != SweepStatus::kTracked || is_predicted)
      return false;
    motions[k] = odometry::reversed(back.last_);
  }
  const bool is_even = unevenness(motions) <= unevenness(opening_motions_);
  for (std::size_t k = 0; k < (is_even ? opening.size() : 1); ++k)
    correct(k, placed(opening[k], motions[k], reducedPlaces(opening[k], motions[k])));
  return true;
}

} // namespace pcl6d
