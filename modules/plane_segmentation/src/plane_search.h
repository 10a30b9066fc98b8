// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "plane_support.h"

namespace pcl6d {

/** \brief A search that takes one plane after the other out of a cloud. */
class PlaneSearch {
public:
  /** \param[in] finest_cell [m] see RemainingPoints
   * \param[in] min_points of a plane */
  PlaneSearch(const PlaneCloud& cloud,
              double finest_cell,
              const SupportOptions& support,
              std::size_t min_points)
  : support_(support), min_points_(min_points), points_(cloud, finest_cell)
  {}

  const RemainingPoints&
  points() const
  {
    return points_;
  }

  /** \return a slab that finds the support of a plane */
  Slab
  slab(const Eigen::Vector3f& normal, float offset) const
  {
    return {normal,
            offset,
            static_cast<float>(support_.max_distance),
            static_cast<float>(support_.min_cosine)};
  }

  /** \return see findSupport(); no slots if they are too few */
  Support
  supportOf(const Slab& guess) const;

  /** \brief Removes the points of a patch, which is a plane unless it is curved.
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
  SupportOptions support_;
  std::size_t min_points_;
  RemainingPoints points_;
  PlaneCandidates found_;
};

} // namespace pcl6d
