// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/verification/verified_scan.h>

#include <Eigen/Geometry>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Other places of a scan relative to another one where its surfaces come to lie on
 * the other's: turned by quarters about the vertical, and shifted as far as the scans reach.
 *
 * Upright surfaces are drawn into plans, whose cells vote for shifts; the best few of each
 * quarter turn are matched (GICP). Which of them is as good as the first place is not asked
 * here: linkEvidence() and judgeLink() tell.
 * \param[in] T_first_second the place that is known, which is not found again
 * \param[in] up unit vector upwards in the frame of the first scan
 * \return T_first_second of other places: by quarter turns, those with most votes first
 * \throws BadArgument T_first_second is not a rigid motion, or up no unit vector
 * \note Source: algorithms.md T.2, G.1 \ingroup verification */
std::vector<Eigen::Isometry3d>
findTwins(const VerifiedScan& first,
          const VerifiedScan& second,
          const Eigen::Isometry3d& T_first_second,
          const Eigen::Vector3d& up);

} // namespace pcl6d
