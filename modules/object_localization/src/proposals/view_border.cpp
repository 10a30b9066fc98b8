// SPDX-License-Identifier: BSD-3-Clause
#include "proposals/view_border.h"

#include <pcl6d/common/median.h>
#include <pcl6d/common/polygon.h>
#include <pcl6d/common/rotation.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl6d::object_localization {

namespace {
constexpr double kRim = 2; // [spacings] of the border

double
spacingOf(const PlaneCloud& cloud)
{
  constexpr std::size_t kSamples = 2000;
  const Points& points = cloud.points();
  const std::size_t stride = std::max<std::size_t>(points.size() / kSamples, 1);
  std::vector<double> angles;
  std::array<Neighbour, 2> near;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    const double range = (points[i] - cloud.viewpoint(i)).norm();
    if (range > 0 && cloud.tree().nearestK(points[i], 2, near.data()) == 2)
      angles.push_back(std::sqrt(double{near[1].distance_sq}) / range);
  }
  return upperMedian(std::move(angles));
}
} // namespace

ViewBorder::ViewBorder(const PlaneCloud& cloud)
: cloud_(cloud), angular_spacing_(spacingOf(cloud))
{
  constexpr double kNarrow = 0.5; // length of the mean direction; 0: all around
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < cloud.points().size(); ++i)
    sum += rayTo(i);
  narrow_ = sum.norm() > kNarrow * static_cast<double>(cloud.points().size());
  if (!narrow_) {
    makeBand();
    return;
  }
  R_view_cloud_ = shortestRotation(sum, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  makeField();
}

Eigen::Vector3d
ViewBorder::rayTo(std::size_t point) const
{
  return (cloud_.points()[point] - cloud_.viewpoint(point)).cast<double>().normalized();
}

void
ViewBorder::makeField()
{
  constexpr double kLeastDepth = 0.1; // of a unit ray: some 84 degrees off the middle
  std::vector<Eigen::Vector3d> places;
  for (std::size_t i = 0; i < cloud_.points().size(); ++i) {
    const Eigen::Vector3d ray = R_view_cloud_ * rayTo(i);
    if (ray.z() > kLeastDepth)
      places.emplace_back(ray.x() / ray.z(), ray.y() / ray.z(), 0);
  }
  const auto hull = convexHull(places, Eigen::Vector3d::UnitZ());
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector3d edge = hull[(i + 1) % hull.size()] - hull[i];
    const Eigen::Vector2d out = Eigen::Vector2d(edge.y(), -edge.x()).normalized();
    sides_.emplace_back(out.x(), out.y(), out.dot(hull[i].head<2>()));
  }
}

void
ViewBorder::makeBand()
{
  lowest_ = 1;
  highest_ = -1;
  for (std::size_t i = 0; i < cloud_.points().size(); ++i) {
    lowest_ = std::min(lowest_, rayTo(i).z());
    highest_ = std::max(highest_, rayTo(i).z());
  }
}

bool
ViewBorder::touches(std::size_t point) const
{
  const double rim = kRim * angular_spacing_;
  const Eigen::Vector3d ray = R_view_cloud_ * rayTo(point);
  if (!narrow_)
    return ray.z() < lowest_ + rim || ray.z() > highest_ - rim;
  const Eigen::Vector2d place = ray.head<2>() / ray.z();
  return std::any_of(sides_.begin(), sides_.end(), [&](const Eigen::Vector3d& side) {
    return side.head<2>().dot(place) > side.z() - rim;
  });
}

} // namespace pcl6d::object_localization
