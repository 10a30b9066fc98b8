// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "remaining_points.h"

namespace pcl6d {

/** \brief What is near a plane and faces its way. */
struct Slab {
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
  float offset = 0;       ///< [m] normal . p of its points
  float max_distance = 0; ///< [m] of a point
  float min_cosine = 0;   ///< between its normal and the plane's
};

/** \brief Which points support a plane. */
struct SupportOptions {
  double max_distance = 0.03; ///< [m] of a point to the plane
  double min_cosine = 0.9;    ///< between its normal and the plane's
  double gap = 0.2;           ///< [m] edge of the cells in which a patch is connected
};

/** \return how many of the points are in a slab */
std::size_t
countInside(const PointColumns& points, const Slab& slab);

/** \brief The patch of a surface about a plane: the largest connected one of the points
 * in the slab, after some fits by least squares. */
struct Support {
  Slab slab;                        ///< as fitted
  std::vector<std::uint32_t> slots; ///< ascending; none: no plane
};

/** \brief Fits a plane to the patch that supports it until that grows no more.
 * \param[in] slab first guess; may be thicker than options.max_distance */
Support
findSupport(const RemainingPoints& points, Slab slab, const SupportOptions& options);

/** \return whether a patch is a piece of a curved surface, such as a sphere: a quadric
 * explains most of what is left between the points and their plane, and this fills the
 * slab */
bool
isCurved(const PointColumns& points, const Support& support);

} // namespace pcl6d
