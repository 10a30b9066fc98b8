// SPDX-License-Identifier: BSD-3-Clause
#include "relaxation/graph_slam_run.h"

#include <pcl6d/common/information.h>
#include <pcl6d/common/name_table.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>

#include <cmath>
#include <utility>

namespace pcl6d {
using namespace graph_relaxation;

namespace {
constexpr Named<LinkWeights> kWeights[] = {{LinkWeights::kUnit, "unit"},
                                           {LinkWeights::kPairs, "pairs"},
                                           {LinkWeights::kCovariance, "covariance"}};

void
requireLink(std::size_t from, std::size_t to, std::size_t num_poses)
{
  require(from < num_poses,
          "link.from",
          from,
          "< " + std::to_string(num_poses) + ", the number of poses");
  require(to < num_poses,
          "link.to",
          to,
          "< " + std::to_string(num_poses) + ", the number of poses");
  require(from != to, "link.to", to, "another scan than link.from");
}

void
requirePoses(const GraphSlam::Poses& poses)
{
  for (std::size_t i = 0; i < poses.size(); ++i)
    require(isRigid(poses[i]),
            "pose",
            i,
            "finite and rigid (a rotation and a translation)");
}

/** \return the checked links, with semidefinite information */
std::vector<PoseLink>
checkedLinks(std::vector<PoseLink> links, std::size_t num_poses)
{
  for (PoseLink& link : links) {
    requireLink(link.from, link.to, num_poses);
    require(
        isRigid(link.T_from_to), "measured link.from", link.from, "of a rigid motion");
    const std::string fault = informationFault(link.information);
    require(fault.empty(),
            "measured link.from",
            link.from,
            "with an information matrix, but the matrix is " + fault);
    link.information = semidefinite(link.information);
  }
  return links;
}
} // namespace

std::vector<std::string>
linkWeightsNames()
{
  return namesOf(kWeights);
}

LinkWeights
linkWeightsFromName(const std::string& name)
{
  return fromName(kWeights, "link-weights", name);
}

const char*
toString(LinkWeights weights)
{
  return nameOf(kWeights, weights);
}

void
GraphSlamOptions::validate() const
{
  require(switch_scale >= 0 && std::isfinite(switch_scale),
          "switch_scale",
          switch_scale,
          "finite and >= 0");
  require(min_pairs >= 3, "min_pairs", min_pairs, ">= 3");
  require(least_deviation > 0 && std::isfinite(least_deviation),
          "least_deviation",
          least_deviation,
          "finite and > 0");
  require(max_iterations > 0, "max_iterations", max_iterations, "> 0");
  require(translation_epsilon >= 0, "translation_epsilon", translation_epsilon, ">= 0");
  require(rotation_epsilon >= 0, "rotation_epsilon", rotation_epsilon, ">= 0");
  require(error_epsilon >= 0, "error_epsilon", error_epsilon, ">= 0");
}

PoseLink
poseLinkOf(const LinkReport& link, const std::vector<Eigen::Isometry3d>& poses)
{
  require(link.from < poses.size() && link.to < poses.size(),
          "link.to",
          link.to,
          "a scan with a pose");
  const Eigen::Isometry3d &T_a = poses[link.from], &T_b = poses[link.to];
  // The motion of b demanded by the pairs, about the centre.
  const Eigen::Isometry3d motion = motionFromTwist(link.correction);
  Eigen::Isometry3d wanted = T_b;
  wanted.linear() = motion.linear() * T_b.linear();
  wanted.translation() = link.centre + motion.translation() +
                         motion.linear() * (T_b.translation() - link.centre);
  Eigen::Matrix<double, 6, 6> axes = Eigen::Matrix<double, 6, 6>::Zero();
  axes.topLeftCorner<3, 3>() = axes.bottomRightCorner<3, 3>() = wanted.linear();
  const Eigen::Matrix<double, 6, 6> P =
      originShift<6>(wanted.translation(), link.centre) * axes;
  PoseLink measured;
  measured.from = link.from;
  measured.to = link.to;
  measured.T_from_to = T_a.inverse() * wanted;
  measured.information = P.transpose() * link.information * P;
  return measured;
}

std::vector<std::size_t>
GraphSlamResult::floating() const
{
  std::vector<std::size_t> floating;
  for (std::size_t j = 0; j < component.size(); ++j)
    if (component[j] != 0)
      floating.push_back(j);
  return floating;
}

GraphSlam::GraphSlam(const GraphSlamOptions& options) : options_(options)
{
  options_.validate();
}

GraphSlamResult
GraphSlam::relax(const Poses& poses, const std::vector<LinkPairs>& links) const
{
  requirePoses(poses);
  const std::vector<PoseLink> measured = checkedLinks(measured_, poses.size());
  for (const LinkPairs& link : links)
    requireLink(link.from, link.to, poses.size());
  const auto same = [&](const Poses&) -> const std::vector<LinkPairs>& {
    return links;
  };
  return GraphSlamRun(options_, measured, observer_).run(poses, same, nullptr);
}

GraphSlamResult
GraphSlam::relax(const Poses& poses,
                 const PairSearch& search,
                 const PairSearch& last) const
{
  require(search != nullptr, "search", "none", "a function");
  requirePoses(poses);
  const std::vector<PoseLink> measured = checkedLinks(measured_, poses.size());
  std::vector<LinkPairs> links;
  const auto searchedBy = [&](const PairSearch& pairs) {
    return [&](const Poses& current) -> const std::vector<LinkPairs>& {
      links = pairs(current);
      for (const LinkPairs& link : links)
        requireLink(link.from, link.to, poses.size());
      return links;
    };
  };
  const GraphSlamRun::Pairs in_the_end =
      last ? GraphSlamRun::Pairs(searchedBy(last)) : nullptr;
  return GraphSlamRun(options_, measured, observer_)
      .run(poses, searchedBy(search), in_the_end);
}

} // namespace pcl6d
