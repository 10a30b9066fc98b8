// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "planes/plane_moments.h"

#include <pcl6d/plane_segmentation/plane_finishing.h>

#include <cstdint>
#include <vector>

namespace pcl6d::plane_segmentation {

/** \brief A plane in the making. The normal points to the side that was seen. */
struct PlanePart {
  PlaneFit plane;
  PlaneMoments sums;                 ///< of the points that the plane is fitted to
  double sigma = 0;                  ///< [m] noise of these
  std::vector<std::uint32_t> points; ///< places in PlaneCloud::points(), ascending
};

/** \brief The steps of finishPlanes(): parts are fitted, claim points, fall apart where
 * they are not connected, and join what continues them. */
class PlaneParts {
public:
  PlaneParts(const PlaneCloud& cloud, const PlaneOptions& options);

  /** \brief Fits planes to candidates; those without one are left out. */
  void
  start(const PlaneCandidates& candidates);

  /** \brief Gives each point to the nearest of the planes that are around it, and fits
   * the planes to what they got. */
  void
  claim();

  /** \brief Parts that are not connected become parts of their own; those of less than
   * so many points are dropped. */
  void
  split(std::size_t min_points);

  /** \brief Parts of one carrier plane that are near each other become one. */
  void
  merge();

  /** \brief Drops what is too small to be a plane, so that it no longer claims points.
   * Areas are estimates here, from the density of surfels. */
  void
  dropSmall();

  const std::vector<PlanePart>&
  parts() const
  {
    return parts_;
  }

private:
  bool
  supports(const PlanePart& part, std::uint32_t point) const;
  bool
  fit(PlanePart& part) const;
  void
  fitAll();
  std::vector<std::uint32_t>
  surfelsOf(const PlanePart& part) const;
  bool
  touch(const PlanePart& a, const PlanePart& b) const;
  bool
  mergeInto(std::size_t i);

  const PlaneCloud& cloud_;
  const PlaneOptions options_;
  const double least_cosine_; // of options_.max_angle
  std::vector<PlanePart> parts_;
};

} // namespace pcl6d::plane_segmentation
