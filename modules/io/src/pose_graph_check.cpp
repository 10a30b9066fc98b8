// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph_check.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/information.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/io/text.h>

#include <algorithm>
#include <set>

namespace pcl6d {

namespace {
void
checkIds(const PoseGraph& graph)
{
  if (!graph.ids.empty() && graph.ids.size() != graph.poses.size())
    throw BadArgument("a pose graph needs one id per pose, but there are " +
                      text::counted(graph.ids.size(), "id") + " and " +
                      text::counted(graph.poses.size(), "pose"));
  std::set<std::size_t> known;
  for (const std::size_t id : graph.ids)
    if (!known.insert(id).second)
      throw BadArgument("id " + std::to_string(id) + " is given twice");
}

void
checkLink(const PoseLink& link, const std::string& name, std::size_t num_poses)
{
  if (std::max(link.from, link.to) >= num_poses)
    throw BadArgument(name + " joins poses " + std::to_string(link.from) + " and " +
                      std::to_string(link.to) + ", but there are only " +
                      text::counted(num_poses, "pose"));
  if (link.from == link.to)
    throw BadArgument(name + " joins pose " + std::to_string(link.from) +
                      " with itself");
  if (!isRigid(link.T_from_to))
    throw BadArgument(name + " measures no rigid motion");
  const std::string fault = informationFault(link.information);
  if (!fault.empty())
    throw BadArgument(name + " has information that is " + fault);
}
} // namespace

void
checkGraphToWrite(const PoseGraph& graph)
{
  if (graph.poses.empty())
    throw BadArgument("a pose graph needs a pose");
  checkIds(graph);
  for (std::size_t i = 0; i < graph.poses.size(); ++i)
    if (!isRigid(graph.poses[i]))
      throw BadArgument("pose " + std::to_string(i) + " is no rigid motion");
  for (std::size_t k = 0; k < graph.links.size(); ++k)
    checkLink(graph.links[k], "link " + std::to_string(k), graph.poses.size());
}

} // namespace pcl6d
