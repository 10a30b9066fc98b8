// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "remaining_surfels.h"

namespace pcl6d {

/** \brief What is near a plane and faces its way. */
struct Slab {
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
  float offset = 0;     ///< [m] normal . p of its surfels
  float min_cosine = 0; ///< between the normal of a surfel and the plane's
  float slack = 0;      ///< [m] that a surfel may be away beyond its reach
};

/** \return how many of the surfels are in a slab */
std::size_t
countInside(const SurfelColumns& surfels, const Slab& slab);

/** \brief The patch of a surface about a plane: the largest connected one in the slab,
 * after some fits by least squares. */
struct Support {
  Slab slab;                        ///< as fitted, without slack
  std::vector<std::uint32_t> slots; ///< ascending; none: no plane
};

/** \brief Fits a plane to the patch that supports it until that grows no more.
 * \param[in] slab first guess; its slack counts once */
Support
findSupport(const RemainingSurfels& surfels, Slab slab);

/** \return whether a patch is a piece of a curved surface, such as a sphere: a quadric
 * explains most of what is left between the surfels and their plane */
bool
isCurved(const SurfelColumns& surfels, const Support& support);

} // namespace pcl6d
