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
  double depth = 2.5;    ///< voxels, half of its length, the
                         ///< largest measurable distance; > 0
  std::size_t least_points = 4; ///< in the cylinder, of each run; > 0
  unsigned int num_threads = 0; ///< 0: a thread per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Distance between the surfaces of two runs at a core point. */
struct SurfaceDistance {
  Eigen::Vector3f place = Eigen::Vector3f::Zero();  ///< [m] core point, in the world
  Eigen::Vector3f normal = Eigen::Vector3f::Zero(); ///< unit, towards the scanner
  double distance = 0; ///< [m] along the normal, from this surface to the other
  /** [m] level of detection with 95 %: smaller distances may be noise (Lague et al. 2013,
   * eq. 1) */
  double lod = 0;
  std::size_t points = 0; ///< in the cylinder, of the run with fewer points

  /** \return whether the surface moved, with a confidence of 95 % */
  bool
  isSignificant() const
  {
    return distance > lod || distance < -lod;
  }
};

/** \brief Distances between the surfaces of two runs along local normals (M3C2).
 *
 * At core points of the first run, `spacing` voxels apart, the normal is taken from a patch of
 * a fixed radius; a patch that is not planar gives no distance. A cylinder along the normal
 * selects points of both runs with similar normals; the distance is between their means. Its
 * variance is the sum of the variances of both means and of the registration:
 *   LoD95 = 1.96 sqrt(v_a + v_b + reg^2).
 * But points of a scan are correlated (measured: residuals within 1.5 voxels by 0.2 to 0.65,
 * and the whole scan by the error of its pose). So each scan counts as one: v = (s^2 +
 * w^2) / k for k scans. Here s is the spread of points within scans, and w the spread of the
 * means of scans, at this point or in the median of the run, whichever is larger. reg^2 is the
 * variance of the scans' poses (ComparedScan::covariance) along the normal at the core point.
 * Where the points of the runs lie beside each other, the effect of a tilted normal is added.
 * The variances are then scaled up, never down, until the smaller half and the smaller three
 * quarters of the distances agree with their variances: most surfaces have not moved.
 * \throws BadArgument an invalid option, or a scan is not complete
 * \note Source: D. Lague, N. Brodu, J. Leroux, "Accurate 3D comparison of complex topography
 * with terrestrial laser scanner", ISPRS Journal 82, 2013.
 * \ingroup moving_objects */
std::vector<SurfaceDistance>
surfaceDistances(const ComparedRun& of,
                 const ComparedRun& to,
                 const SurfaceDistanceOptions& options = {});

} // namespace pcl6d
