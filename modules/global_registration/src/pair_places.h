// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "place_starts.h"

#include <pcl6d/global_registration/place_search.h>

#include <Eigen/Geometry>

namespace pcl6d::global_registration {

/** \brief Two scans, and places of the second on the first: matched, and judged. */
class PairPlaces {
public:
  /** \param[in] first, second kept by reference */
  PairPlaces(const PlaceableScan& first, const PlaceableScan& second);

  /** \return [m] edge of the cells of both plans */
  double
  cell() const
  {
    return cell_;
  }

  /** \return whether two places are the same one */
  bool
  areNear(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const;

  /** \return where matching (GICP) by some points of the second leads from a place, and its
   * score */
  PlaceStart
  matched(const Eigen::Isometry3d& T_first_second,
          const PlaceableScan::Sample& sample) const;

  PlaceCandidate
  judged(const Eigen::Isometry3d& T_first_second) const;

  /** \brief Where the surfaces leave a motion open, as along a corridor: whether the rays and
   * what meets hold the place all the same. Places along the motion are tried, both ways, near
   * and far (algorithms.md T.2).
   * \param[in] most_ambiguity the score of such a place over that of the best that still
   * leaves it held */
  bool
  isHeld(const PlaceCandidate& best, double most_ambiguity) const;

private:
  const PlaceableScan& first_;
  const PlaceableScan& second_;
  double voxel_, cell_; // [m]
};

/** \brief Says whether the best of the candidates of a result is the only place, and why
 * not. */
void
decideUniqueness(const PairPlaces& places,
                 const PlaceSearchOptions& options,
                 PlaceResult& result);

} // namespace pcl6d::global_registration
