// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/map_quality.h>
#include <pcl6d/registration/icp_model.h>
#include <pcl6d/search/point_tree.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pcl6d::benchmarking {

/** \brief A cloud prepared for measuring, in its own frame. */
struct MapScan {
  /** \param[in] measured [m]; points that are not finite are left out
   * \param[in] voxel [m] of the surface and of the sample
   * \throws BadArgument fewer than 3 finite points, or too large for the grid */
  MapScan(const Points& measured, double voxel);

  Points measured;  ///< the finite points
  PointTree tree;   ///< over them
  IcpModel surface; ///< means of the measured points, one per voxel, with normals
  Points sample;    ///< measured points, one per voxel, at most 2000
  Normals normals;  ///< of the surface at the sample
};

/** \return the least stride n >= 1 for which a sample of every n-th element has at most
 * `most` elements */
inline std::size_t
strideFor(std::size_t size, std::size_t most)
{
  return std::max<std::size_t>(1, (size + most - 1) / most);
}

/** \brief Distances of single points to a surface [m]. */
struct MeasuredDistances {
  std::vector<float> point; ///< to the nearest measured point
  std::vector<float> plane; ///< along the normal of the nearest surface
  std::size_t looked = 0;   ///< points, matched or not

  void
  append(const MeasuredDistances& other);

  SurfaceDistances
  statistics(double within) const;
};

/** \brief Whether normals separate the two faces of a thin wall: normals of scans do,
 * as they point to the scanner. */
enum class Faces { kApart, kUnknown };

/** \brief Measures at most `most` points of the sample of a scan.
 * \param[in] max_distance [m] largest distance of corresponding points */
MeasuredDistances
distancesBetween(const MapScan& scan,
                 const MapScan& target,
                 const Eigen::Isometry3d& T_target_scan,
                 double max_distance,
                 std::size_t most,
                 Faces faces);

} // namespace pcl6d::benchmarking
