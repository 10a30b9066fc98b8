// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface_covariance.h"

#include <pcl6d/registration/localizability.h>

/** \file How pairs of surfaces fix the directions of motion. */
namespace pcl6d::verification {

/** \brief Middle and extent of pairs. */
struct PairExtent {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero(); ///< [m]
  double spread = 0;   ///< [m] rms distance of the pairs from the centroid
  double residual = 0; ///< [m] rms distance across the surfaces
};

/** \param[in] pairs one or more */
PairExtent
extentOf(const std::vector<SurfacePair>& pairs);

/** \brief Directions of motion, in the order of their eigenvalues, and how the pairs fix them. */
struct FitDirections {
  Matrix6 axes;      ///< columns: motions that move the pairs by 1 m (rms)
  Twist mean_square; ///< of the cosines to the normals of one scan
  Twist inverse;     ///< of the sum of squared cosines; 0: open
  Twist step;        ///< along the axes

  bool
  isOpen(int axis) const
  {
    return inverse(axis) == 0;
  }
  /** \return the number of open directions */
  int
  open() const
  {
    return static_cast<int>((inverse.array() == 0).count());
  }
};

/** \return the directions of the pairs; an open direction takes no step
 * \param[in] open mean square cosine below which a direction is open */
FitDirections
directionsOf(const std::vector<SurfacePair>& pairs,
             const PairExtent& extent,
             double open = Localizability::kOpen);

} // namespace pcl6d::verification
