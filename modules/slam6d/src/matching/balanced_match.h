// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/icp.h>

namespace pcl6d::slam6d {

/** \brief Where the pairs of a match leave motions open, matches once more with a selection of the
 * points in which surfaces that face the open motions have the share of a motion: a floor that is
 * 1 % of the points fixes the height.
 *
 * Nothing changes without open motions, with too few facing surfaces (a tunnel), or if a motion
 * stays open.
 * \param[in] options of the match
 * \param[in,out] found by ICP; pairs, rms and overlap stay those of all points */
PCL6D_EXPORTS void // exported for its test
matchBalanced(const IcpTarget& target,
              const IcpSource& source,
              const IcpOptions& options,
              IcpResult& found);

} // namespace pcl6d::slam6d
