// SPDX-License-Identifier: BSD-3-Clause
#include "objects/object_groups.h"
#include "objects/pose_mean.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/information.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using namespace semantic_map;

namespace {
void
check(const MapObject& object, std::size_t place)
{
  const std::string name = "observation " + std::to_string(place) + ": ";
  if (object.pose.object_class.empty())
    throw BadArgument(name + "has no class");
  if (!isRigid(object.pose.T_world_object))
    throw BadArgument(name + "T_world_object is no rigid motion");
  require(object.symmetry >= 0, (name + "symmetry").c_str(), object.symmetry, ">= 0");
  if (!object.covariance)
    return;
  const std::string fault = informationFault(*object.covariance);
  if (!fault.empty())
    throw BadArgument(name + "covariance is " + fault);
}

Matrix6d
diagonal(double position, double angle)
{
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(position * position),
      Eigen::Vector3d::Constant(angle * angle);
  return variances.asDiagonal();
}

UncertainPose
uncertainPose(const MapObject& object, const FusionOptions& options)
{
  UncertainPose result;
  result.pose = object.pose.T_world_object;
  Matrix6d covariance = diagonal(options.position_error, options.angle_error);
  if (object.covariance) {
    const Matrix6d G = eulerJacobian(result.pose.linear());
    covariance = G * *object.covariance * G.transpose();
  }
  covariance += diagonal(options.min_position_error, options.min_angle_error);
  result.covariance = covariance;
  result.information = inverted(covariance);
  return result;
}

/** \return the index of the pose in best agreement with the others: with the smallest
 * sum of truncated squared distances */
std::size_t
mostAgreed(const std::vector<UncertainPose>& poses,
           const std::vector<int>& symmetries,
           double gate)
{
  std::size_t best = 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < poses.size(); ++j) {
      const Vector6d error =
          poseError(poses[i].pose,
                    nearestEquivalent(poses[j].pose, poses[i].pose, symmetries[j]));
      sum += std::min(gate, error.dot(poses[j].information * error));
    }
    if (sum < smallest) {
      smallest = sum;
      best = i;
    }
  }
  return best;
}

/** \return the covariance of x y z roll pitch yaw; nullopt where roll and yaw are not
 * defined \param[in] covariance of position and rotation vector */
std::optional<Matrix6d>
eulerCovariance(Matrix6d covariance, const Eigen::Matrix3d& R, int symmetry)
{
  constexpr double kPole = 1e-3; // see poseCovariance()
  if (R(0, 0) * R(0, 0) + R(1, 0) * R(1, 0) < kPole * kPole)
    return {};
  if (symmetry == 0) { // any angle about the axis: evenly in [-pi, pi]
    constexpr double kAnyAngle = 3.289868133696453; // [rad^2] pi^2 / 3
    covariance.bottomRightCorner<3, 3>() += kAnyAngle * R.col(2) * R.col(2).transpose();
  }
  const Matrix6d G_inverse = inverted(eulerJacobian(R));
  const Matrix6d result = G_inverse * covariance * G_inverse.transpose();
  return Matrix6d((result + result.transpose()) / 2);
}

FusedObject
fuse(const std::vector<MapObject>& observations,
     const std::vector<std::size_t>& group,
     const FusionOptions& options)
{
  std::vector<UncertainPose> poses;
  std::vector<int> symmetries;
  for (const auto i : group) {
    poses.push_back(uncertainPose(observations[i], options));
    symmetries.push_back(observations[i].symmetry);
  }
  const std::size_t start = mostAgreed(poses, symmetries, options.gate);
  for (std::size_t i = 0; i < poses.size(); ++i)
    poses[i].pose = nearestEquivalent(poses[i].pose, poses[start].pose, symmetries[i]);
  const PoseMean mean = robustMean(poses, start, options.gate);

  FusedObject fused;
  fused.observations = group;
  fused.object = observations[group[start]];
  MapObject& object = fused.object;
  object.pose.T_world_object = mean.pose;
  object.covariance =
      eulerCovariance(mean.covariance, mean.pose.linear(), object.symmetry);
  object.pose.points = 0;
  object.scans.clear();
  for (std::size_t i = 0; i < group.size(); ++i) {
    const MapObject& observation = observations[group[i]];
    if (!mean.counts[i])
      fused.outliers.push_back(group[i]);
    object.score = std::max(object.score, observation.score);
    object.visible_fraction =
        std::max(object.visible_fraction, observation.visible_fraction);
    object.pose.points += observation.pose.points;
    object.pose.moves = object.pose.moves || observation.pose.moves;
    object.scans.insert(
        object.scans.end(), observation.scans.begin(), observation.scans.end());
  }
  std::sort(object.scans.begin(), object.scans.end());
  return fused;
}
} // namespace

void
FusionOptions::validate() const
{
  require(min_overlap > 0 && min_overlap <= 1, "min_overlap", min_overlap, "in (0, 1]");
  require(max_distance > 0, "max_distance", max_distance, "> 0 [m]");
  require(gate > 0, "gate", gate, "> 0");
  require(position_error > 0, "position_error", position_error, "> 0 [m]");
  require(angle_error > 0, "angle_error", angle_error, "> 0 [rad]");
  require(min_position_error > 0, "min_position_error", min_position_error, "> 0 [m]");
  require(min_angle_error > 0, "min_angle_error", min_angle_error, "> 0 [rad]");
}

std::vector<FusedObject>
fuseObjects(const std::vector<MapObject>& observations, const FusionOptions& options)
{
  options.validate();
  for (std::size_t i = 0; i < observations.size(); ++i)
    check(observations[i], i);
  std::vector<FusedObject> fused;
  for (const auto& group : groupObservations(observations, options)) {
    fused.push_back(fuse(observations, group, options));
    if (group.size() == 1) // a single observation stays unchanged
      fused.back().object = observations[group.front()];
  }
  return fused;
}

} // namespace pcl6d
