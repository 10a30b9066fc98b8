// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surfels/remaining_surfels.h"

#include <pcl6d/common/random.h>

#include <optional>

namespace pcl6d::plane_segmentation {

/** \brief Knobs of drawing three surfels that may lie on one plane. */
struct TripleOptions {
  int num_levels = 4;      ///< sizes of cells, from the finest; equally likely
  double min_distance = 0; ///< [m] between every two surfels
  double min_cosine = 0.9; ///< between the normals of a surfel and of the plane
  /** Sine of the smallest angle of the triangle: flat triangles determine a plane
   * poorly. */
  double min_sine = 0.2;
};

/** \brief The plane of three surfels, oriented like their normals. */
struct TriplePlane {
  Eigen::Vector3f normal;
  float offset = 0; ///< [m] normal . p
};

/** \brief Draws a surfel and two of its neighbours.
 * \return nullopt if their plane contradicts their normals */
std::optional<TriplePlane>
drawTriple(const RemainingSurfels& surfels,
           const TripleOptions& options,
           Random& random);

} // namespace pcl6d::plane_segmentation
