// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/moving_objects/compared_run.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of surfaceDistances(). Lengths follow from the voxel of the scans. */
struct SurfaceDistanceOptions {
  double voxel = 0.05;   ///< [m] of the reduction of the scans; finite, > 0
  double spacing = 2;    ///< voxels between core points; finite, > 0
  double normal = 3;     ///< voxels, radius of the surface that gives a normal; > 0
  double cylinder = 2.5; ///< voxels, radius of the cylinder along the normal; > 0
  double depth = 2.5; ///< voxels, half its length: larger distances are not found; > 0
  std::size_t least_points = 4; ///< in the cylinder, of each run; > 0
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief How far the surface of another run lies from that of a run. */
struct SurfaceDistance {
  Eigen::Vector3f place = Eigen::Vector3f::Zero();  ///< [m] core point, in the world
  Eigen::Vector3f normal = Eigen::Vector3f::Zero(); ///< unit, towards the scanner
  double distance = 0; ///< [m] along it, from this surface to the other one
  /** [m] level of detection with 95 %: smaller distances may be noise (Lague et al. 2013,
   * eq. 1) */
  double lod = 0;
  std::size_t points = 0; ///< in the cylinder, of the run with fewer of them

  /** \return whether the surface has moved, with 95 % */
  bool
  isSignificant() const
  {
    return distance > lod || distance < -lod;
  }
};

/** \brief Distances between the surfaces of two runs along local normals (M3C2).
 *
 * At core points, one per so many voxels of the first run, the normal is taken from a patch
 * of a fixed radius; where that is no plane there is no distance. A cylinder along it holds
 * points of both runs that face as it does; the distance is that of their means. Its variance
 * is that of both means and that of registration:
 *   LoD95 = 1.96 sqrt(v_a + v_b + reg^2),
 * but points of a scan are not independent (algorithms.md T.3: within three voxels by a third
 * and more, and all share the error of its pose). So each scan counts as one: v = (s^2 + w^2)
 * / k for k scans, s the spread of points within scans, w that between the means of scans, here
 * or in the median of the run, whichever is larger. reg^2 is the variance of the scans' poses
 * (ComparedScan::covariance) along the normal at this place; where the points of the runs lie
 * beside each other, what a tilted normal makes of that is added. All is scaled up, never down, so
 * that the smaller half and the smaller three quarters of all distances are as their variances
 * say: most surfaces have not moved.
 * \throws BadArgument an option breaks its rule, or a scan is not complete
 * \note Source: D. Lague, N. Brodu, J. Leroux, "Accurate 3D comparison of complex topography
 * with terrestrial laser scanner", ISPRS Journal 82, 2013. \ingroup moving_objects */
std::vector<SurfaceDistance>
surfaceDistances(const ComparedRun& of,
                 const ComparedRun& to,
                 const SurfaceDistanceOptions& options = {});

} // namespace pcl6d
