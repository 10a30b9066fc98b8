// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/pose_votes.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Clusters poses. In the order of falling votes, each pose joins the first
 * cluster whose founder is near enough, or founds a cluster.
 * \param[in] middle of the model [m], in its frame: distances are measured there
 * \param[in] distance [m], angle [rad] within which poses are near
 * \return per cluster the mean pose and the sum of the votes; most votes first
 * \note Source: Drost et al. 2010, section 4.3. \ingroup object_localization */
std::vector<VotedPose>
clusterPoses(const std::vector<VotedPose>& poses,
             const Eigen::Vector3d& middle,
             double distance,
             double angle);

} // namespace pcl6d
