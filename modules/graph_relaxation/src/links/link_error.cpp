// SPDX-License-Identifier: BSD-3-Clause
#include "links/link_terms.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/information.h>
#include <pcl6d/common/pose.h>

#include <algorithm>
#include <string>

namespace pcl6d {
using namespace graph_relaxation;

Vector6
linkError(const PoseLink& link,
          const Eigen::Isometry3d& T_a,
          const Eigen::Isometry3d& T_b)
{
  return errorOf(LinkMeasurement(link), QuaternionPose(T_a), QuaternionPose(T_b));
}

LinkError
linearizeLink(const PoseLink& link,
              const Eigen::Isometry3d& T_a,
              const Eigen::Isometry3d& T_b)
{
  const LinkMeasurement measurement(link);
  const LinkGeometry geometry(measurement, QuaternionPose(T_a), QuaternionPose(T_b));
  LinkError result;
  result.error = geometry.error;
  result.J_to.topLeftCorner<3, 3>() = geometry.J_translation;
  result.J_to.bottomRightCorner<3, 3>() = geometry.J_rotation;
  result.J_from = -result.J_to * adjointOf(T_b.inverse() * T_a);
  return result;
}

double
chi2Of(const PoseGraph& graph)
{
  checkPoseGraph(graph);
  double sum = 0;
  for (const auto& link : graph.links) {
    const Vector6 error = linkError(link, graph.poses[link.from], graph.poses[link.to]);
    sum += error.dot(link.information * error);
  }
  return sum;
}

Matrix6
adjointOf(const Eigen::Isometry3d& X)
{
  const Eigen::Matrix3d R = X.linear();
  Matrix6 adjoint;
  adjoint << R, skew(X.translation()) * R, Eigen::Matrix3d::Zero(), R;
  return adjoint;
}

void
checkPoseGraph(const PoseGraph& graph)
{
  if (!graph.ids.empty() && graph.ids.size() != graph.poses.size())
    throw BadArgument("a pose graph needs an id per pose, but has " +
                      std::to_string(graph.ids.size()) + " ids of " +
                      std::to_string(graph.poses.size()) + " poses");
  for (std::size_t i = 0; i < graph.poses.size(); ++i)
    if (!isRigid(graph.poses[i]))
      throw BadArgument("pose " + std::to_string(i) + " is no rigid motion");
  for (std::size_t k = 0; k < graph.links.size(); ++k) {
    const PoseLink& link = graph.links[k];
    const std::string name = "link " + std::to_string(k);
    if (std::max(link.from, link.to) >= graph.poses.size())
      throw BadArgument(name + " joins poses " + std::to_string(link.from) + " and " +
                        std::to_string(link.to) + ", but there are only " +
                        std::to_string(graph.poses.size()));
    if (link.from == link.to)
      throw BadArgument(name + " joins pose " + std::to_string(link.from) +
                        " with itself");
    if (!isRigid(link.T_from_to))
      throw BadArgument(name + " measures no rigid motion");
    const std::string fault = informationFault(link.information);
    if (!fault.empty())
      throw BadArgument(name + " has information that is " + fault);
  }
}

} // namespace pcl6d
