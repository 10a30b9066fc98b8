// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/common/voxel_key.h>

#include <array>
#include <cstddef>
#include <vector>

namespace pcl6d {

/** \brief Sums over the points around a place, about that place. */
struct PointMoments {
  std::size_t count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero(); ///< sum of p p^T

  /** \return the covariance with divisor count; count > 0 */
  Eigen::Matrix3d
  covariance() const;
};

/** \brief Points sorted into cells as large as a radius, so that all points within it are
 * in 27 cells, summed without a list of them: a map has thousands around each place. */
class PointGrid {
public:
  /** \param[in] points [m] those not finite are left out
   * \throws BadArgument a point does not fit into the grid (voxelKey()) */
  PointGrid(const Points& points, double radius);

  /** \return the sums over the points within the radius of a finite place */
  PointMoments
  momentsAround(const Eigen::Vector3f& place) const;

private:
  double radius_;
  std::vector<VoxelKey> keys_;            ///< of the occupied cells, ascending
  std::vector<std::size_t> begin_;        ///< first point of each cell, and the end
  std::array<std::vector<float>, 3> xyz_; ///< of the points, cell by cell
};

} // namespace pcl6d
