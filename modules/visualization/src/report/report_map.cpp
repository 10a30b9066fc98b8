// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/point_spread.h"
#include "report/report_map.h"

#include <pcl6d/visualization/height_cut.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace pcl6d::visualization {

namespace {
constexpr double kLargest = 65535; // of a 16-bit number

/** \return the quantile of the values at a share. \param[in,out] values are reordered */
double
quantileOf(std::vector<float>& values, double share)
{
  const auto place =
      values.begin() +
      static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/** \brief Points and the selection to show. */
struct Chosen {
  const Points& points;
  std::vector<std::size_t> indices; ///< ascending; at first every drawable point

  explicit Chosen(const Points& all) : points(all)
  {
    for (std::size_t i = 0; i < points.size(); ++i)
      if (canBeDrawn(points[i]))
        indices.push_back(i);
  }
};

/** \return extent of the points without isolated far points: from the 0.1 % to the 99.9
 * % quantile of each coordinate, extended by its length to both sides */
Eigen::AlignedBox3d
extentOf(const Chosen& map, const Chosen& moving)
{
  Eigen::AlignedBox3d all, most;
  Eigen::Vector3d low, high;
  for (const Chosen* part : {&map, &moving})
    for (const auto i : part->indices)
      all.extend(part->points[i].cast<double>());
  std::vector<float> values;
  for (int axis = 0; axis < 3; ++axis) {
    values.clear();
    for (const Chosen* part : {&map, &moving})
      for (const auto i : part->indices)
        values.push_back(part->points[i][axis]);
    low[axis] = quantileOf(values, 0.001);
    high[axis] = quantileOf(values, 0.999);
  }
  const double reach = (high - low).maxCoeff();
  most.extend(low - Eigen::Vector3d::Constant(reach));
  most.extend(high + Eigen::Vector3d::Constant(reach));
  return all.intersection(most);
}

/** Leaves out points outside the box, and thins the rest to a budget. */
void
keepWithin(const Eigen::AlignedBox3d& box, std::size_t max_points, Chosen& chosen)
{
  auto& indices = chosen.indices;
  const auto is_far = [&](std::size_t i) {
    return !box.contains(chosen.points[i].cast<double>());
  };
  indices.erase(std::remove_if(indices.begin(), indices.end(), is_far), indices.end());
  indices = thinned(indices, max_points);
}

/** \return x y z of each point, in the steps of the map */
std::vector<std::uint16_t>
stepsOf(const Chosen& chosen, const ReportMap& map)
{
  std::vector<std::uint16_t> steps;
  steps.reserve(3 * chosen.indices.size());
  for (const auto i : chosen.indices)
    for (int axis = 0; axis < 3; ++axis)
      steps.push_back(static_cast<std::uint16_t>(
          std::lround((static_cast<double>(chosen.points[i][axis]) - map.origin[axis]) /
                      map.step)));
  return steps;
}

std::vector<std::uint16_t>
scanPlaces(const ReportData& data, const std::vector<std::size_t>& chosen)
{
  std::unordered_map<std::uint32_t, std::uint16_t> place_of;
  for (std::size_t place = 0; place < data.summary.scans.size(); ++place)
    place_of.emplace(static_cast<std::uint32_t>(data.summary.scans[place].index),
                     static_cast<std::uint16_t>(place));
  std::vector<std::uint16_t> places;
  places.reserve(chosen.size());
  for (const auto i : chosen) {
    const auto found = place_of.find(data.map.scans[i]);
    places.push_back(found == place_of.end() ? std::numeric_limits<std::uint16_t>::max()
                                             : found->second);
  }
  return places;
}

std::vector<std::uint8_t>
greyValues(const std::vector<float>& intensities,
           const std::vector<std::size_t>& chosen)
{
  std::vector<float> values;
  for (const auto i : chosen)
    if (std::isfinite(intensities[i]))
      values.push_back(intensities[i]);
  if (values.empty())
    return {};
  const double low = quantileOf(values, 0.01);
  const double span = std::max(quantileOf(values, 0.99) - low, 1e-9);
  std::vector<std::uint8_t> grey;
  grey.reserve(chosen.size());
  for (const auto i : chosen) {
    const double share = (static_cast<double>(intensities[i]) - low) / span;
    grey.push_back(static_cast<std::uint8_t>(
        std::isfinite(share) ? std::lround(255 * std::clamp(share, 0.0, 1.0)) : 0));
  }
  return grey;
}

/** \return the height above the highest visible point of a top view, if a ceiling is
 * cut away */
std::optional<double>
ceilingOf(const ReportData& data)
{
  Trajectory trajectory;
  for (const auto& scan : data.summary.scans) {
    Eigen::Isometry3d pose = scan.T_world_scan;
    pose.translation() -= data.summary.world_offset;
    trajectory.poses.push_back(pose);
  }
  const ShownPoints shown = shownPoints(data.map.points, trajectory, HeightCut());
  if (!shown.ceiling_hidden)
    return std::nullopt;
  double highest = -std::numeric_limits<double>::infinity();
  for (const auto i : shown.indices)
    highest = std::max(highest, static_cast<double>(data.map.points[i].z()));
  return highest;
}
} // namespace

ReportMap
reportMapOf(const ReportData& data, std::size_t max_points)
{
  ReportMap map;
  Chosen standing(data.map.points), moving(data.moving.points);
  if (standing.indices.empty() && moving.indices.empty())
    return map;
  const Eigen::AlignedBox3d extent = extentOf(standing, moving);
  keepWithin(extent, max_points / 4, moving); // few points, but the most interesting
  keepWithin(extent, max_points - moving.indices.size(), standing);
  map.origin = extent.min();
  map.step = std::max(extent.sizes().maxCoeff(), 1e-3) / kLargest;
  map.positions = stepsOf(standing, map);
  map.moving = stepsOf(moving, map);
  const std::vector<std::size_t>& chosen = standing.indices;
  if (!data.map.scans.empty() && data.summary.scans.size() < kLargest)
    map.scans = scanPlaces(data, chosen);
  if (!data.map.intensities.empty())
    map.intensities = greyValues(data.map.intensities, chosen);
  if (!chosen.empty())
    map.ceiling = ceilingOf(data);
  return map;
}

} // namespace pcl6d::visualization
