// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/verification/verified_scan.h>

#include <Eigen/Geometry>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Finds second poses of a scan relative to another scan at which the surfaces of both
 * coincide: turned by quarters about the vertical, and shifted within the range of the scans.
 *
 * Upright surfaces are drawn into plans, whose cells vote for shifts; the best few shifts of each
 * quarter turn are matched (GICP, with as many points as link tests use). Starts are dropped that run
 * into the known pose or a found one, that rays contradict by far, or at which rays confirm less than
 * a quarter of the surface that they confirm at the known pose. The found poses are not tested any
 * further: see linkEvidence() and testLink().
 * \param[in] T_first_second the known pose, excluded from the result
 * \param[in] up unit vector upwards in the frame of the first scan
 * \return T_first_second of second poses, by quarter turn, then by number of votes
 * \throws BadArgument T_first_second is not a rigid motion, or up no unit vector
 * \note Source: share/doc/trust.md, Ambiguous poses \ingroup verification */
std::vector<Eigen::Isometry3d>
findTwins(const VerifiedScan& first,
          const VerifiedScan& second,
          const Eigen::Isometry3d& T_first_second,
          const Eigen::Vector3d& up);

} // namespace pcl6d
