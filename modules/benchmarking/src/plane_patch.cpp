// SPDX-License-Identifier: BSD-3-Clause
#include "plane_patch.h"

#include <pcl6d/common/portable_math.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pcl6d {

PlanePatch::PlanePatch(const Plane& plane, double gate, double max_angle)
: given_(plane)
, gate_(gate)
, min_cosine_(portableSinCos(max_angle).cos)
, normal_(plane.normal)
, offset_(plane.offset)
, centre_(Eigen::Vector3d::Zero())
{
  const auto& hull = given_.hull;
  for (const auto& corner : hull)
    centre_ += corner / static_cast<double>(hull.size());
  for (std::size_t i = 0; i < hull.size(); ++i) {
    radius_ = std::max(radius_, (hull[i] - centre_).norm());
    Eigen::Vector3d inward = normal_.cross(hull[(i + 1) % hull.size()] - hull[i]);
    if (inward.dot(centre_ - hull[i]) < 0) // clockwise
      inward = -inward;
    inward_.push_back(inward);
  }
}

bool
PlanePatch::holds(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const
{
  if (std::abs(normal_.dot(point) - offset_) > gate_ ||
      normal_.dot(normal) < min_cosine_)
    return false;
  for (std::size_t i = 0; i < inward_.size(); ++i)
    if (inward_[i].dot(point - given_.hull[i]) < 0)
      return false;
  return true;
}

std::vector<std::size_t>
PlanePatch::membersOf(const MapPoints& map) const
{
  const double reach = radius_ + gate_;
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const Eigen::Vector3d p = map.points[i].cast<double>();
    if ((p - centre_).squaredNorm() <= reach * reach &&
        holds(p, map.normals[i].cast<double>()))
      members.push_back(i);
  }
  return members;
}

void
PlanePatch::fit(const Points& points, const std::vector<std::size_t>& members)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const std::size_t i : members)
    mean += (points[i].cast<double>() - centre_) / static_cast<double>(members.size());
  mean += centre_;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const std::size_t i : members) {
    const Eigen::Vector3d d = points[i].cast<double>() - mean;
    scatter += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  normal_ = normal.dot(normal_) < 0 ? Eigen::Vector3d(-normal) : normal;
  offset_ = normal_.dot(mean);
}

Plane
PlanePatch::plane() const
{
  Plane plane = given_;
  plane.normal = normal_;
  plane.offset = offset_;
  for (auto& corner : plane.hull)
    corner -= (normal_.dot(corner) - offset_) * normal_;
  orientPlane(plane);
  return plane;
}

} // namespace pcl6d
