// SPDX-License-Identifier: BSD-3-Clause
#include "graph/poses_along_links.h"

namespace pcl6d::io {

namespace {
/** \return poses along the links i -> i+1; empty if a link is missing */
std::vector<Eigen::Isometry3d>
posesAlongChain(std::size_t size, const std::vector<PoseLink>& links)
{
  std::vector<const PoseLink*> next(size, nullptr);
  for (auto link = links.rbegin(); link != links.rend(); ++link)
    if (link->to == link->from + 1)
      next[link->from] = &*link; // the first in the file wins
  std::vector<Eigen::Isometry3d> poses = {Eigen::Isometry3d::Identity()};
  for (std::size_t i = 0; i + 1 < size; ++i) {
    if (!next[i])
      return {};
    poses.push_back(poses.back() * next[i]->T_from_to);
  }
  return poses;
}

/** \return poses along a breadth-first tree of each component */
std::vector<Eigen::Isometry3d>
posesAlongTrees(std::size_t size, const std::vector<PoseLink>& links)
{
  std::vector<std::vector<const PoseLink*>> links_at(size);
  for (const auto& link : links) {
    links_at[link.from].push_back(&link);
    links_at[link.to].push_back(&link);
  }
  std::vector<Eigen::Isometry3d> poses(size, Eigen::Isometry3d::Identity());
  std::vector<bool> known(size, false);
  for (std::size_t root = 0; root < size; ++root) {
    std::vector<std::size_t> queue = {root};
    if (known[root])
      continue;
    known[root] = true;
    for (std::size_t next = 0; next < queue.size(); ++next)
      for (const PoseLink* const link : links_at[queue[next]]) {
        const bool forward = link->from == queue[next];
        const std::size_t other = forward ? link->to : link->from;
        if (known[other])
          continue;
        known[other] = true;
        poses[other] = poses[queue[next]] *
                       (forward ? link->T_from_to : link->T_from_to.inverse());
        queue.push_back(other);
      }
  }
  return poses;
}
} // namespace

std::vector<Eigen::Isometry3d>
posesAlongLinks(std::size_t size, const std::vector<PoseLink>& links)
{
  std::vector<Eigen::Isometry3d> poses = posesAlongChain(size, links);
  return poses.empty() ? posesAlongTrees(size, links) : poses;
}

} // namespace pcl6d::io
