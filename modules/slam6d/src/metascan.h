// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>

#include <vector>

namespace pcl6d {

/** \brief The union of registered scans against which a new one is matched
 * (book 4.1.5).
 *
 * Each scan stays in its own frame; the union is formed anew for every match, about an
 * origin near the new scan, so that float coordinates stay small wherever the world's
 * origin is. */
class Metascan {
public:
  /** \param[in] voxel [m] the union is thinned to one point per voxel
   * \param[in] max_scans use only the last so many scans; 0: all */
  Metascan(double voxel, int max_scans);

  /** \param[in] points kept by reference: must outlive the metascan */
  void
  add(const Points& points, const Eigen::Isometry3d& T_world_scan);

  /** \return the points [m] relative to an origin, that lie within reach of it, and no
   * farther than the grid of the thinning reaches: 2^20 voxels */
  Points
  around(const Eigen::Vector3d& origin, double reach) const;

private:
  struct Member {
    const Points* points;
    Eigen::Isometry3d T_world_scan;
    double radius; ///< [m] of the scan about its own origin
  };
  double voxel_;
  int max_scans_;
  std::vector<Member> members_;
};

/** \return the largest distance of a point from the origin [m] */
double
radiusOf(const Points& points);

} // namespace pcl6d
