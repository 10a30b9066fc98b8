// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "plane_moments.h"

#include <pcl6d/common/voxel_key.h>
#include <pcl6d/plane_segmentation/plane_map.h>

#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace pcl6d {

/** \brief What is kept of a plane of a map: sums of its points, one point of each cell
 * that they occupy, and coarse cells that tell what is near it. */
class MapPlane {
public:
  /** \param[in] places [m] of its points in the world
   * \param[in] seen_from unit normal, to the sensor
   * \param[in] gap_radius [m] of the gaps between the points */
  MapPlane(const std::vector<Eigen::Vector3d>& places,
           const Eigen::Vector3d& seen_from,
           double gap_radius,
           const PlaneMapOptions& options);

  /** \brief Whether another part continues this one: it faces the same way, comes near,
   * and there lies on the same plane. */
  bool
  isContinuedBy(const MapPlane& other, const PlaneMapOptions& options) const;

  /** \brief Takes the points of another part. */
  void
  join(const MapPlane& other);

  /** \return the plane with hulls, area and rms */
  PlaneSegment
  segment(double cell) const;

  std::size_t
  numPoints() const
  {
    return sums_.count();
  }

private:
  PlaneMoments sums_;
  PlaneFit plane_; // the normal points to the side that was seen
  double gap_radius_;
  std::unordered_map<VoxelKey, Eigen::Vector3f> cells_; // a point of each
  std::unordered_set<VoxelKey> near_; // coarse cells with points, and those around them
  double coarse_;                     // [m] edge of a coarse cell
};

} // namespace pcl6d
