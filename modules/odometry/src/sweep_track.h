// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sweep_matcher.h"
#include "sweep_sample.h"

#include <pcl6d/common/voxel_numbers.h>
#include <pcl6d/odometry/sweep_tracker.h>

#include <cmath>
#include <optional>

namespace pcl6d {

namespace odometry {
/** A sweep with fewer points has no shape to be matched by. */
inline constexpr std::size_t kLeastSweepPoints = 100;

/** The gate, in standard deviations of the predictions (KISS-ICP). */
inline constexpr double kGateDeviations = 3;
} // namespace odometry

/** \brief The state of a SweepTracker. */
class SweepTracker::Track {
public:
  explicit Track(const SweepTrackerOptions& options) : options_(options)
  {
    options_.validate();
  }

  TrackedSweep
  track(const Sweep& sweep);

  const std::vector<TrackedSweep>&
  corrected() const
  {
    return corrected_;
  }
  double
  voxel() const
  {
    return map_ ? map_->options().voxel : 0;
  }
  double
  resolution() const;
  std::size_t
  sweepsOfSurface() const;
  std::size_t
  mapBytes() const
  {
    return map_ ? map_->numBytes() : 0;
  }

private:
  /** The current sweep: points, and times in the clock of the tracker. */
  struct Current {
    odometry::SweepSpan span;
    odometry::SweepPoints sample;
    double begin = 0; ///< [s, or sweeps] in the clock
    double length = 1;
    bool is_timed = false;
    std::optional<Eigen::Isometry3d> prediction;
  };

  using Places = std::vector<Eigen::Vector3d>;

  /** A sweep of the opening. */
  struct OpeningSweep {
    Current now;
    odometry::SweepMotion motion;
    odometry::Matrix12 covariance = odometry::Matrix12::Zero(); ///< about `centre`
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  };
  using OpeningSweeps = std::vector<OpeningSweep>;

  Current
  prepare(const Sweep& sweep);
  void
  setClock(const Sweep& sweep, Current& now) const;
  TrackedSweep
  begin(const Current& now);
  TrackedSweep
  second(const Current& now);
  void
  correct(std::size_t number, TrackedSweep placed);
  void
  keepOpening(const Current& now,
              const odometry::SweepPrior& prior,
              const odometry::SweepMatch& match,
              TrackedSweep& found);
  bool
  improveOpening(OpeningSweeps sweeps);
  bool
  straighten(OpeningSweeps& sweeps) const;
  bool
  matchAgain(const LocalMap& map, OpeningSweep& sweep) const;
  Twist
  commonJump(const OpeningSweeps& sweeps) const;
  bool
  trackBackward(const OpeningSweeps& behind, OpeningSweeps& first) const;
  bool
  matchOpening(const OpeningSweeps& behind, OpeningSweeps& first) const;
  void
  matchFirstInParts(const OpeningSweeps& behind, OpeningSweeps& opening) const;
  LocalMap
  mapOf(const OpeningSweeps& sweeps) const;
  double
  lengthOf(const Twist& motion) const
  {
    return motion.head<3>().norm() + range_ * motion.tail<3>().norm();
  }
  double
  unevenness(const OpeningSweeps& sweeps) const;
  static Current
  timeReversed(Current sweep);
  TrackedSweep
  next(const Current& now);
  TrackedSweep
  lost(const Current& now);

  odometry::SweepMotion
  expectedMotion(const Current& now, double pause, bool is_open) const;
  odometry::SweepPrior
  priorOf(const Current& now) const;
  bool
  widen(const odometry::SweepMatch& found, odometry::SweepPrior& prior) const;
  odometry::SweepMatch
  matchGated(const Current& now, odometry::SweepPrior& wider) const;
  odometry::SweepMatch
  bestMatch(const Current& now, const odometry::SweepPrior& prior) const;
  bool
  hasPause(const Current& now) const;
  /** \return [m] half of the largest voxel */
  double
  widestGate() const
  {
    return 0.5 * std::ldexp(map_->options().voxel, map_->options().levels - 1);
  }
  void
  tryUneven(const Current& now,
            const odometry::SweepPrior& prior,
            odometry::SweepMatch& best) const;
  void
  tryFurther(const Current& now,
             const odometry::SweepPrior& prior,
             odometry::SweepPrior loose,
             odometry::SweepMatch& best) const;
  odometry::SweepMatch
  match(const LocalMap& map,
        const Current& now,
        const odometry::SweepPrior& prior,
        double gate) const;
  odometry::SweepMatch
  match(const Current& now, const odometry::SweepPrior& prior, double gate) const
  {
    return match(*map_, now, prior, gate);
  }
  bool
  isMatched(const odometry::SweepMatch& match) const;
  double
  deviationOf(const odometry::SweepMatch& match) const;
  bool
  isElsewhere(const odometry::SweepMatch& match) const;
  bool
  isBetter(const odometry::SweepMatch& found,
           const odometry::SweepMatch& best,
           bool goes_on) const;

  TrackedSweep
  accept(const Current& now,
         const odometry::SweepPrior& prior,
         const odometry::SweepMatch& match);
  void
  learn(const odometry::SweepPrior& prior, const odometry::SweepMatch& match);
  TrackedSweep
  describe(const Current& now, const odometry::SweepMotion& motion) const;
  /** \return describe(), with the reduced points \param[in] places of them [m, world] */
  TrackedSweep
  placed(const Current& now,
         const odometry::SweepMotion& motion,
         const Places& places) const;
  /** \return the places of the points, reduced to the resolution of the map [m, world] */
  Places
  reducedPlaces(const Current& now, const odometry::SweepMotion& motion) const;
  void
  addToMap(const Places& places, const odometry::SweepMotion& motion);
  void
  markKeyframe(const Current& now,
               const odometry::SweepMotion& motion,
               const Places& reduced,
               TrackedSweep& found);
  LocalMap
  emptyMap() const;

  SweepTrackerOptions options_;
  std::optional<LocalMap> map_;
  std::optional<odometry::SweepSampler> sampler_;
  double range_ = 0;                    ///< [m] typical range of the first sweep
  double reach_ = 0;                    ///< [m] of the sweeps so far
  double noise_ = 0;                    ///< [m]
  std::vector<TrackedSweep> corrected_; ///< openingOfSegment()
  OpeningSweeps opening_;               ///< the first sweeps, until improved
  std::size_t segment_ = 0;
  std::size_t num_sweeps_ = 0, num_matched_ = 0, num_lost_ = 0; ///< lost: in a row

  odometry::SweepMotion last_; ///< of the last matched sweep
  odometry::Matrix12 last_covariance_ =
      odometry::Matrix12::Zero(); ///< of its begin and end, about `last_centre_`
  Eigen::Vector3d last_centre_ = Eigen::Vector3d::Zero();
  double last_begin_ = 0, last_end_ = 0, last_length_ = 1; ///< in the clock
  double translation_sq_ = 0,
         rotation_sq_ = 0; ///< of the deviations from constant velocity
  double usual_fit_ = 0, usual_overlap_ = 0, usual_deviation_ = 0;
  double correlation_ = 1;
  bool is_open_ = true; ///< surfaces left a direction of the last sweep free

  Eigen::Vector3d cut_at_ =
      Eigen::Vector3d::Zero(); ///< where far voxels were dropped last
  VoxelNumbers keyframe_;      ///< voxels seen from the last keyframe
  Eigen::Vector3d keyframe_at_ = Eigen::Vector3d::Zero(); ///< [m]
};

} // namespace pcl6d
