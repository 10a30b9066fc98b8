// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/posed_points.h>
#include <pcl6d/odometry/sweep_tracker.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Gathers sweeps around each keyframe of a drive, as many as surfaces need
 * (SweepTracker::sweepsOfSurface()): few lines of a single sweep show no surface.
 *
 * Of the sweeps between two keyframes, the first half belongs to the keyframe before, the second half
 * to the one behind; no sweep belongs to both, so that errors of one are not shared. Sweeps from
 * nearly the same position show the same lines, and only one of them counts. Memory does not grow
 * where the scanner rests. \ingroup odometry */
class Submaps {
public:
  /** \brief Adds the next tracked sweep that is no keyframe.
   * \param[in] number of the sweep, for correct() \param[in] wanted sweeps around each keyframe
   * \param[in] least [m] distance between sweeps that show other lines */
  void
  addSweep(std::size_t number,
           const TrackedSweep& sweep,
           std::size_t wanted,
           double least);

  /** \brief Adds the next sweep, a keyframe. */
  void
  addKeyframe(std::size_t number, const TrackedSweep& sweep);

  /** \brief The track was lost, or begins anew: no sweep behind belongs to a keyframe before. */
  void
  cut();

  /** \brief Replaces the pose and the points of a sweep or keyframe. */
  void
  correct(std::size_t number, const TrackedSweep& sweep);

  /** \brief Takes the sweeps around a keyframe, without itself, with their poses in its frame.
   * \param[in] keyframe its number among the keyframes */
  std::vector<PosedPoints>
  take(std::size_t keyframe);

private:
  struct Sweep {
    std::size_t number = 0;
    PosedPoints reduced; ///< pose: T_world_sweep
  };
  struct Keyframe {
    std::size_t number = 0;
    Eigen::Isometry3d T_world_keyframe;
    std::vector<Sweep> around;
  };

  void
  gather(std::size_t begin, std::size_t end, std::size_t wanted);

  std::vector<Sweep> between_; ///< behind the last keyframe
  std::vector<Keyframe> keyframes_;
  std::size_t wanted_ = 0;
  bool is_cut_ = true; ///< behind the last keyframe
};

} // namespace pcl6d
