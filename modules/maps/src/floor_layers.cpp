// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/maps/floor_heights.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace pcl6d {

namespace {
constexpr std::int64_t kHalf = std::int64_t{1}
                               << 31; ///< cells on each side of the origin
constexpr double kAround = 3; ///< [m] about a scanner: nearer than most obstacles
/** Minimum points of a floor layer, as a share of the densest layer in the cell. */
constexpr double kDense = 0.2;
constexpr std::size_t kLeastVotes = 3; ///< a single pole has one or two

std::int64_t
floorCell(double coordinate)
{
  return static_cast<std::int64_t>(std::floor(coordinate / FloorLayers::kCell));
}

std::uint64_t
floorKey(double x, double y)
{
  return static_cast<std::uint64_t>(floorCell(x) + kHalf) << 32U |
         static_cast<std::uint64_t>(floorCell(y) + kHalf);
}

std::int32_t
layerNumber(double z)
{
  constexpr double kMost = 1 << 30;
  return static_cast<std::int32_t>(
      std::clamp(std::floor(z / FloorLayers::kLayer), -kMost, kMost));
}

/** \return the lowest dense layer below a height, or null */
const FloorLayers::Layer*
lowestDense(const std::vector<FloorLayers::Layer>& layers, double below)
{
  std::uint32_t most = 0;
  for (const auto& layer : layers)
    if (layer.height() < below)
      most = std::max(most, layer.points);
  for (const auto& layer : layers)
    if (layer.height() < below && layer.points >= kDense * most)
      return &layer;
  return nullptr;
}
} // namespace

void
FloorLayers::add(const MappedScan& scan)
{
  if (!scan.points.empty())
    scanners_.push_back(scan.origin);
  for (const auto& p : scan.points) {
    std::vector<Layer>& layers = cells_[floorKey(p.x(), p.y())];
    const std::int32_t number = layerNumber(p.z());
    auto place = std::lower_bound(
        layers.begin(), layers.end(), number, [](const Layer& layer, std::int32_t n) {
          return layer.number < n;
        });
    if (place == layers.end() || place->number != number)
      place = layers.insert(place, {number, 0, 0});
    ++place->points;
    place->sum += static_cast<double>(p.z());
  }
}

const std::vector<FloorLayers::Layer>&
FloorLayers::at(double x, double y) const
{
  static const std::vector<Layer> none;
  const auto found = cells_.find(floorKey(x, y));
  return found == cells_.end() ? none : found->second;
}

std::optional<double>
FloorLayers::floorBelow(const Eigen::Vector3f& scanner) const
{
  struct Votes {
    std::size_t cells = 0;
    double sum = 0; ///< [m]
  };
  std::map<std::int32_t, Votes> votes; // by number of the layer
  constexpr int kCells = static_cast<int>(kAround / kCell);
  for (int i = -kCells; i <= kCells; ++i)
    for (int j = -kCells; j <= kCells; ++j) {
      const double x = kCell * i, y = kCell * j;
      if (std::hypot(x, y) > kAround)
        continue;
      const Layer* const layer =
          lowestDense(at(scanner.x() + x, scanner.y() + y), scanner.z());
      if (layer == nullptr)
        continue;
      ++votes[layer->number].cells;
      votes[layer->number].sum += layer->height();
    }
  const auto most =
      std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) {
        return a.second.cells < b.second.cells;
      });
  if (most == votes.end() || most->second.cells < kLeastVotes)
    return {};
  return most->second.sum / static_cast<double>(most->second.cells);
}

} // namespace pcl6d
