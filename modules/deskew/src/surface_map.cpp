// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/require.h>
#include <pcl6d/deskew/surface_map.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
/** A plane has three parameters; twice this number of points gives a usable variance. */
constexpr double kLeastPoints = 6;

/** Points of a plane that fill their cell spread by edge / sqrt(12) both ways; points on a line, or
 * in a corner of the cell, spread less than a third of this value and fix no normal. */
constexpr double kLeastSpread = 0.1;

constexpr std::size_t kMostLevels = 8;

/** A larger cell is taken if its variance is at most this multiple of the smaller cell's: the
 * variance of a few dozen points varies by this factor between equal surfaces. */
constexpr double kSameVariance = 1.5;

Eigen::Vector3d
centreOf(VoxelKey key, double edge)
{
  return voxelCentre(key, edge).cast<double>();
}
} // namespace

void
SurfaceMapOptions::validate() const
{
  require(std::isfinite(cell) && cell > 0, "cell", cell, "finite and > 0");
  require(levels >= 1 && levels <= static_cast<int>(kMostLevels),
          "levels",
          levels,
          "in [1, 8]");
  require(flatness > 1, "flatness", flatness, "> 1");
  require(points_of_scan >= 1, "points_of_scan", points_of_scan, ">= 1");
  require(points_of_cell >= 1, "points_of_cell", points_of_cell, ">= 1");
}

SurfaceMap::SurfaceMap(const SurfaceMapOptions& options) : options_(options)
{
  options_.validate();
  levels_.resize(static_cast<std::size_t>(options_.levels));
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    levels_[l].edge = std::ldexp(options_.cell, static_cast<int>(l));
    levels_[l].index = l;
  }
}

/** \param[in,out] touched numbers of the cells that have fresh points */
SurfaceMap::Cell&
SurfaceMap::cellOf(const Eigen::Vector3d& place,
                   Level& level,
                   std::vector<std::size_t>& touched)
{
  const VoxelKey key = voxelKey(place.cast<float>(), level.edge);
  const auto [number, is_new] = level.numbers.add(key);
  if (is_new) {
    Cell& cell = level.cells.emplace_back();
    cell.key = key;
    cell.plane.number = number * kMostLevels + level.index;
  }
  if (level.cells[number].fresh.count == 0)
    touched.push_back(number);
  return level.cells[number];
}

/** Adds sums about another point. \param[in] offset from the centre of `to` to the
 * centre of `from` */
void
SurfaceMap::shift(const Sums& from, const Eigen::Vector3d& offset, Sums& to)
{
  const Eigen::Matrix3d mixed = from.first * offset.transpose();
  to.count += from.count;
  to.first += from.first + from.count * offset;
  to.second += from.second + mixed + mixed.transpose() +
               from.count * offset * offset.transpose();
}

void
SurfaceMap::add(const std::vector<Eigen::Vector3d>& points)
{
  std::vector<std::size_t> touched;
  Level& finest = levels_.front();
  for (const Eigen::Vector3d& p : points) {
    if (!p.allFinite())
      continue;
    Cell& cell = cellOf(p, finest, touched);
    const Eigen::Vector3d offset = p - centreOf(cell.key, finest.edge);
    cell.fresh.count += 1;
    cell.fresh.first += offset;
    cell.fresh.second += offset * offset.transpose();
  }
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    Level& level = levels_[l];
    std::vector<std::size_t> above;
    for (const std::size_t number : touched) {
      Cell& cell = level.cells[number];
      if (l + 1 < levels_.size()) {
        Level& next = levels_[l + 1];
        const Eigen::Vector3d centre = centreOf(cell.key, level.edge);
        Cell& parent = cellOf(centre, next, above);
        shift(cell.fresh, centre - centreOf(parent.key, next.edge), parent.fresh);
      }
      takeFresh(cell, level.edge);
    }
    touched = std::move(above);
  }
}

void
SurfaceMap::takeFresh(Cell& cell, double edge) const
{
  const double weight = std::min(1.0, options_.points_of_scan / cell.fresh.count);
  const double room = options_.points_of_cell - weight * cell.fresh.count;
  const double kept =
      cell.sums.count > 0 ? std::clamp(room / cell.sums.count, 0.0, 1.0) : 1;
  cell.sums.count = kept * cell.sums.count + weight * cell.fresh.count;
  cell.sums.first = kept * cell.sums.first + weight * cell.fresh.first;
  cell.sums.second = kept * cell.sums.second + weight * cell.fresh.second;
  cell.fresh = Sums();
  findPlane(cell, edge);
}

void
SurfaceMap::findPlane(Cell& cell, double edge) const
{
  cell.is_flat = false;
  const double count = cell.sums.count;
  if (count < kLeastPoints)
    return;
  const Eigen::Vector3d mean = cell.sums.first / count;
  const Eigen::Matrix3d spread =
      (cell.sums.second - cell.sums.first * mean.transpose()) / count;
  const SymmetricEigen<3> axes = symmetricEigen<3>(spread);
  const double least = kLeastSpread * edge;
  // Three parameters were fitted to the points.
  const double across = std::max(0.0, axes.values(0)) * count / (count - 3);
  if (axes.values(1) < least * least ||
      across * options_.flatness * options_.flatness > axes.values(1))
    return;
  cell.is_flat = true;
  cell.plane.mean = centreOf(cell.key, edge) + mean;
  cell.plane.normal = axes.vectors.col(0);
  cell.plane.variance = across;
}

void
SurfaceMap::forgetBeyond(const Eigen::Vector3d& place, double distance)
{
  for (Level& level : levels_) {
    VoxelNumbers numbers;
    std::vector<Cell> cells;
    for (Cell& cell : level.cells)
      if ((centreOf(cell.key, level.edge) - place).norm() <= distance) {
        numbers.add(cell.key);
        cells.push_back(cell);
      }
    level.numbers = std::move(numbers);
    level.cells = std::move(cells);
  }
}

const SurfacePlane*
SurfaceMap::planeAt(const Eigen::Vector3d& place) const
{
  const SurfacePlane* found = nullptr;
  if (!place.allFinite())
    return found;
  for (const Level& level : levels_) {
    const std::size_t number =
        level.numbers.find(voxelKey(place.cast<float>(), level.edge));
    if (number == level.numbers.size() || !level.cells[number].is_flat)
      continue;
    const SurfacePlane& plane = level.cells[number].plane;
    if (!found || plane.variance <= kSameVariance * found->variance)
      found = &plane;
  }
  return found;
}

} // namespace pcl6d
