// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surfels/remaining_surfels.h"

#include <pcl6d/common/random.h>

#include <optional>

namespace pcl6d::plane_segmentation {

/** \brief How three surfels are drawn that may lie on one plane. */
struct TripleOptions {
  int num_levels = 4;      ///< sizes of cells, from the finest; each is as likely
  double min_distance = 0; ///< [m] between each two of them
  double min_cosine = 0.9; ///< between the normal of each and that of their plane
  /** Sine of the smallest angle that they make: the flatter, the less they say. */
  double min_sine = 0.2;
};

/** \brief The plane of three surfels, on the side to which their normals point. */
struct TriplePlane {
  Eigen::Vector3f normal;
  float offset = 0; ///< [m] normal . p
};

/** \brief Draws a surfel and two of its neighbours.
 * \return none if they do not make a plane that suits their normals */
std::optional<TriplePlane>
drawTriple(const RemainingSurfels& surfels,
           const TripleOptions& options,
           Random& random);

} // namespace pcl6d::plane_segmentation
