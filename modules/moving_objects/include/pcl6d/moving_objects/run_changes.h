// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/progress.h>
#include <pcl6d/moving_objects/compared_run.h>
#include <pcl6d/moving_objects/surface_distance.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What became of something between two runs. */
enum class ChangeKind {
  kAppeared, ///< the second run has it where the first one saw through
  kVanished, ///< the first run has it where the second one saw through
  kMoved,    ///< both: of the same shape, here and there
  kSurface   ///< a surface that both runs saw lies nearer or farther
};

/** \return "appeared", "vanished", "moved" or "surface" */
const char*
toString(ChangeKind kind);

/** \brief A box about some points, upright. */
struct ChangeBox {
  Eigen::Isometry3d T_world_box =
      Eigen::Isometry3d::Identity();              ///< of its centre; z is up
  Eigen::Vector3d size = Eigen::Vector3d::Zero(); ///< [m] whole edges

  /** \return [m^3] */
  double
  volume() const
  {
    return size.prod();
  }
};

/** \brief Something that differs between two runs. */
struct Change {
  ChangeBox box; ///< where it is: in the second run, if it is there
  /** kMoved: where it was before, and the motion of its points in the world */
  std::optional<ChangeBox> before;
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  Points points; ///< [m] in the world, one per voxel, of the run that the box is of
  Points points_before;
  double confidence = 0; ///< in [0, 1]: that it is no chance
  double agreement = 0;  ///< kMoved: share of points of both that meet by the motion
  std::size_t witnesses = 0; ///< scans of the other run that saw through it
  /** kSurface: [m] towards the scanner, from the first run to the second one, the median; and
   * its level of detection with 95 % */
  double distance = 0;
  double lod = 0;
  ChangeKind kind = ChangeKind::kAppeared;
};

/** \brief What another run says of the points of a run, of one per voxel and scan. */
struct RunTally {
  std::size_t points = 0;
  std::size_t there = 0; ///< a surface of the other run is there
  std::size_t shifted =
      0; ///< one lies before or behind it, within the depth of surfaces
  std::size_t seen_through = 0; ///< the other run saw through
  std::size_t changed = 0;      ///< of these, in something that is told of
  std::size_t restless =
      0;                   ///< other scans of its own run saw through it, too: it moves
  std::size_t unknown = 0; ///< not seen by the other run
};

/** \brief What differs between two runs. */
struct RunChanges {
  std::vector<Change> changes; ///< by kind, then the largest first
  RunTally first, second;
  std::vector<SurfaceDistance> distances; ///< at core points of the first run
  /** share of patches of both runs that were seen through by chance, not in something that is
   * told of */
  double background = 0;

  /** \return of the points of both runs of which the other one speaks, the share that it saw
   * through; in [0, 1] */
  double
  contradiction() const;
};

/** \brief Knobs of findChanges(). */
struct RunChangesOptions {
  double voxel = 0.05;   ///< [m] of the reduction of the scans; finite, > 0
  double noise = 0.01;   ///< [m] standard deviation of a point; finite, >= 0
  double gap = 2.5;      ///< voxels between points of one thing, at most; finite, > 0
  double least_size = 3; ///< voxels, longest edge of the box of a thing; finite, > 0
  double min_confidence = 0.99; ///< below, nothing is told of; in [0, 1)
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ(); ///< unit vector in the world
  SurfaceDistanceOptions surfaces = {}; ///< its voxel and threads are those here
  unsigned int num_threads = 0;         ///< 0: one per core; never changes the result
  /** told of "comparing"; may throw, which ends it */
  ProgressCallback progress = {};
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief What appeared, vanished and moved between two runs in one world, and which surfaces
 * lie elsewhere.
 *
 * A point of a run is there where the other run has a surface within a voxel; shifted where one
 * that faces alike lies before or behind it, within the depth of surfaceDistances(). Of the
 * others the rays of all scans of the other run are asked (RayImage), with the noise of the
 * point and the covariance of its scan's pose: what more of them saw through than ended on is
 * gone, unless the other scans of its own run say the same: what moves in a run is no change
 * between two. What no scan saw is unknown, never a change. Gone points that are near each other are
 * a thing, unless most of it fringes what is still there, as leaves and edges do.
 *
 * The confidence of a thing follows from chance: with a share b of patches (three voxels, beyond
 * which points are independent) seen through outside of all things, n patches that follow each
 * other are expected to be so at N b^n of N places; further scans that saw through count as
 * patches. Confidence is 1 / (1 + that number). A vanished and an appeared thing whose boxes are
 * alike, and whose points meet after a rigid motion, have moved. Surfaces are told of where core
 * points whose distance is significant make an area, and the distance is by so many deviations
 * that chance would not give it anywhere.
 * \param[in] first, second of alignRuns()
 * \return second against first is the mirror image of first against second
 * \throws BadArgument an option breaks its rule, or a scan is not complete
 * \ingroup moving_objects */
RunChanges
findChanges(const ComparedRun& first,
            const ComparedRun& second,
            const RunChangesOptions& options = {});

} // namespace pcl6d
