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

/** \brief Kinds of changes between two runs. */
enum class ChangeKind {
  kAppeared, ///< an object of the second run in the free space of the first
  kVanished, ///< an object of the first run in the free space of the second
  kMoved,    ///< an object of equal shape at two poses
  kSurface   ///< a surface of both runs lies nearer or farther
};

/** \return "appeared", "vanished", "moved" or "surface" */
const char*
toString(ChangeKind kind);

/** \brief An upright box around points. */
struct ChangeBox {
  Eigen::Isometry3d T_world_box = Eigen::Isometry3d::Identity(); ///< centre; z is up
  Eigen::Vector3d size = Eigen::Vector3d::Zero();                ///< [m] whole edges

  /** \return [m^3] */
  double
  volume() const
  {
    return size.prod();
  }
};

/** \brief A difference between two runs. */
struct Change {
  ChangeBox box; ///< in the second run, if present there
  /** kMoved: the box in the first run, and the motion of its points in the world */
  std::optional<ChangeBox> before;
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  Points points; ///< [m] in the world, one per voxel, of the run of the box
  Points points_before;
  double confidence = 0; ///< in [0, 1]: that the change is not by chance
  double agreement = 0;  ///< kMoved: share of points of both that meet after the motion
  std::size_t num_observers = 0; ///< scans of the other run with violations
  /** kSurface: [m] towards the scanner, from the first run to the second, the median; and its
   * level of detection with 95 % */
  double distance = 0;
  double lod = 0;
  ChangeKind kind = ChangeKind::kAppeared;
};

/** \brief Counts of the points of a run, one per voxel and scan, by their state in the other
 * run. */
struct RunTally {
  std::size_t points = 0;
  std::size_t there = 0;        ///< on a surface of the other run
  std::size_t shifted = 0;      ///< a surface lies before or behind,
                                ///< within the depth of surfaceDistances()
  std::size_t seen_through = 0; ///< violated by rays of the other run
  std::size_t changed = 0;      ///< number of violated points in a reported object
  std::size_t restless = 0;     ///< violated by scans of the own run, too: dynamic
  std::size_t unknown = 0;      ///< not seen by the other run
};

/** \brief Differences between two runs. */
struct RunChanges {
  std::vector<Change> changes; ///< by kind, then the largest first
  RunTally first, second;
  std::vector<SurfaceDistance> distances; ///< at core points of the first run
  /** share of patches of both runs violated by chance, outside reported objects */
  double background = 0;

  /** \return the violated share of the points of both runs observed by the other run; in [0, 1] */
  double
  contradiction() const;
};

/** \brief Knobs of findChanges(). */
struct RunChangesOptions {
  double voxel = 0.05;   ///< [m] of the reduction of the scans; finite, > 0
  double noise = 0.01;   ///< [m] standard deviation of a point; finite, >= 0
  double gap = 2.5;      ///< voxels between points of one object, at most; finite, > 0
  double least_size = 3; ///< voxels, longest edge of the box of an object; finite, > 0
  double min_confidence = 0.99; ///< least confidence of a reported change; in [0, 1)
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ(); ///< unit vector in the world
  SurfaceDistanceOptions surfaces = {}; ///< voxel and threads are taken from here
  unsigned int num_threads = 0;         ///< 0: a thread per core;
                                        ///< never changes the result
  /** "comparing"; may throw to stop the search */
  ProgressCallback progress = {};
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Finds objects that appeared, vanished or moved between two runs in one world, and
 * displaced surfaces.
 *
 * A point of a run is unchanged if the other run has a surface within a voxel. A point is
 * shifted if a surface with a similar normal lies before or behind, within the depth of
 * surfaceDistances(). The rays of every scan of the other run (RayImage) test the remaining
 * points, with the noise of the point and the covariance of its scan's pose. A point is gone if
 * more rays pass through than end there, unless rays of its own run pass through, too: motion
 * within a run is no change between two runs. A point that no scan observes is unknown, never a
 * change. Neighbouring gone points form an object, unless most of them fringe unchanged points,
 * as leaves and edges do.
 *
 * The confidence of an object follows from chance. Let b be the share of violated patches
 * outside objects (patches of three voxels, beyond which points are independent). By chance, n
 * adjacent patches are violated at N b^n of N positions; further scans with violations count as
 * patches. The confidence is 1 / (1 + N b^n). A vanished and an appeared object with similar
 * boxes, whose points meet after a rigid motion, have moved. A surface is reported where core
 * points with significant distances form an area, and the deviation of the distance is too
 * large for chance.
 * \param[in] first, second of alignRuns()
 * \return second against first is the mirror image of first against second
 * \throws BadArgument an invalid option, or a scan is not complete
 * \ingroup moving_objects */
RunChanges
findChanges(const ComparedRun& first,
            const ComparedRun& second,
            const RunChangesOptions& options = {});

} // namespace pcl6d
