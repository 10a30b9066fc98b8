// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface_pairs.h"

#include <optional>

namespace pcl6d::verification {

/** \brief Fits the surfaces of a link as refined matches do: pairs of equal planes count, pairs whose
 * planes lie apart lose their weight.
 *
 * \param[in] T_first_second pose of the second scan seen from the first
 * \return `step` is the motion from this pose to rest, `pose_covariance` its covariance; none if a
 * motion is open with these weights, or the pairs are too few
 * \note Source: share/doc/trust.md, Refined links */
std::optional<SurfaceFit>
refinedFit(const VerifiedScan& first,
           const VerifiedScan& second,
           const Eigen::Isometry3d& T_first_second,
           const SurfaceFitOptions& options);

/** \brief A fit seen from another pose nearby. Surfaces come to rest at the same pose, from wherever
 * the steps begin.
 * \param[in] fit refinedFit() from T_first_second
 * \return the fit from T_now; none if rest is farther from T_now than from T_first_second */
std::optional<SurfaceFit>
seenFrom(const Eigen::Isometry3d& T_now,
         const Eigen::Isometry3d& T_first_second,
         const SurfaceFit& fit);

} // namespace pcl6d::verification
