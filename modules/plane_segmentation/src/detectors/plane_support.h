// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surfels/remaining_surfels.h"

namespace pcl6d::plane_segmentation {

/** \brief The space near a plane, with a range of normals. */
struct Slab {
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
  float offset = 0;     ///< [m] normal . p of its surfels
  float min_cosine = 0; ///< between the normal of a surfel and the plane's
  float slack = 0;      ///< [m] distance allowed beyond a surfel's reach
};

/** \return how many of the surfels are in a slab */
std::size_t
countInside(const SurfelColumns& surfels, const Slab& slab);

/** \brief The patch that supports a plane: the largest connected patch in the slab,
 * after repeated least-squares fits. */
struct Support {
  Slab slab;                        ///< as fitted, without slack
  std::vector<std::uint32_t> slots; ///< ascending; empty: no plane
};

/** \brief Fits a plane to its supporting patch until the patch stops growing.
 * \param[in] slab initial plane; its slack is used once */
Support
findSupport(const RemainingSurfels& surfels, Slab slab);

/** \return whether a patch is a piece of a curved surface, such as a sphere: a quadric
 * explains most of the distances between the surfels and their plane */
bool
isCurved(const SurfelColumns& surfels, const Support& support);

/** \brief Takes planes out of a cloud one by one. */
class PlaneSearch {
public:
  /** \param[in] finest_cell [m], reach: see RemainingSurfels
   * \param[in] min_cosine between the normals of a surfel and of its plane
   * \param[in] min_surfels of a plane */
  PlaneSearch(const PlaneCloud& cloud,
              double finest_cell,
              const SurfelReach& reach,
              double min_cosine,
              std::size_t min_surfels)
  : min_cosine_(static_cast<float>(min_cosine))
  , min_surfels_(min_surfels)
  , surfels_(cloud, finest_cell, reach)
  {}

  const RemainingSurfels&
  surfels() const
  {
    return surfels_;
  }

  /** \return a slab to find the support of a plane */
  Slab
  slab(const Eigen::Vector3f& normal, float offset) const
  {
    return {normal, offset, min_cosine_, 0};
  }

  /** \return see findSupport(); without slots if there are too few */
  Support
  supportOf(const Slab& guess) const;

  /** \brief Removes a patch, and stores it as a plane unless it is curved.
   * \return whether it is a plane */
  bool
  take(const Support& support);

  /** \return the planes taken up to now */
  const PlaneCandidates&
  found() const
  {
    return found_;
  }

private:
  float min_cosine_;
  std::size_t min_surfels_;
  RemainingSurfels surfels_;
  PlaneCandidates found_;
};

} // namespace pcl6d::plane_segmentation
