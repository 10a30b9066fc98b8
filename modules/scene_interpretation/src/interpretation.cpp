// SPDX-License-Identifier: BSD-3-Clause
#include "label_network.h"
#include "storeys.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/scene_interpretation/interpretation.h>

#include <Eigen/Geometry>

#include <cmath>

namespace pcl6d {
using namespace scene_interpretation;

namespace {
constexpr double kWorthPerSquareMetre = 1e6; // whole numbers: sums without rounding

void
requireFinite(const std::vector<Plane>& planes)
{
  const auto isFinite = [](const Plane& plane) {
    for (const auto& corner : plane.hull)
      if (!corner.allFinite())
        return false;
    return plane.normal.allFinite() && std::isfinite(plane.offset) &&
           std::abs(plane.normal.norm() - 1) < 1e-6;
  };
  for (std::size_t i = 0; i < planes.size(); ++i) {
    require(isFinite(planes[i]), "plane", i, "finite, with a normal of length 1");
    require(planes[i].area >= 0 && planes[i].area < 1e9,
            ("area of plane " + std::to_string(i)).c_str(),
            planes[i].area,
            "in [0, 1e9) [m^2]");
  }
}

// Direction from a plane towards the sensor, where the visible side is unknown.
Eigen::Vector3d
towardsSensor(const Plane& plane, const Eigen::Vector3d& sensor)
{
  return (plane.normal.dot(sensor) - plane.offset) * plane.normal;
}

std::vector<ScenePlane>
levelledPlanes(const std::vector<Plane>& planes,
               const std::vector<Eigen::Vector3d>& seen_from,
               const InterpretationOptions& options,
               const Eigen::Vector3d& up)
{
  const Eigen::Matrix3d R_level_map =
      shortestRotation(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  std::vector<ScenePlane> levelled;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    Eigen::Vector3d side =
        seen_from.empty() ? Eigen::Vector3d::Zero().eval() : seen_from[i];
    if (side.isZero() && options.sensor)
      side = towardsSensor(planes[i], *options.sensor);
    levelled.push_back(levelledPlane(planes[i], R_level_map, side));
  }
  return levelled;
}
} // namespace

void
InterpretationOptions::validate() const
{
  constexpr double kQuarter = 1.5707963267948966; // [rad] 90 deg
  tolerances.validate();
  if (up)
    require(up->allFinite() && up->norm() > 0, "up", up->transpose(), "no zero vector");
  require(max_tilt > 0 && max_tilt < kQuarter, "max_tilt", max_tilt, "in (0, pi/2)");
  require(min_headroom > 0, "min_headroom", min_headroom, "> 0 [m]");
  require(min_floor_area >= 0, "min_floor_area", min_floor_area, ">= 0 [m^2]");
  require(node_limit > 0, "node_limit", node_limit, "> 0");
}

ConstraintNetwork
LabelProblem::network(unsigned int num_threads) const
{
  ConstraintNetwork network;
  std::vector<std::size_t> first; // index of each plane's first value
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    first.push_back(network.values.size());
    network.worth.push_back(std::llround(planes_[i].area * kWorthPerSquareMetre));
    for (std::size_t label = 0; label < rules_.labels.size(); ++label)
      if (!misfit(i, label))
        network.values.push_back({i, label, {}, {}});
  }
  parallelFor(network.values.size(), num_threads, [&](std::size_t v) {
    NetworkValue& value = network.values[v];
    for (std::size_t o = 0; o < network.values.size(); ++o) {
      const NetworkValue& other = network.values[o];
      if (other.variable != value.variable &&
          forbids(value.variable, value.label, other.variable, other.label))
        value.conflicts.push_back(o);
    }
    for (const auto& need : rules_.needs) {
      if (need.label != value.label)
        continue;
      value.needs.emplace_back();
      for (std::size_t o = 0; o < network.values.size(); ++o)
        if (network.values[o].label == need.partner &&
            network.values[o].variable != value.variable &&
            meets(need, value.variable, network.values[o].variable))
          value.needs.back().push_back(o);
    }
  });
  return network;
}

Interpretation
interpretPlanes(const std::vector<Plane>& planes,
                const std::vector<Eigen::Vector3d>& seen_from,
                const LabelRules& rules,
                const InterpretationOptions& options)
{
  options.validate();
  requireFinite(planes);
  require(seen_from.empty() || seen_from.size() == planes.size(),
          "number of sides seen",
          seen_from.size(),
          "that of the planes, " + std::to_string(planes.size()));
  Interpretation result;
  if (options.up)
    result.up = options.up->normalized();
  else if (const auto up =
               estimateUp(planes, options.tolerances.angle, options.max_tilt))
    result.up = *up;
  std::vector<ScenePlane> scene = levelledPlanes(planes, seen_from, options, result.up);
  findStoreys(scene, options, result);
  const LabelProblem problem(scene, result.storey_of, rules, options.tolerances);
  const ConstraintNetwork network = problem.network(options.num_threads);
  const NetworkSolution solution = solve(network, options.node_limit);
  result.nodes = solution.nodes;
  result.status = solution.is_complete ? Status::kOk : Status::kMaxIterations;
  std::vector<std::size_t> labels;
  for (const auto value : solution.chosen)
    labels.push_back(value == NetworkSolution::kNone ? rules.labels.size()
                                                     : network.values[value].label);
  for (const auto label : labels)
    result.labels.push_back(label < rules.labels.size() ? rules.labels[label].name
                                                        : "none");
  result.explanations = explain(problem, labels);
  return result;
}

Interpretation
interpretScene(const std::vector<PlaneSegment>& segments,
               const LabelRules& rules,
               const InterpretationOptions& options)
{
  std::vector<Plane> planes;
  std::vector<Eigen::Vector3d> seen_from;
  for (const auto& segment : segments) {
    planes.push_back(segment.plane);
    seen_from.push_back(segment.seen_from);
  }
  return interpretPlanes(planes, seen_from, rules, options);
}

void
applyLabels(const Interpretation& interpretation, std::vector<PlaneSegment>& segments)
{
  require(interpretation.labels.size() == segments.size(),
          "number of labels",
          interpretation.labels.size(),
          "that of the planes, " + std::to_string(segments.size()));
  for (std::size_t i = 0; i < segments.size(); ++i)
    segments[i].plane.label = interpretation.labels[i];
}

} // namespace pcl6d
