// SPDX-License-Identifier: BSD-3-Clause
#include "links/link_terms.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/graph_relaxation/merge_links.h>

#include <algorithm>
#include <map>

namespace pcl6d {
using namespace graph_relaxation;

namespace {
constexpr int kSteps = 5; // quadratic convergence

/** \return a single link with the summed information of links of one direction */
PoseLink
merged(const std::vector<PoseLink>& links)
{
  PoseLink result = links.front();
  if (links.size() == 1)
    return result;
  const QuaternionPose origin;
  QuaternionPose best(result.T_from_to);
  for (int step = 0; step <= kSteps; ++step) {
    Matrix6 H = Matrix6::Zero();
    Vector6 g = Vector6::Zero();
    for (const auto& link : links) {
      const LinkMeasurement measurement(link);
      LinkTerms terms;
      computeTerms(measurement, {measurement, origin, best}, 1, terms);
      H += terms.H_to;
      g += terms.g_to;
    }
    result.information = H;
    const Vector6 motion = solveSymmetric<6>(H, -g);
    if (step == kSteps || !motion.allFinite())
      break;
    best = best.moved(motion);
  }
  result.T_from_to = best.isometry();
  return result;
}
} // namespace

PoseLink
reversed(const PoseLink& link)
{
  PoseLink result;
  result.from = link.to;
  result.to = link.from;
  result.T_from_to = link.T_from_to.inverse();
  // The inverse of M exp(e) is exp(-e) M^-1 = M^-1 exp(-Ad(M) e).
  const Matrix6 adjoint = adjointOf(result.T_from_to); // Ad(M)^-1
  const Matrix6 information = adjoint.transpose() * link.information * adjoint;
  result.information = 0.5 * (information + information.transpose());
  return result;
}

MergedLinks
mergeLinksWithPlaces(const PoseGraph& graph)
{
  checkPoseGraph(graph);
  MergedLinks result;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> group_of;
  std::vector<std::vector<PoseLink>> groups;
  for (const auto& link : graph.links) {
    const std::pair<std::size_t, std::size_t> ends = std::minmax({link.from, link.to});
    const auto [entry, is_new] = group_of.emplace(ends, groups.size());
    if (is_new)
      groups.emplace_back();
    auto& group = groups[entry->second];
    const bool turned = !group.empty() && group.front().from != link.from;
    group.push_back(turned ? reversed(link) : link);
    result.place.push_back(entry->second);
  }
  for (const auto& group : groups)
    result.links.push_back(merged(group));
  return result;
}

std::vector<PoseLink>
mergeLinks(const PoseGraph& graph)
{
  return mergeLinksWithPlaces(graph).links;
}

} // namespace pcl6d
