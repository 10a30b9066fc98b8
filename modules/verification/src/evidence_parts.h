// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/verification/link_evidence.h>

/** \file What the evidence of a link is made of; shared by those that judge it at its place
 * and at others. */
namespace pcl6d::verification {

/** \brief Where the surfaces would move a link to, in a few steps, and how well they say it.
 * \param[in] points of a scan that are paired \param[in] steps > 0
 * \param[in] with_covariance false leaves it zero, which takes less time */
SurfaceFit
settledFit(const VerifiedScan& first,
           const VerifiedScan& second,
           const Eigen::Isometry3d& T_first_second,
           double voxel,
           std::size_t points,
           int steps,
           bool with_covariance);

/** \brief What the rays of both scans say of the points of the other; those of a scan that
 * abstains say nothing.
 * \param[in] fit of the surfaces: where they fit best they are as far apart as noise alone
 * does not show, as ranges are off alike for all points of a wall
 * \param[out] contradictions if given: points of the second scan that the rays of the first
 * contradict */
SightEvidence
sightBothWays(const VerifiedScan& first,
              const VerifiedScan& second,
              const Eigen::Isometry3d& T_first_second,
              double voxel,
              const SurfaceFit& fit,
              std::vector<Contradiction>* contradictions = nullptr);

/** \brief Log likelihood ratios of two kinds of wrong places against the right one, by what
 * rays contradict. */
struct RaysAgainst {
  double usual = 0; ///< places that contradict much
  double even =
      0; ///< places along even surfaces, such as a corridor's, contradict little
};

/** \param[in] background share that right links contradict \param[in] precision how evenly
 * they share it: the sum of both parameters of a beta distribution */
RaysAgainst
raysAgainst(std::size_t contradicted,
            std::size_t patches,
            double background,
            double precision);

/** \return that of wrong places of either kind, as often as they are */
double
logRatioOf(const RaysAgainst& against);

/** \return the probability of a wrong place of either kind, with the prior */
double
probabilityOf(const RaysAgainst& against);

} // namespace pcl6d::verification
