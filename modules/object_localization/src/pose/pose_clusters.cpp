// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/object_localization/pose_clusters.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
struct Group {
  Eigen::Vector3d founder_middle;
  Eigen::Quaterniond founder;
  Eigen::Vector3d middles = Eigen::Vector3d::Zero();     // weighted sum
  Eigen::Vector4d quaternions = Eigen::Vector4d::Zero(); // weighted sum, signs aligned
  double votes = 0;
};

void
add(Group& group, const Eigen::Vector3d& middle, Eigen::Quaterniond q, double votes)
{
  if (q.coeffs().dot(group.founder.coeffs()) < 0)
    q.coeffs() = -q.coeffs();
  group.middles += votes * middle;
  group.quaternions += votes * q.coeffs();
  group.votes += votes;
}

VotedPose
meanOf(const Group& group, const Eigen::Vector3d& model_middle)
{
  VotedPose mean;
  const Eigen::Quaterniond q(Eigen::Vector4d(group.quaternions.normalized()));
  mean.T_scene_model.linear() = q.toRotationMatrix();
  mean.T_scene_model.translation() =
      group.middles / group.votes - mean.T_scene_model.linear() * model_middle;
  mean.votes = group.votes;
  return mean;
}
} // namespace

std::vector<VotedPose>
clusterPoses(const std::vector<VotedPose>& poses,
             const Eigen::Vector3d& middle,
             double distance,
             double angle)
{
  std::vector<const VotedPose*> order;
  for (const auto& pose : poses)
    order.push_back(&pose);
  const auto hasMoreVotes = [](const auto* a, const auto* b) {
    return a->votes > b->votes;
  };
  std::stable_sort(order.begin(), order.end(), hasMoreVotes);
  const double near_cosine = portableSinCos(0.5 * angle).cos;
  std::vector<Group> groups;
  for (const VotedPose* pose : order) {
    const Eigen::Vector3d place = pose->T_scene_model * middle;
    const Eigen::Quaterniond q(pose->T_scene_model.linear());
    auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) {
      return (g.founder_middle - place).squaredNorm() < distance * distance &&
             std::abs(g.founder.dot(q)) > near_cosine;
    });
    if (group == groups.end())
      group = groups.insert(group, {place, q});
    add(*group, place, q, pose->votes);
  }
  std::vector<VotedPose> means;
  for (const auto& group : groups)
    means.push_back(meanOf(group, middle));
  std::stable_sort(means.begin(), means.end(), [](const auto& a, const auto& b) {
    return a.votes > b.votes;
  });
  return means;
}

} // namespace pcl6d
