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
  double sigma = 0;                  ///< [m] noise of the points
  std::vector<std::uint32_t> points; ///< indices into PlaneCloud::points(), ascending
};

/** \brief The steps of finishPlanes(): parts are fitted, claim points, are split where
 * disconnected, and merged with their continuations. */
class PlaneParts {
public:
  PlaneParts(const PlaneCloud& cloud, const PlaneOptions& options);

  /** \brief Fits planes to candidates; candidates without a plane are left out. */
  void
  start(const PlaneCandidates& candidates);

  /** \brief Assigns each point to the nearest plane around it, and fits the planes to
   * their points. */
  void
  claim();

  /** \brief Splits parts into connected parts; drops parts with fewer than min_points
   * points. */
  void
  split(std::size_t min_points);

  /** \brief Merges near parts of one carrier plane. */
  void
  merge();

  /** \brief Drops parts too small for a plane, to free their points. Areas are
   * estimated from the density of surfels. */
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
