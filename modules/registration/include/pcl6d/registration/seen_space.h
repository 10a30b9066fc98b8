// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief How far a scan saw into each direction from its origin: six square images on
 * the faces of a cube, so that a direction needs no angle. \ingroup registration */
class SeenSpace {
public:
  SeenSpace() = default;

  /** \param[in] measured all points of the scan, in its frame [m] */
  explicit SeenSpace(const Points& measured);

  /** \return whether the scan looked clearly past a place: all that it measured there
   * and next to it is farther by more than margin [m] */
  bool
  sawThrough(const Eigen::Vector3f& p, double margin) const;

private:
  int
  cellOf(const Eigen::Vector3f& p) const;

  int side_ = 0;             ///< cells of a face along one edge
  std::vector<float> range_; ///< [m] smallest of the cell and its neighbours; 0: unseen
};

} // namespace pcl6d
