// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/maps/height_map.h>

#include <algorithm>

namespace pcl6d {

HeightMap::HeightMap(const MapRaster& raster) : raster_(raster), cells_(raster.size())
{}

void
HeightMap::insert(const MappedScan& scan)
{
  for (const auto& p : scan.points) {
    const std::size_t index = raster_.indexOf(p.x(), p.y());
    if (index == raster_.size())
      continue;
    Cell& cell = cells_[index];
    cell.lowest = cell.points == 0 ? p.z() : std::min(cell.lowest, p.z());
    cell.highest = cell.points == 0 ? p.z() : std::max(cell.highest, p.z());
    cell.sum += static_cast<double>(p.z());
    ++cell.points;
  }
}

} // namespace pcl6d
