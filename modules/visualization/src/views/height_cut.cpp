// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/point_spread.h"

#include <pcl6d/common/require.h>
#include <pcl6d/visualization/height_cut.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace pcl6d {

namespace {
/** Where the nearest pose is, for each cell of a grid over the map. */
class PathGrid {
public:
  PathGrid(const Points& points,
           const std::vector<std::size_t>& indices,
           const Trajectory& trajectory);

  std::size_t
  cellOf(const Eigen::Vector3f& p) const
  {
    const Eigen::Array2f place = (p.head<2>() - corner_).array() / cell_;
    return static_cast<std::size_t>(place.y()) * columns_ +
           static_cast<std::size_t>(place.x());
  }
  /** \return how much higher the point lies than the nearest pose [m] */
  float
  heightOverPath(const Eigen::Vector3f& p) const
  {
    return p.z() - path_height_[cellOf(p)];
  }
  /** \return the share of cells along the path with points higher than cut above the
   * path [m] */
  double
  coveredShare(const Points& points,
               const std::vector<std::size_t>& indices,
               float cut) const;

private:
  Eigen::Vector2f corner_;
  float cell_ = 0.5F; // [m]
  std::size_t columns_ = 1;
  std::vector<float> path_height_;      // of the nearest pose, per cell
  std::vector<float> path_distance_sq_; // to the nearest pose, per cell
};

/** At most 500 positions, evenly chosen. */
std::vector<Eigen::Vector3f>
somePositions(const Trajectory& trajectory)
{
  const std::size_t step = trajectory.poses.size() / 500 + 1;
  std::vector<Eigen::Vector3f> positions;
  for (std::size_t i = 0; i < trajectory.poses.size(); i += step)
    if (trajectory.poses[i].translation().allFinite())
      positions.emplace_back(trajectory.poses[i].translation().cast<float>());
  return positions;
}

PathGrid::PathGrid(const Points& points,
                   const std::vector<std::size_t>& indices,
                   const Trajectory& trajectory)
{
  Eigen::AlignedBox2f box;
  for (const auto i : indices)
    box.extend(points[i].head<2>());
  constexpr float kCellsPerSide = 300; // bounds the cost for large maps
  corner_ = box.min();
  cell_ = std::max(cell_, box.sizes().maxCoeff() / kCellsPerSide);
  columns_ = static_cast<std::size_t>(box.sizes().x() / cell_) + 2;
  const auto rows = static_cast<std::size_t>(box.sizes().y() / cell_) + 2;
  const auto positions = somePositions(trajectory);
  constexpr float kFar = std::numeric_limits<float>::infinity();
  path_distance_sq_.assign(columns_ * rows, kFar);
  path_height_.assign(columns_ * rows, kFar);
  for (std::size_t i = 0; i < path_height_.size(); ++i) {
    const Eigen::Vector2f middle(static_cast<float>(i % columns_) + 0.5F,
                                 static_cast<float>(i / columns_) + 0.5F);
    const Eigen::Vector2f place = corner_ + cell_ * middle;
    for (const auto& position : positions) {
      const float distance_sq = (position.head<2>() - place).squaredNorm();
      if (distance_sq >= path_distance_sq_[i])
        continue;
      path_distance_sq_[i] = distance_sq;
      path_height_[i] = position.z();
    }
  }
}

double
PathGrid::coveredShare(const Points& points,
                       const std::vector<std::size_t>& indices,
                       float cut) const
{
  const float reach = std::max(1.5F, 2 * cell_); // [m] to both sides of the path
  enum : std::uint8_t { kOccupied = 1, kCovered = 2 };
  std::vector<std::uint8_t> cells(path_height_.size(), 0);
  for (const auto i : indices)
    cells[cellOf(points[i])] |=
        kOccupied | (heightOverPath(points[i]) > cut ? kCovered : 0);
  double along = 0, covered = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i] == 0 || path_distance_sq_[i] > reach * reach)
      continue;
    ++along;
    covered += (cells[i] & kCovered) != 0;
  }
  return along > 0 ? covered / along : 0;
}
std::vector<std::size_t>
finitePoints(const Points& points, double max_height)
{
  const auto highest = static_cast<float>(max_height);
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f& p = points[i];
    if (p.z() <= highest && visualization::canBeDrawn(p))
      indices.push_back(i);
  }
  return indices;
}

void
keepSlice(const Points& points,
          const Trajectory& trajectory,
          const HeightSlice& slice,
          std::vector<std::size_t>& indices)
{
  if (indices.empty())
    return;
  const auto half = static_cast<float>(0.5 * slice.thickness);
  std::function<bool(std::size_t)> is_outside;
  if (slice.height) {
    const auto height = static_cast<float>(*slice.height);
    is_outside = [&points, height, half](std::size_t i) {
      return std::abs(points[i].z() - height) > half;
    };
  }
  else {
    if (trajectory.poses.empty())
      throw BadArgument(
          "a slice without a height follows the path, but the run has no path");
    is_outside =
        [&points, half, grid = PathGrid(points, indices, trajectory)](std::size_t i) {
          return !(std::abs(grid.heightOverPath(points[i])) <= half);
        };
  }
  indices.erase(std::remove_if(indices.begin(), indices.end(), is_outside),
                indices.end());
}
} // namespace

void
HeightCut::validate() const
{
  if (max_height)
    require(!std::isnan(*max_height), "max_height", *max_height, "a number");
  require(
      std::isfinite(above_trajectory), "above_trajectory", above_trajectory, "finite");
  if (!slice)
    return;
  if (slice->height)
    require(std::isfinite(*slice->height), "height", *slice->height, "finite");
  require(slice->thickness > 0, "thickness", slice->thickness, "> 0");
}

ShownPoints
shownPoints(const Points& points, const Trajectory& trajectory, const HeightCut& cut)
{
  ShownPoints shown;
  shown.indices = finitePoints(
      points, cut.max_height.value_or(std::numeric_limits<double>::infinity()));
  if (cut.slice) {
    keepSlice(points, trajectory, *cut.slice, shown.indices);
    return shown;
  }
  if (cut.max_height || shown.indices.empty() || trajectory.poses.empty())
    return shown;

  const PathGrid grid(points, shown.indices, trajectory);
  const auto above = static_cast<float>(cut.above_trajectory);
  constexpr double kIndoors = 0.5; // recorded: corridor 0.9, campus 0.05
  if (grid.coveredShare(points, shown.indices, above) < kIndoors)
    return shown;
  const auto hidden = [&](std::size_t i) {
    return grid.heightOverPath(points[i]) > above;
  };
  const auto end = std::remove_if(shown.indices.begin(), shown.indices.end(), hidden);
  if (end == shown.indices.begin()) // nothing would be left
    return shown;
  shown.indices.erase(end, shown.indices.end());
  shown.ceiling_hidden = true;
  return shown;
}

} // namespace pcl6d
