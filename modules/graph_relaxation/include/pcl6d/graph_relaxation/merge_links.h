// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/pose_graph.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Puts several links between the same two poses, in either direction, into one:
 * the motion that fits them best, weighted by their information, with their information
 * added up. The merged link has the direction and place of the first. A graph keeps its
 * optimum up to second order in the contradictions between the links.
 * \throws BadArgument see checkPoseGraph() (link_error.h); a link from a pose to itself
 * among them \ingroup graph_relaxation */
std::vector<PoseLink>
mergeLinks(const PoseGraph& graph);

/** \brief Merged links, and where the given ones went. */
struct MergedLinks {
  std::vector<PoseLink> links;
  std::vector<std::size_t> place; ///< of each given link: the one that stands for it
};

/** \brief mergeLinks(), with the place of each given link. */
MergedLinks
mergeLinksWithPlaces(const PoseGraph& graph);

/** \return the same measurement, of the pose `from` seen from the pose `to` */
PoseLink
reversed(const PoseLink& link);

} // namespace pcl6d
