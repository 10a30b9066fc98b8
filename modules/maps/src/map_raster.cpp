// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/maps/map_raster.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace pcl6d {

namespace {
/** \return how many cells an axis needs */
double
cellsAlong(double least, double most, double resolution)
{
  return std::floor(most / resolution) - std::floor(least / resolution) + 1;
}

double
cellsOf(const Eigen::AlignedBox3d& box, double resolution)
{
  return cellsAlong(box.min().x(), box.max().x(), resolution) *
         cellsAlong(box.min().y(), box.max().y(), resolution);
}
} // namespace

std::size_t
MapRaster::indexOf(double x, double y) const
{
  const double column = std::floor((x - corner.x()) / resolution);
  const double row = std::floor((y - corner.y()) / resolution);
  if (!(column >= 0 && row >= 0 && column < static_cast<double>(columns) &&
        row < static_cast<double>(rows)))
    return size();
  return static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
}

Eigen::Vector2d
MapRaster::centreOf(std::size_t index) const
{
  const std::size_t column = index % columns, row = index / columns;
  return corner + resolution * Eigen::Vector2d(static_cast<double>(column) + 0.5,
                                               static_cast<double>(row) + 0.5);
}

void
MapExtent::add(const MappedScan& scan)
{
  for (const auto& p : scan.points)
    box_.extend(p.cast<double>());
  if (!scan.points.empty())
    box_.extend(scan.origin.cast<double>());
}

double
MapExtent::leastResolution(std::size_t most_cells) const
{
  constexpr std::size_t kAroundOrigin = 4; // least cells of a box around the origin
  const auto most = static_cast<double>(std::max(most_cells, kAroundOrigin));
  const Eigen::Vector3d size = box_.sizes();
  double resolution = std::sqrt(size.x() * size.y() / most);
  do
    resolution = std::ceil(resolution * 1.01 * 1000 + 1) / 1000;
  while (cellsOf(box_, resolution) > most);
  return resolution;
}

MapRaster
MapExtent::raster(double resolution, std::size_t most_cells) const
{
  require(std::isfinite(resolution) && resolution > 0,
          "resolution",
          resolution,
          "> 0 and finite");
  if (box_.isEmpty())
    throw ComputeFailed("the map is empty: no scan has points");
  if (cellsOf(box_, resolution) > static_cast<double>(most_cells)) {
    std::ostringstream rule;
    rule << "at least " << leastResolution(most_cells) << " [m] in " << most_cells
         << " cells, the most that fit into the memory; the map is "
         << std::ceil(box_.sizes().x()) << " m x " << std::ceil(box_.sizes().y())
         << " m";
    require(false, "resolution", resolution, rule.str());
  }
  MapRaster raster;
  raster.resolution = resolution;
  constexpr double kStepsOfMetre = 1e9; // -4.1, where -41 x 0.1 is -4.1000000000000005
  for (int k = 0; k < 2; ++k)
    raster.corner[k] = std::round(std::floor(box_.min()[k] / resolution) * resolution *
                                  kStepsOfMetre) /
                       kStepsOfMetre;
  raster.columns =
      static_cast<std::size_t>(cellsAlong(box_.min().x(), box_.max().x(), resolution));
  raster.rows =
      static_cast<std::size_t>(cellsAlong(box_.min().y(), box_.max().y(), resolution));
  return raster;
}

} // namespace pcl6d
