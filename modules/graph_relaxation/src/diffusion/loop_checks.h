// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/graph_relaxation/error_diffusion.h>

/** \file Checks of loops and edges before error diffusion. */
namespace pcl6d::graph_relaxation {

inline void
requireLoop(std::size_t num_poses, std::size_t first, std::size_t last)
{
  const std::string rule = "less than the " + std::to_string(num_poses) + " poses";
  require(first < num_poses, "first", first, rule);
  require(last < num_poses, "last", last, rule);
  require(first != last, "last", last, "another scan than the first of the loop");
}

inline void
requireEnds(std::size_t num_poses, std::size_t a, std::size_t b)
{
  const std::string rule = "less than the " + std::to_string(num_poses) + " poses";
  require(a < num_poses, "end of an edge", a, rule);
  require(b < num_poses, "end of an edge", b, rule);
  require(a != b, "end of an edge", b, "another scan than the other end");
}

inline void
requirePoses(const std::vector<Eigen::Isometry3d>& poses)
{
  for (std::size_t i = 0; i < poses.size(); ++i)
    require(isRigid(poses[i]), "pose", i, "finite and rigid");
}

inline void
requireCost(const PerDimension& cost)
{
  require(cost.allFinite() && (cost.array() >= 0).all(),
          "cost of an edge",
          cost.transpose(),
          "finite and >= 0");
}

inline void
requireInput(const std::vector<Eigen::Isometry3d>& poses,
             const std::vector<LoopEdge>& edges,
             const std::vector<Loop>& loops)
{
  for (const Loop& loop : loops)
    requireLoop(poses.size(), loop.first, loop.last);
  requirePoses(poses);
  for (const Loop& loop : loops) {
    require(isRigid(loop.corrected_last),
            "corrected pose of scan",
            loop.last,
            "finite and rigid");
    requireCost(loop.cost);
  }
  for (const auto& edge : edges) {
    requireEnds(poses.size(), edge.a, edge.b);
    requireCost(edge.cost);
  }
}

} // namespace pcl6d::graph_relaxation
