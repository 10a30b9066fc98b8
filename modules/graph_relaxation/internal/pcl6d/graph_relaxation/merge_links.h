// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/pose_graph.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Merges parallel links, in either direction, between two poses: the merged link is the
 * weighted mean motion with the sum of the information. It has the direction and index of the
 * first. The optimum of the graph is kept up to second order in the contradictions between the
 * links.
 * \throws BadArgument see checkPoseGraph() (link_error.h); a link from a pose to itself
 * \ingroup graph_relaxation */
std::vector<PoseLink>
mergeLinks(const PoseGraph& graph);

/** \brief Merged links, and the index map from the given links. */
struct MergedLinks {
  std::vector<PoseLink> links;
  std::vector<std::size_t> place; ///< of each given link: index of its merged link
};

/** \brief mergeLinks() with the index of the merged link for each given link. */
MergedLinks
mergeLinksWithPlaces(const PoseGraph& graph);

/** \return the inverse measurement, of the pose `from` seen from the pose `to` */
PoseLink
reversed(const PoseLink& link);

} // namespace pcl6d
