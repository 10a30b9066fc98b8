// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/maps/floor_heights.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace pcl6d {

namespace {
constexpr double kSlope = 0.3; ///< largest of a floor, Vosselman 2000
constexpr double kStep = FloorLayers::kLayer / 2; ///< [m] rounding error of layers
/** A path over floor is preferred to a path through an obstacle of a quarter of the length. */
constexpr double kCostOfGap = 4;

/** \brief Growth of the floor over the cells of a raster, nearest cells first (Dijkstra). */
class GrowingFloor {
public:
  GrowingFloor(const MapRaster& raster, const FloorLayers& layers)
  : raster_(raster), layers_(layers), cells_(raster.size())
  {}

  void
  seed(std::size_t index, double height)
  {
    if (cells_[index].cost == 0)
      return; // the cell has a scanner already
    cells_[index] = {0, height, 0, false};
    queue_.push({0, index});
  }

  void
  grow()
  {
    while (!queue_.empty()) {
      const std::size_t index = queue_.top().second;
      queue_.pop();
      if (cells_[index].is_final)
        continue;
      cells_[index].is_final = true;
      const auto column = static_cast<std::ptrdiff_t>(index % raster_.columns);
      const auto row = static_cast<std::ptrdiff_t>(index / raster_.columns);
      for (std::ptrdiff_t dx = -1; dx <= 1; ++dx)
        for (std::ptrdiff_t dy = -1; dy <= 1; ++dy)
          growTo(cells_[index], column + dx, row + dy, std::hypot(dx, dy));
    }
  }

  std::vector<float>
  heights() const
  {
    std::vector<float> heights;
    heights.reserve(cells_.size());
    for (const Cell& cell : cells_)
      heights.push_back(static_cast<float>(cell.height));
    return heights;
  }

private:
  struct Cell {
    double cost =
        std::numeric_limits<double>::infinity(); ///< of the way from a scanner
    double height = 0;                           ///< [m]
    double gap = 0;                              ///< [m] since the floor was measured
    bool is_final = false;
  };
  using Waiting = std::pair<double, std::size_t>; ///< cost and cell

  /** \return the layer nearest to the height of the floor; null: no layer within reach */
  const FloorLayers::Layer*
  layerNear(std::size_t index, double height, double reach) const
  {
    const Eigen::Vector2d centre = raster_.centreOf(index);
    const FloorLayers::Layer* best = nullptr;
    double least = kStep + kSlope * reach;
    for (const auto& layer : layers_.at(centre.x(), centre.y())) {
      const double distance = std::abs(layer.height() - height);
      if (distance <= least) {
        least = distance;
        best = &layer;
      }
    }
    return best;
  }

  void
  growTo(const Cell& from, std::ptrdiff_t column, std::ptrdiff_t row, double steps)
  {
    if (column < 0 || row < 0 ||
        column >= static_cast<std::ptrdiff_t>(raster_.columns) ||
        row >= static_cast<std::ptrdiff_t>(raster_.rows))
      return;
    const auto index = static_cast<std::size_t>(row) * raster_.columns +
                       static_cast<std::size_t>(column);
    Cell& cell = cells_[index];
    if (cell.is_final)
      return;
    const double way = steps * raster_.resolution;
    const auto* const layer = layerNear(index, from.height, from.gap + way);
    const double cost = from.cost + (layer != nullptr ? way : kCostOfGap * way);
    if (cost >= cell.cost)
      return;
    cell = {cost,
            layer != nullptr ? layer->height() : from.height,
            layer != nullptr ? 0 : from.gap + way,
            false};
    queue_.push({cost, index});
  }

  const MapRaster& raster_;
  const FloorLayers& layers_;
  std::vector<Cell> cells_;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> queue_;
};
} // namespace

FloorHeights::FloorHeights(double height) : lowest_(height), highest_(height)
{}

FloorHeights::FloorHeights(const FloorLayers& layers,
                           const MapExtent& extent,
                           std::size_t most_cells)
{
  MapRaster raster;
  try {
    raster = extent.raster(FloorLayers::kCell, most_cells);
  } catch (const BadArgument&) { // the message names an option that was not given
    throw ComputeFailed("the map is too large: the floor, in cells of 0.5 m, takes "
                        "more memory than allowed");
  }
  GrowingFloor floor(raster, layers);
  is_known_ = false;
  lowest_ = std::numeric_limits<double>::infinity();
  for (const auto& scanner : layers.scanners()) {
    lowest_ = std::min(lowest_, static_cast<double>(scanner.z()));
    const std::size_t index = raster.indexOf(scanner.x(), scanner.y());
    const auto height = layers.floorBelow(scanner);
    if (!height || index == raster.size())
      continue;
    is_known_ = true;
    floor.seed(index, *height);
  }
  highest_ = lowest_;
  if (!is_known_)
    return;
  floor.grow();
  raster_ = raster;
  heights_ = floor.heights();
  const auto [least, most] = std::minmax_element(heights_.begin(), heights_.end());
  lowest_ = *least;
  highest_ = *most;
}

double
FloorHeights::at(double x, double y) const
{
  if (heights_.empty())
    return lowest_;
  const auto place = [&](double coordinate, double corner, std::size_t cells) {
    const double middle = (coordinate - corner) / raster_.resolution - 0.5;
    return std::clamp(middle, 0.0, static_cast<double>(cells - 1));
  };
  const double column = place(x, raster_.corner.x(), raster_.columns);
  const double row = place(y, raster_.corner.y(), raster_.rows);
  const auto left = static_cast<std::size_t>(column);
  const auto below = static_cast<std::size_t>(row);
  const std::size_t right = std::min(left + 1, raster_.columns - 1);
  const std::size_t above = std::min(below + 1, raster_.rows - 1);
  const double u = column - static_cast<double>(left);
  const double v = row - static_cast<double>(below);
  const auto height = [&](std::size_t i, std::size_t j) {
    return static_cast<double>(heights_[j * raster_.columns + i]);
  };
  return (1 - v) * ((1 - u) * height(left, below) + u * height(right, below)) +
         v * ((1 - u) * height(left, above) + u * height(right, above));
}

double
medianHeight(const Points& places, const FloorHeights& floor)
{
  std::vector<double> heights;
  heights.reserve(places.size());
  for (const auto& p : places)
    heights.push_back(static_cast<double>(p.z()) - floor.at(p.x(), p.y()));
  std::sort(heights.begin(), heights.end());
  return heights.empty() ? 0 : heights[heights.size() / 2];
}

} // namespace pcl6d
