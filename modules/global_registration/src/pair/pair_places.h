// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pair/place_starts.h"

#include <pcl6d/global_registration/place_search.h>

#include <Eigen/Geometry>

namespace pcl6d::global_registration {

/** \brief Two scans, with relative poses matched and tested. */
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

  /** \return whether two poses are equal within the tolerance */
  bool
  areNear(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const;

  /** \return the pose after matching (GICP) some points of the second scan, and its score */
  PlaceStart
  matched(const Eigen::Isometry3d& T_first_second,
          const PlaceableScan::Sample& sample) const;

  PlaceCandidate
  evaluated(const Eigen::Isometry3d& T_first_second) const;

  /** \brief Where the surfaces leave a motion open, as along a corridor: whether rays and
   * overlap fix the pose all the same. Poses along the motion are tested in both directions,
   * near and far (share/doc/place_recognition.md, Uniqueness).
   * \param[in] most_ambiguity largest ratio of the score of such a pose to the best score */
  bool
  isHeld(const PlaceCandidate& best, double most_ambiguity) const;

private:
  const PlaceableScan& first_;
  const PlaceableScan& second_;
  double voxel_, cell_; // [m]
};

/** \brief Decides whether the best candidate of a result is unique, and why not. */
void
decideUniqueness(const PairPlaces& places,
                 const PlaceSearchOptions& options,
                 PlaceResult& result);

} // namespace pcl6d::global_registration
