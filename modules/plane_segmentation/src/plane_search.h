// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "plane_support.h"

namespace pcl6d {

/** \brief A search that takes one plane after the other out of a cloud. */
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

  /** \return a slab that finds the support of a plane */
  Slab
  slab(const Eigen::Vector3f& normal, float offset) const
  {
    return {normal, offset, min_cosine_, 0};
  }

  /** \return see findSupport(); no slots if they are too few */
  Support
  supportOf(const Slab& guess) const;

  /** \brief Removes a patch, which is a plane unless it is curved.
   * \return whether it is a plane */
  bool
  take(const Support& support);

  /** \return the planes taken so far */
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

} // namespace pcl6d
