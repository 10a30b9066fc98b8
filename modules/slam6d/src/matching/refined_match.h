// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/icp.h>

namespace pcl6d::slam6d {

/** \return whether lines lie so far apart that many normals belong to no surface, and a match should
 * be refined: about as far as voxels. [m] */
PCL6D_EXPORTS bool // exported for its test
areNormalsUncertain(double line_spacing, double voxel);

/** \return whether refineMatch() changes matches with these options */
bool
isRefined(const IcpOptions& options);

/** \brief Matches once more from the pose at rest, with the covariances of planes of the paper, and
 * less weight for pairs whose planes lie apart. Between lines that lie far apart, patches of normals
 * cover floor and wall, or a car and the street: their planes are none, and pull the match away.
 *
 * From far, all pairs are needed; so only the end of a match is refined. Nothing changes where
 * motions are open, with a robust kernel of the caller, or if the refined match leaves the pair
 * distance.
 * \param[in] options of the match
 * \param[in,out] found by ICP; gets the refined pose; pairs, rms, overlap, covariance and status stay
 * those of all pairs with equal weights */
PCL6D_EXPORTS void // exported for its test
refineMatch(const IcpTarget& target,
            const IcpSource& source,
            const IcpOptions& options,
            IcpResult& found);

} // namespace pcl6d::slam6d
