// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/verification/link_evidence.h>

/** \file The parts of a link's evidence, shared by the tests at its pose and at displaced poses. */
namespace pcl6d::verification {

/** \brief The shift of a link towards its best surface fit, in a few steps, with its covariance.
 * \param[in] points number of paired points of a scan \param[in] steps > 0
 * \param[in] with_covariance false: left zero, to save time */
SurfaceFit
settledFit(const VerifiedScan& first,
           const VerifiedScan& second,
           const Eigen::Isometry3d& T_first_second,
           double voxel,
           std::size_t points,
           int steps,
           bool with_covariance);

/** \brief Tests the points of each scan by the rays of the other, unless the rays are unusable.
 * \param[in] fit of the surfaces: its residual adds to the noise, because range errors common to
 * all points of a wall exceed the noise
 * \param[out] contradictions if given: points of the second scan contradicted by rays of the
 * first */
SightEvidence
sightBothWays(const VerifiedScan& first,
              const VerifiedScan& second,
              const Eigen::Isometry3d& T_first_second,
              double voxel,
              const SurfaceFit& fit,
              std::vector<Contradiction>* contradictions = nullptr);

/** \brief Log likelihood ratios of two kinds of wrong poses against the right pose, by contradicted
 * patches. */
struct RaysAgainst {
  double usual = 0; ///< poses with many contradictions
  double even =
      0; ///< poses along even surfaces, e.g. in a corridor: few contradictions
};

/** \brief How often right links are contradicted. */
struct RightLinks {
  /** Share of their patches. */
  double background = 0;
  /** Smaller background that right links may have, too: a link without contradictions never
   * indicates a wrong pose, however large the background is. */
  double least = 0;
  /** Of the share between links: the sum of both parameters of a beta distribution. */
  double precision = 0;
};

/** \return the log likelihood ratios of the two kinds */
RaysAgainst
raysAgainst(std::size_t contradicted, std::size_t patches, const RightLinks& usual);

/** \return the log likelihood ratio of both kinds, weighted by their frequency
 * \param[in] even_share of poses along even surfaces among wrong poses, e.g. kEvenShare */
double
logRatioOf(const RaysAgainst& against, double even_share);

/** \return the probability of a wrong pose of either kind, with the prior */
double
probabilityOf(const RaysAgainst& against, double even_share);

} // namespace pcl6d::verification
