// SPDX-License-Identifier: BSD-3-Clause
#include "sweep_track.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/scan_sampling.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

using odometry::kLeastSweepPoints;
using odometry::SweepMatch;
using odometry::SweepMotion;
using odometry::SweepPrior;

namespace {
/** Voxels of 3.25 line spacings hold points of three lines, enough for a plane. Measured with 2.5, 3.25
 * and 4 spacings, no sweep lost; rms [mm] of 400 sweeps: corridor with vlp16 15, 7, 8, multilevel 7,
 * 5, 6, campus 11, 10, 15; with ouster corridor 16, 25, 20, campus 8, 9, 7; a handheld recording of
 * 16 scans 6, 7, 6 from its given poses. Smaller voxels take more time. */
constexpr double kVoxelOfLines3 = 2.5 * kVoxelOfLines;

/** Voxels are at least this share of the typical range: finer voxels show the sensor's noise. */
constexpr double kVoxelOfRange = 0.03;

/** Far away, planes need large voxels: three lines with 2 deg between them. [rad] */
constexpr double kAngleOfVoxel = 0.1;
constexpr int kMostMapLevels = 8; ///< the limit of LocalMap

/** Least standard deviation of a plane's position, as a share of the smallest voxel's edge. Points
 * that fill a face of a voxel spread by edge / sqrt(12) along the plane, and at most a fifth of it
 * across: edge / 17 (kFlatness, local_map.cpp). Their mean deviates by edge / 42 for 6 points, the
 * least number, and by edge / 49 for 8. The value is rounded down. */
constexpr double kNoiseOfVoxel = 1.0 / 50;

/** Parts of a sweep, within which the velocity is taken as constant: a change of 3 degrees a sweep
 * leaves 0.2 mrad. */
constexpr int kPathSteps = 8;

/** Edge of the reduction of a sweep before it enters the map, as a share of the voxel edge. */
constexpr double kMapThinning = 0.25;
} // namespace

TrackedSweep
SweepTracker::Track::track(const Sweep& sweep)
{
  require(!sweep.prediction || isRigid(*sweep.prediction),
          "prediction",
          "of the sweep",
          "a rigid motion");
  const Current now = prepare(sweep);
  ++num_sweeps_;
  if (now.span.points.size() < kLeastSweepPoints)
    return lost(now);
  if (num_matched_ == 0)
    return begin(now);
  return num_matched_ == 1 ? second(now) : next(now);
}

SweepTracker::Track::Current
SweepTracker::Track::prepare(const Sweep& sweep)
{
  Current now;
  now.span = odometry::spanOf(sweep.points, sweep.times, options_.max_range);
  now.is_timed = now.span.end > now.span.begin;
  now.prediction = sweep.prediction;
  setClock(sweep, now);
  if (now.span.points.size() < kLeastSweepPoints)
    return now;
  if (!map_) {
    const ScanSampling sampling = samplingOf(sweep.points);
    range_ = std::max(odometry::rangeOfShare(now.span.points, 0.5), 1e-3);
    const double voxel = options_.voxel.value_or(
        std::max(kVoxelOfLines3 * sampling.lineSpacing(), kVoxelOfRange * range_));
    noise_ = kNoiseOfVoxel * voxel;
    LocalMapOptions map;
    map.voxel = voxel;
    const double far = kAngleOfVoxel * odometry::rangeOfShare(now.span.points, 0.9);
    while (map.levels < kMostMapLevels && std::ldexp(voxel, map.levels - 1) < far)
      ++map.levels;
    map_.emplace(map);
    sampler_.emplace(kMapThinning * voxel, options_.points_of_match);
  }
  reach_ = std::max(reach_, 1.2 * odometry::rangeOfShare(now.span.points, 0.99));
  now.sample = sampler_->sample(now.span.points);
  return now;
}

/** Where stamps jump back or are missing, the sweep follows the sweep before without a pause. */
void
SweepTracker::Track::setClock(const Sweep& sweep, Current& now) const
{
  const bool is_stamped = sweep.stamp && std::isfinite(*sweep.stamp);
  now.length = now.is_timed ? now.span.end - now.span.begin : last_length_;
  const double next = (now.is_timed ? last_end_ : last_begin_ + last_length_) +
                      static_cast<double>(num_lost_) * last_length_;
  now.begin = is_stamped ? *sweep.stamp + now.span.begin : next;
  const double earliest = now.is_timed ? last_end_ - 0.5 * now.length : last_begin_;
  if (num_matched_ > 0 && !(now.begin > earliest))
    now.begin = next;
}

double
SweepTracker::Track::resolution() const
{
  return kMapThinning * voxel();
}

/** Voxels follow from the lines; the finest useful ones follow from the noise. */
std::size_t
SweepTracker::Track::sweepsOfSurface() const
{
  return static_cast<std::size_t>(
      std::ceil(voxel() / std::max(kVoxelOfRange * range_, 1e-9)));
}

LocalMap
SweepTracker::Track::emptyMap() const
{
  return LocalMap(map_->options());
}

TrackedSweep
SweepTracker::Track::next(const Current& now)
{
  const SweepPrior prior = priorOf(now);
  const SweepMatch found = bestMatch(now, prior);
  return isMatched(found) ? accept(now, prior, found) : lost(now);
}

TrackedSweep
SweepTracker::Track::accept(const Current& now,
                            const SweepPrior& prior,
                            const SweepMatch& match)
{
  learn(prior, match);
  SweepMotion motion = match.motion;
  if (!now.is_timed) { // the velocity since the sweep before
    const double steps = (now.begin - last_begin_) / last_length_;
    motion.velocity =
        match.is_further ? last_.velocity
                         : Twist(twistFromMotion(last_.begin.inverse() * motion.begin) /
                                 std::max(steps, 0.1));
    motion.change.setZero();
  }
  const bool was_lost = num_lost_ > 0;
  if (!now.is_timed)
    last_length_ = (now.begin - last_begin_) > 0 ? now.begin - last_begin_ : 1;
  else
    last_length_ = now.length;
  last_ = motion;
  last_begin_ = now.begin;
  last_end_ = now.begin + (now.is_timed ? now.length : 0);
  last_covariance_ = match.covariance;
  last_centre_ = prior.centre;
  correlation_ = match.correlation;
  is_open_ = match.free_directions > 0;
  num_lost_ = 0;
  ++num_matched_;
  const Places places = reducedPlaces(now, motion);
  TrackedSweep found = placed(now, motion, places);
  found.status = was_lost ? SweepStatus::kFoundAgain : SweepStatus::kTracked;
  found.inliers = match.inliers;
  found.overlap = match.overlap;
  found.distance = match.distance;
  found.deviation =
      distanceBetween(prior.motion.end(), match.motion.end()).translation +
      range_ * distanceBetween(prior.motion.end(), match.motion.end()).rotation;
  found.covariance = match.covariance.topLeftCorner<6, 6>();
  found.free_directions = match.free_directions;
  markKeyframe(now, motion, places, found);
  addToMap(places, motion);
  if (!opening_.empty())
    keepOpening(now, prior, match, found);
  return found;
}

/** The pose at the stamp follows from the motion, also before the begin. */
TrackedSweep
SweepTracker::Track::describe(const Current& now, const SweepMotion& motion) const
{
  TrackedSweep found;
  found.segment = segment_;
  found.points = now.span.points.size();
  found.begin = now.span.begin;
  found.end = now.span.end;
  found.T_world_begin = exactlyRigid(motion.begin);
  found.T_world_end = now.is_timed ? exactlyRigid(motion.end()) : found.T_world_begin;
  found.T_world_sweep = found.T_world_begin;
  for (int knot = 0; now.is_timed && knot <= kPathSteps; ++knot) {
    const double share = static_cast<double>(knot) / kPathSteps;
    found.path.stamps.push_back(now.span.begin + share * now.length);
    found.path.poses.push_back(
        exactlyRigid(motion.begin * motionFromTwist(motion.twistAt(share))));
  }
  if (now.is_timed && now.span.begin != 0)
    found.T_world_sweep = exactlyRigid(
        motion.begin * motionFromTwist(motion.twistAt(-now.span.begin / now.length)));
  return found;
}

TrackedSweep
SweepTracker::Track::placed(const Current& now,
                            const SweepMotion& motion,
                            const Places& places) const
{
  TrackedSweep found = describe(now, motion);
  found.reduced = odometry::inFrameOf(found.T_world_sweep, places);
  return found;
}

TrackedSweep
SweepTracker::Track::lost(const Current& now)
{
  SweepMotion motion;
  if (num_matched_ > 0) {
    motion = priorOf(now).motion;
    ++num_lost_;
  }
  TrackedSweep found = describe(now, motion);
  found.status = SweepStatus::kLost;
  if (num_matched_ > 0 &&
      num_lost_ >= options_.most_lost) { // the next sweep begins a map
    last_ = motion;
    num_matched_ = 0;
  }
  return found;
}

SweepTracker::Track::Places
SweepTracker::Track::reducedPlaces(const Current& now, const SweepMotion& motion) const
{
  return odometry::placesOf(
      odometry::thinned(now.span.points, resolution()), motion, options_.num_threads);
}

void
SweepTracker::Track::addToMap(const Places& places, const SweepMotion& motion)
{
  const Eigen::Vector3d here = motion.begin.translation();
  map_->add(places, here);
  constexpr double kCutAfter = 0.1; // of the reach: voxels are dropped now and then
  if ((here - cut_at_).norm() < kCutAfter * reach_)
    return;
  map_->keepWithin(here, (1 + kCutAfter) * reach_);
  cut_at_ = here;
}

/** The sample, even over the surfaces, tells how much is new; all points of the keyframe tell what
 * it saw: the sample would leave gaps. */
void
SweepTracker::Track::markKeyframe(const Current& now,
                                  const SweepMotion& motion,
                                  const Places& reduced,
                                  TrackedSweep& found)
{
  const double edge = std::ldexp(map_->options().voxel, 2);
  const Eigen::Vector3d here = found.T_world_begin.translation();
  const auto keysOf = [edge](const Places& places) {
    std::vector<VoxelKey> keys;
    for (const auto& place : places)
      if (place.cwiseAbs().maxCoeff() < 1e6 * edge)
        keys.push_back(voxelKey(place.cast<float>(), edge));
    return keys;
  };
  const auto keys =
      keysOf(odometry::placesOf(now.sample, motion, options_.num_threads));
  std::size_t seen = 0;
  for (const VoxelKey key : keys)
    seen += keyframe_.find(key) < keyframe_.size();
  if (static_cast<double>(seen) >=
          options_.keyframe_overlap * static_cast<double>(keys.size()) &&
      (here - keyframe_at_).norm() < options_.keyframe_way * range_)
    return;
  keyframe_at_ = here;
  found.is_keyframe = true;
  keyframe_ = VoxelNumbers();
  for (const VoxelKey key : keysOf(reduced))
    keyframe_.add(key);
}

} // namespace pcl6d
