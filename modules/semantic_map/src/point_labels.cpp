// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/semantic_map/point_labels.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
namespace {
constexpr std::size_t kBlock = 4096; // points of a block

Eigen::AlignedBox3d
grown(const Eigen::AlignedBox3d& box, double margin)
{
  const Eigen::Vector3d all = Eigen::Vector3d::Constant(margin);
  return {box.min() - all, box.max() + all};
}

Eigen::AlignedBox3d
boundsInWorld(const ObjectPose& object, double margin)
{
  const Eigen::AlignedBox3d box = grown(object.box, margin);
  Eigen::AlignedBox3d bounds;
  for (int corner = 0; corner < 8; ++corner)
    bounds.extend(object.T_world_object *
                  box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
  return bounds;
}
} // namespace

void
PointLabelOptions::validate() const
{
  require(plane_distance > 0, "plane_distance", plane_distance, "> 0 [m]");
  require(skin >= 0, "skin", skin, ">= 0 [m]");
  require(box_margin >= 0, "box_margin", box_margin, ">= 0 [m]");
}

PointLabeller::PointLabeller(const SemanticMap& map, const PointLabelOptions& options)
: map_(map), options_(options)
{
  options_.validate();
  const std::vector<std::string> names = map.labelNames();
  const auto labelOf = [&](const std::string& name) {
    return static_cast<std::uint32_t>(std::find(names.begin(), names.end(), name) -
                                      names.begin());
  };
  for (const auto& entry : map.planes) {
    const Plane& plane = entry.best();
    Prism prism{HullPrism(plane), {}};
    for (const auto& corner : plane.hull)
      prism.bounds.extend(corner);
    if (!plane.hull.empty())
      prism.bounds = grown(prism.bounds, 2 * options_.plane_distance);
    prisms_.push_back(prism);
    plane_label_.push_back(labelOf(plane.label));
  }
  for (const auto& object : map.objects) {
    bounds_.push_back(boundsInWorld(object.pose, options_.box_margin));
    object_label_.push_back(labelOf(object.pose.object_class));
  }
}

std::size_t
PointLabeller::planeOf(const Eigen::Vector3d& point, double& distance) const
{
  std::size_t nearest = 0;
  distance = options_.plane_distance;
  for (std::size_t i = 0; i < prisms_.size(); ++i) {
    const Plane& plane = map_.planes[i].best();
    const double off = std::abs(plane.normal.dot(point) - plane.offset);
    if (off > distance || (nearest != 0 && off == distance) ||
        !prisms_[i].bounds.contains(point) ||
        !prisms_[i].hull.covers(point, options_.plane_distance))
      continue;
    nearest = i + 1;
    distance = off;
  }
  return nearest;
}

std::size_t
PointLabeller::objectOf(const Eigen::Vector3d& point) const
{
  std::size_t smallest = 0;
  double volume = 0;
  for (std::size_t i = 0; i < bounds_.size(); ++i) {
    if (!bounds_[i].contains(point))
      continue;
    const ObjectPose& object = map_.objects[i].pose;
    const Eigen::AlignedBox3d box = grown(object.box, options_.box_margin);
    if (!box.contains(object.T_world_object.inverse() * point))
      continue;
    if (smallest == 0 || box.volume() < volume) {
      smallest = i + 1;
      volume = box.volume();
    }
  }
  return smallest;
}

PointLabels
PointLabeller::label(const Points& points,
                     const Eigen::Isometry3d& T_world_points) const
{
  PointLabels labels;
  for (auto* field : {&labels.label, &labels.plane_id, &labels.object_id})
    field->assign(points.size(), 0);
  parallelBlocks(points.size(), kBlock, options_.num_threads, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const Eigen::Vector3d point = T_world_points * points[i].cast<double>();
      double distance = 0;
      const std::size_t plane = planeOf(point, distance);
      const bool is_sure =
          plane != 0 && plane_label_[plane - 1] != 0 && distance <= options_.skin;
      const std::size_t object = is_sure ? 0 : objectOf(point);
      labels.plane_id[i] = static_cast<std::uint32_t>(plane);
      labels.object_id[i] = static_cast<std::uint32_t>(object);
      labels.label[i] = object != 0  ? object_label_[object - 1]
                        : plane != 0 ? plane_label_[plane - 1]
                                     : 0;
    }
  });
  return labels;
}

} // namespace pcl6d
