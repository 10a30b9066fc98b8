// SPDX-License-Identifier: BSD-3-Clause
#include "relaxation/extended_graph.h"

#include <algorithm>

namespace pcl6d::graph_relaxation {

namespace {
/** Information of the links of fixed poses, relative to the strongest link: their share of a
 * residual is about the inverse. */
constexpr double kStronger = 1e4;

double
strongestOf(const PoseGraph& graph)
{
  double strongest = 1;
  for (const auto& link : graph.links)
    strongest = std::max(strongest, link.information.diagonal().maxCoeff());
  return strongest;
}
} // namespace

PoseLink
linkOf(const PosePrior& prior)
{
  PoseLink link;
  link.from = 0;
  link.to = prior.pose + 1;
  link.T_from_to = prior.T_world_pose;
  link.information = prior.information;
  return link;
}

ExtendedGraph::ExtendedGraph(const PoseGraph& graph,
                             const std::vector<Eigen::Isometry3d>& poses,
                             const GraphConstraints& constraints)
: constraints_(constraints)
, first_(constraints.priors.empty() ? 0 : 1)
, num_poses_(poses.size())
{
  graph_.poses.assign(first_, Eigen::Isometry3d::Identity());
  graph_.poses.insert(graph_.poses.end(), poses.begin(), poses.end());
  graph_.links = graph.links;
  for (PoseLink& link : graph_.links) {
    link.from += first_;
    link.to += first_;
  }
  for (const LinkSwitch& one : constraints.switches)
    graph_.links[one.link].information *= one.value * one.value;
  const std::size_t num_given = graph_.links.size();
  addPriors();
  addSightings();
  if (graph_.poses.size() > num_poses_ || num_given < graph_.links.size() ||
      !graph.ids.empty())
    addIds(graph);
  addFixed(graph);
}

/** Ids of the world and of landmarks have no neighbours, for PoseGraphOptions::trust_chain. */
void
ExtendedGraph::addIds(const PoseGraph& graph)
{
  std::size_t next = num_poses_;
  for (const std::size_t id : graph.ids)
    next = std::max(next, id);
  const auto takeNext = [&] { return next += 2; };
  for (std::size_t i = 0; i < graph_.poses.size(); ++i) {
    const bool is_given = i >= first_ && i < first_ + num_poses_;
    const std::size_t pose = i - first_;
    graph_.ids.push_back(!is_given           ? takeNext()
                         : graph.ids.empty() ? pose
                                             : graph.ids[pose]);
  }
}

void
ExtendedGraph::addPriors()
{
  for (const PosePrior& prior : constraints_.priors)
    graph_.links.push_back(linkOf(prior));
}

/** The first sighting of a landmark fixes its rotation, too. */
void
ExtendedGraph::addSightings()
{
  const std::size_t first_landmark = graph_.poses.size();
  for (const Eigen::Vector3d& position : constraints_.landmarks)
    graph_.poses.emplace_back(Eigen::Translation3d(position));
  std::vector<bool> is_turned(constraints_.landmarks.size(), false);
  for (const LandmarkSighting& sighting : constraints_.sightings) {
    PoseLink link;
    link.from = first_ + sighting.pose;
    link.to = first_landmark + sighting.landmark;
    link.T_from_to = Eigen::Translation3d(sighting.position);
    link.information.setZero();
    link.information.topLeftCorner<3, 3>() = sighting.information;
    if (!is_turned[sighting.landmark]) {
      link.information.bottomRightCorner<3, 3>().setIdentity();
      graph_.poses[link.to].linear() = graph_.poses[link.from].linear();
      is_turned[sighting.landmark] = true;
    }
    graph_.links.push_back(link);
  }
}

/** Strong links join fixed poses with the world, or without priors with the first fixed pose. */
void
ExtendedGraph::addFixed(const PoseGraph& graph)
{
  if (constraints_.fixed.empty())
    return;
  const double strongest = strongestOf(graph);
  const bool has_world = first_ > 0;
  const std::size_t holder = has_world ? 0 : constraints_.fixed.front();
  for (const std::size_t pose : constraints_.fixed) {
    PoseLink link;
    link.from = holder;
    link.to = first_ + pose;
    if (link.from == link.to)
      continue;
    link.T_from_to = graph_.poses[link.from].inverse() * graph_.poses[link.to];
    link.information *= kStronger * strongest;
    graph_.links.push_back(link);
  }
}

void
ExtendedGraph::takeBack(const PoseGraphResult& result,
                        std::vector<Eigen::Isometry3d>& poses,
                        std::vector<Eigen::Vector3d>& landmarks) const
{
  std::vector<Eigen::Isometry3d> found = result.poses;
  const std::vector<std::size_t>& fixed = constraints_.fixed;
  if (!fixed.empty() && first_ == 0) { // the component of the fixed poses moves back
    const std::size_t holder = fixed.front();
    const Eigen::Isometry3d motion = poses[holder] * found[holder].inverse();
    for (std::size_t i = 0; i < found.size(); ++i)
      if (result.component[i] == result.component[holder])
        found[i] = motion * found[i];
  }
  const std::vector<Eigen::Isometry3d> given = poses;
  for (std::size_t i = 0; i < num_poses_; ++i)
    poses[i] = found[first_ + i];
  for (const std::size_t i : fixed)
    poses[i] = given[i]; // to the last bit
  for (std::size_t k = 0; k < landmarks.size(); ++k)
    landmarks[k] = found[first_ + num_poses_ + k].translation();
}

} // namespace pcl6d::graph_relaxation
