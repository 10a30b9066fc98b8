// SPDX-License-Identifier: BSD-3-Clause
// The first sweeps of a map, and the motion within the first one.
#include "sweep_track.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/pose.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace pcl6d {

using odometry::kGateDeviations;
using odometry::SweepMatch;
using odometry::SweepMotion;
using odometry::SweepPrior;

namespace {
/** Sweeps from the first on that are tracked again backward: by then, the tracker has learned the
 * usual deviations (kWarmUp). */
constexpr std::size_t kSweepsOfOpening = 10;

/** Changes of motions below this share of the noise are below the resolution of the points. */
constexpr double kSettled = 0.2;

/** \return the covariance of end and begin */
odometry::Matrix12
swapped(const odometry::Matrix12& covariance)
{
  odometry::Matrix12 back;
  back << covariance.bottomRightCorner<6, 6>(), covariance.bottomLeftCorner<6, 6>(),
      covariance.topRightCorner<6, 6>(), covariance.topLeftCorner<6, 6>();
  return back;
}
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
  opening_ = {{now, last_}};
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
  constexpr int kRounds = 12; // needed by weak directions of sparse rings
  const SweepMotion at_rest = last_;
  const Current first = opening_.front().now;
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
    const SweepMotion& motion = first.is_timed ? last_ : at_rest;
    addToMap(reducedPlaces(first, motion), motion);
    const Twist change = last_.velocity - before;
    if (lengthOf(change) < kSettled * noise_)
      break;
  }
  if (!isMatched(found)) { // the first sweep may be at fault
    last_ = at_rest;
    num_lost_ = 1;
    return begin(now);
  }
  const SweepMotion& motion = first.is_timed ? last_ : at_rest;
  correct(0, placed(first, motion, reducedPlaces(first, motion)));
  opening_.front().motion = motion;
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

/** Keeps the first sweeps, and improves them when enough sweeps lie behind the opening. Without times
 * nothing is to be corrected.
 * \param[in,out] found the sweep; told whether it corrects the opening */
void
SweepTracker::Track::keepOpening(const Current& now,
                                 const SweepPrior& prior,
                                 const SweepMatch& match,
                                 TrackedSweep& found)
{
  if (!now.is_timed || !opening_.front().now.is_timed) {
    opening_.clear();
    return;
  }
  opening_.push_back({now, last_, match.covariance, prior.centre});
  corrected_.push_back(found);
  if (opening_.size() < 2 * kSweepsOfOpening ||
      !improveOpening(std::exchange(opening_, {})))
    return;
  found = corrected_.back();
  found.corrects_opening = true;
}

/** \return [m] sum of the changes of the velocity from sweep to sweep, at the typical range; without
 * the first sweep, whose velocity is the unknown one */
double
SweepTracker::Track::unevenness(const OpeningSweeps& sweeps) const
{
  double sum = 0;
  for (std::size_t k = 2; k < sweeps.size(); ++k)
    sum += lengthOf(sweeps[k].motion.velocity - sweeps[k - 1].motion.velocity);
  return sum;
}

LocalMap
SweepTracker::Track::mapOf(const OpeningSweeps& sweeps) const
{
  LocalMap map = emptyMap();
  for (const OpeningSweep& sweep : sweeps)
    map.add(reducedPlaces(sweep.now, sweep.motion), sweep.motion.begin.translation());
  return map;
}

/** A map of sweeps whose motion was wrong is distorted: its directions are turned by an angle that
 * depends on the time within the sweep. All later sweeps fit it with the same wrong motion within.
 * What does not fit is the end of each sweep with the begin of the next.
 * \return the mean motion from an end to the next begin, per sweep, beyond the pause in between;
 * zero if their scatter explains it, or if it is below the resolution of the points */
Twist
SweepTracker::Track::commonJump(const OpeningSweeps& sweeps) const
{
  std::vector<Twist> jumps;
  Twist mean = Twist::Zero();
  for (std::size_t k = 0; k + 1 < sweeps.size(); ++k) {
    const Current &now = sweeps[k].now, &next = sweeps[k + 1].now;
    const double pause = (next.begin - now.begin) / now.length - 1;
    if (std::abs(pause) > 1) // sweeps are missing
      continue;
    const SweepMotion& motion = sweeps[k].motion;
    jumps.push_back(
        (twistFromMotion(motion.end().inverse() * sweeps[k + 1].motion.begin) -
         pause * motion.velocity) /
        (1 + pause));
    mean += jumps.back();
  }
  if (jumps.size() < kSweepsOfOpening / 2)
    return Twist::Zero();
  const auto count = static_cast<double>(jumps.size());
  mean /= count;
  double scatter_sq = 0;
  for (const Twist& jump : jumps)
    scatter_sq += std::pow(lengthOf(jump - mean), 2);
  constexpr double kSignificant = 2; // standard deviations of the mean
  const double explained = kSignificant * std::sqrt(scatter_sq) / count;
  return lengthOf(mean) > std::max(kSettled * noise_, explained) ? mean : Twist::Zero();
}

/** Matches a sweep from its own motion. The change of the velocity within stays: matching would tell
 * it from its start, here no velocity of the sweep before. In parts, the offsets measure all changes.
 * \param[in,out] sweep with its motion \return whether the sweep matches the map */
bool
SweepTracker::Track::matchAgain(const LocalMap& map, OpeningSweep& sweep) const
{
  SweepPrior prior;
  prior.motion = sweep.motion;
  if (!sweep.motion.offsets.empty())
    prior.uneven = sweep.motion;
  prior.centre = sweep.motion.end().translation();
  prior.translation = std::sqrt(translation_sq_);
  prior.rotation = std::sqrt(rotation_sq_);
  prior.gate =
      std::clamp(kGateDeviations * (prior.translation + range_ * prior.rotation),
                 2 * map.options().voxel,
                 widestGate());
  prior.begin_information.diagonal() << Eigen::Vector3d::Constant(1 / translation_sq_),
      Eigen::Vector3d::Constant(1 / rotation_sq_);
  const SweepMatch found = match(map, sweep.now, prior, prior.gate);
  if (!isMatched(found))
    return false;
  sweep.motion = found.motion;
  if (found.motion.offsets
          .empty()) // offsets are measured from the motion with its change
    sweep.motion.change = prior.motion.change;
  sweep.covariance = found.covariance;
  sweep.centre = prior.centre;
  return true;
}

/** Takes the distortion out of a map: the motion within each sweep is corrected by the common jump,
 * and all are matched with the map that follows, until no jump is left.
 * \param[in,out] sweeps in order; unchanged if nothing is to be corrected
 * \return whether they were corrected */
bool
SweepTracker::Track::straighten(OpeningSweeps& sweeps) const
{
  constexpr int kRounds = 4; // one to three sufficed in simulated drives
  OpeningSweeps straight = sweeps;
  bool is_changed = false;
  for (int round = 0; round < kRounds; ++round) {
    const Twist jump = commonJump(straight);
    if (jump.isZero(0))
      break;
    is_changed = true;
    for (OpeningSweep& sweep : straight) { // the middle of a sweep is known best
      sweep.motion.begin =
          exactlyRigid(sweep.motion.begin * motionFromTwist(Twist(-0.5 * jump)));
      sweep.motion.velocity += jump;
    }
    const LocalMap map = mapOf(straight);
    for (OpeningSweep& sweep : straight)
      if (!matchAgain(map, sweep))
        return false;
  }
  if (is_changed)
    sweeps = std::move(straight);
  return is_changed;
}

/** Tracks sweeps again with the time running backward, from a map of the sweeps behind them, and
 * with the usual fit and the deviations learned so far. Where the map leaves a direction free and
 * a prediction was given, all stays: only the prediction knows the direction.
 * \param[in,out] first sweeps; unchanged if one is lost \return whether all were tracked */
bool
SweepTracker::Track::trackBackward(const OpeningSweeps& behind,
                                   OpeningSweeps& first) const
{
  Track back(*this);
  back.opening_.clear();
  back.map_ = mapOf(behind);
  const OpeningSweep& start = behind.front();
  back.last_ = odometry::reversed(start.motion);
  back.last_length_ = start.now.length;
  back.last_end_ = -start.now.begin;
  back.last_begin_ = back.last_end_ - start.now.length;
  back.last_covariance_ = swapped(start.covariance);
  back.last_centre_ = start.centre;
  OpeningSweeps tracked = first;
  for (std::size_t k = first.size(); k-- > 0;) {
    const TrackedSweep found = back.next(timeReversed(first[k].now));
    const bool is_predicted = found.free_directions > 0 && first[k].now.prediction;
    if (found.status != SweepStatus::kTracked || is_predicted)
      return false;
    tracked[k].motion = odometry::reversed(back.last_);
  }
  first = std::move(tracked);
  return true;
}

/** Matches all but the first sweep again with the map of the straightened sweeps behind them, from
 * where the forward tracking had them; the first one is tracked backward from there.
 * \param[in,out] first sweeps; unchanged if one does not match \return whether all match */
bool
SweepTracker::Track::matchOpening(const OpeningSweeps& behind,
                                  OpeningSweeps& first) const
{
  const LocalMap map = mapOf(behind);
  OpeningSweeps rest(first.begin() + 1, first.end()),
      begin(first.begin(), first.begin() + 1);
  for (OpeningSweep& sweep : rest) {
    sweep.motion.change.setZero(); // told by the distorted map
    sweep.motion.offsets.clear();
    // The second time from the right velocity: the first match took its change for a bend.
    if (!matchAgain(map, sweep) || !matchAgain(map, sweep))
      return false;
  }
  OpeningSweeps all = rest;
  all.insert(all.end(), behind.begin(), behind.end());
  if (!trackBackward(all, begin))
    return false;
  std::move(rest.begin(), rest.end(), first.begin() + 1);
  first.front() = std::move(begin.front());
  return true;
}

/** No sweep before holds the begin of the first one: its motion is matched in parts, with the learned
 * deviation as random walk of the velocity, unless a sudden change was matched already.
 * \param[in] behind the opening \param[in,out] opening unchanged if the first sweep does not match */
void
SweepTracker::Track::matchFirstInParts(const OpeningSweeps& behind,
                                       OpeningSweeps& opening) const
{
  if (!opening.front().motion.offsets.empty())
    return;
  OpeningSweeps others(opening.begin() + 1, opening.end());
  others.insert(others.end(), behind.begin(), behind.end());
  OpeningSweep first = opening.front();
  first.motion.offsets.resize(odometry::kSweepParts + 1, Twist::Zero());
  if (matchAgain(mapOf(others), first))
    opening.front() = std::move(first);
}

/** Only the motion to the second sweep told the motion within the first one, and both may differ: a
 * drive may begin in a turn. The next sweeps were matched with a distorted map. Those behind the
 * opening are straightened, and from their map the opening is tracked backward. The first sweep is
 * then known better, and matched in parts. Of the others, the more even motion counts: errors of single sweeps look like
 * jerks. If the map was distorted, the forward motion counts only as the start of another match.
 * \return whether a sweep was corrected */
bool
SweepTracker::Track::improveOpening(OpeningSweeps sweeps)
{
  const auto middle = sweeps.begin() + kSweepsOfOpening;
  OpeningSweeps behind(std::make_move_iterator(middle),
                       std::make_move_iterator(sweeps.end()));
  sweeps.erase(middle, sweeps.end());
  const bool is_straightened = straighten(behind);
  OpeningSweeps backward = sweeps;
  const bool is_tracked = trackBackward(behind, backward);
  const bool is_matched = is_straightened && matchOpening(behind, sweeps);
  if (!is_tracked && !is_matched)
    return false;
  const bool is_even = is_tracked && unevenness(backward) <= unevenness(sweeps);
  if (is_even || (is_straightened && !is_matched))
    sweeps = std::move(backward);
  else if (!is_straightened)
    sweeps.front() = std::move(backward.front());
  matchFirstInParts(behind, sweeps);
  const auto take = [this](const OpeningSweep& sweep, std::size_t number) {
    const Places places = reducedPlaces(sweep.now, sweep.motion);
    correct(number, placed(sweep.now, sweep.motion, places));
  };
  for (std::size_t k = 0; k < (is_even || is_straightened ? sweeps.size() : 1); ++k)
    take(sweeps[k], k);
  if (!is_straightened)
    return true;
  for (std::size_t k = 0; k < behind.size(); ++k)
    take(behind[k], sweeps.size() + k);
  last_ = behind.back().motion;
  last_covariance_ = behind.back().covariance;
  last_centre_ = behind.back().centre;
  sweeps.insert(sweeps.end(), behind.begin(), behind.end());
  map_ = mapOf(sweeps);
  return true;
}

} // namespace pcl6d
