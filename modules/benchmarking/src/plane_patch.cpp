// SPDX-License-Identifier: BSD-3-Clause
#include "plane_patch.h"

#include <pcl6d/common/polygon.h>
#include <pcl6d/common/portable_math.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pcl6d {

PlanePatch::PlanePatch(const PlaneSegment& segment, double gate, double max_angle)
: given_(segment.plane)
, gate_(gate)
, min_cosine_(portableSinCos(max_angle).cos)
, centre_(Eigen::Vector3d::Zero())
{
  const double side = segment.seen_from.dot(given_.normal) < 0 ? -1 : 1;
  normal_ = side * given_.normal;
  offset_ = side * given_.offset;
  axes_.row(0) = normal_.unitOrthogonal();
  axes_.row(1) = normal_.cross(axes_.row(0).transpose());
  for (const auto& corner : given_.hull)
    centre_ += corner / static_cast<double>(given_.hull.size());
  const auto flat = [&](const std::vector<Eigen::Vector3d>& corners) {
    Ring ring;
    for (const auto& corner : corners)
      ring.push_back(onPlane(corner));
    return ring;
  };
  hull_.push_back(flat(given_.hull));
  for (const auto& corner : hull_.front())
    radius_ = std::max(radius_, corner.norm());
  for (const auto& ring : segment.outline)
    outline_.push_back(flat(ring));
  if (outline_.empty())
    outline_ = hull_;
}

bool
PlanePatch::isNear(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const
{
  return std::abs(normal_.dot(point) - offset_) <= gate_ &&
         normal_.dot(normal) >= min_cosine_;
}

bool
PlanePatch::covers(const PlanePatch& other) const
{
  return isNear(other.centre_, other.normal_) &&
         isInside(hull_, onPlane(other.centre_));
}

std::vector<std::size_t>
PlanePatch::membersOf(const MapPoints& map) const
{
  const double reach = radius_ + gate_;
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const Eigen::Vector3d p = map.points[i].cast<double>();
    if ((p - centre_).squaredNorm() <= reach * reach &&
        isNear(p, map.normals[i].cast<double>()) && isInside(outline_, onPlane(p)))
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
