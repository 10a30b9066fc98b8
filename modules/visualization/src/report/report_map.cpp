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

/** \return the value below which a share of the values is. \param[in,out] values get
 * another order */
double
quantileOf(std::vector<float>& values, double share)
{
  const auto place =
      values.begin() +
      static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/** \return where the points are but for a few far ones: from the 0.1 % to the 99.9 %
 * quantile of each coordinate and as much again to both sides */
Eigen::AlignedBox3d
extentOf(const Points& points, const std::vector<std::size_t>& indices)
{
  Eigen::AlignedBox3d all, most;
  Eigen::Vector3d low, high;
  for (const auto i : indices)
    all.extend(points[i].cast<double>());
  std::vector<float> values(indices.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(indices.begin(), indices.end(), values.begin(), [&](std::size_t i) {
      return points[i][axis];
    });
    low[axis] = quantileOf(values, 0.001);
    high[axis] = quantileOf(values, 0.999);
  }
  const double reach = (high - low).maxCoeff();
  most.extend(low - Eigen::Vector3d::Constant(reach));
  most.extend(high + Eigen::Vector3d::Constant(reach));
  return all.intersection(most);
}

/** \return the indices of the points that a report shows */
std::vector<std::size_t>
chosenPoints(const Points& points, std::size_t max_points, Eigen::AlignedBox3d& extent)
{
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (canBeDrawn(points[i]))
      chosen.push_back(i);
  if (chosen.empty())
    return chosen;
  extent = extentOf(points, chosen);
  const auto is_far = [&](std::size_t i) {
    return !extent.contains(points[i].cast<double>());
  };
  chosen.erase(std::remove_if(chosen.begin(), chosen.end(), is_far), chosen.end());
  return thinned(chosen, max_points);
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

/** \return what is above the highest point that a top view shows, if that cuts a ceiling
 * away */
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
  Eigen::AlignedBox3d extent;
  const Points& points = data.map.points;
  const std::vector<std::size_t> chosen = chosenPoints(points, max_points, extent);
  if (chosen.empty())
    return map;
  map.origin = extent.min();
  map.step = std::max(extent.sizes().maxCoeff(), 1e-3) / kLargest;
  map.positions.reserve(3 * chosen.size());
  for (const auto i : chosen)
    for (int axis = 0; axis < 3; ++axis)
      map.positions.push_back(static_cast<std::uint16_t>(std::lround(
          (static_cast<double>(points[i][axis]) - map.origin[axis]) / map.step)));
  if (!data.map.scans.empty() && data.summary.scans.size() < kLargest)
    map.scans = scanPlaces(data, chosen);
  if (!data.map.intensities.empty())
    map.intensities = greyValues(data.map.intensities, chosen);
  map.ceiling = ceilingOf(data);
  return map;
}

} // namespace pcl6d::visualization
