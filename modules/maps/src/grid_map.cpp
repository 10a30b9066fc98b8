// SPDX-License-Identifier: BSD-3-Clause
// Format: map_server of ROS (wiki.ros.org/map_server), PGM of Netpbm.
#include <pcl6d/common/require.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/text.h>
#include <pcl6d/maps/grid_map.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <string>
#include <unordered_set>

namespace pcl6d {

namespace {
constexpr std::uint64_t kHeightSteps = std::uint64_t{1} << 20U; ///< range of a key

/** \return the shade of a cell in the convention of ROS map_saver */
char
shadeOf(CellState state)
{
  return static_cast<char>(state == CellState::kFree       ? 254
                           : state == CellState::kOccupied ? 0
                                                           : 205);
}

/** \brief Walks over the cells below a ray, from begin to end (Amanatides and Woo, "A fast voxel
 * traversal algorithm for ray tracing", 1987).
 * \param[in] visit called with column, row and the shares of the ray at entry and exit */
template <typename Visit>
void
walkRay(const Eigen::Vector2d& begin, const Eigen::Vector2d& end, Visit&& visit)
{
  std::ptrdiff_t cell[2], step[2], left = 0;
  double next[2], width[2]; // shares of the ray: to the next border, of a cell
  for (int k = 0; k < 2; ++k) {
    const double way = end[k] - begin[k];
    cell[k] = static_cast<std::ptrdiff_t>(std::floor(begin[k]));
    step[k] = way < 0 ? -1 : 1;
    left += std::abs(static_cast<std::ptrdiff_t>(std::floor(end[k])) - cell[k]);
    const double border = static_cast<double>(cell[k] + (way < 0 ? 0 : 1));
    next[k] =
        way == 0 ? std::numeric_limits<double>::infinity() : (border - begin[k]) / way;
    width[k] = way == 0 ? 0 : std::abs(1 / way);
  }
  double from = 0;
  for (; left >= 0; --left) {
    const int k = next[0] < next[1] ? 0 : 1;
    const double to = left == 0 ? 1 : std::min(next[k], 1.0);
    if (to > from)
      visit(cell[0], cell[1], from, to);
    from = std::max(from, to);
    cell[k] += step[k];
    next[k] += width[k];
  }
}
} // namespace

void
GridMapOptions::validate() const
{
  require(std::isfinite(from), "from", from, "finite");
  require(std::isfinite(to) && to > from,
          "to",
          to,
          "finite and > from = " + text::shortest(from));
  require(max_range > 0, "max_range", max_range, "> 0");
}

GridMap::GridMap(const MapRaster& raster,
                 const FloorHeights& floor,
                 const GridMapOptions& options)
: raster_(raster)
, options_(options)
, lowest_(floor.lowest() + options.from)
, highest_(floor.highest() + options.to)
{
  options.validate();
  floors_.reserve(raster.size());
  for (std::size_t i = 0; i < raster.size(); ++i) {
    const Eigen::Vector2d centre = raster.centreOf(i);
    floors_.push_back(static_cast<float>(floor.at(centre.x(), centre.y())));
  }
  states_.assign(raster.size(), CellState::kUnknown);
}

void
GridMap::castRay(const Eigen::Vector3d& begin, const Eigen::Vector3d& end)
{
  // Only the part at heights that can count in any cell.
  const Eigen::Vector3d way = end - begin;
  double first = 0, last = 1;
  if (way.z() != 0) {
    const double low = (lowest_ - begin.z()) / way.z();
    const double high = (highest_ - begin.z()) / way.z();
    first = std::max(first, std::min(low, high));
    last = std::min(last, std::max(low, high));
  }
  else if (begin.z() < lowest_ || begin.z() > highest_)
    return;
  if (first >= last)
    return;
  const Eigen::Vector3d a = begin + first * way, b = begin + last * way;
  const auto inCells = [&](const Eigen::Vector3d& p) -> Eigen::Vector2d {
    return (p.head<2>() - raster_.corner) / raster_.resolution;
  };
  walkRay(inCells(a),
          inCells(b),
          [&](std::ptrdiff_t column, std::ptrdiff_t row, double from, double to) {
            if (column < 0 || row < 0 ||
                column >= static_cast<std::ptrdiff_t>(raster_.columns) ||
                row >= static_cast<std::ptrdiff_t>(raster_.rows))
              return;
            const auto index = static_cast<std::size_t>(row) * raster_.columns +
                               static_cast<std::size_t>(column);
            const double z_in = a.z() + from * (b.z() - a.z()) - floors_[index];
            const double z_out = a.z() + to * (b.z() - a.z()) - floors_[index];
            if (states_[index] == CellState::kUnknown &&
                std::max(z_in, z_out) >= options_.from &&
                std::min(z_in, z_out) <= options_.to)
              states_[index] = CellState::kFree;
          });
}

void
GridMap::insert(const MappedScan& scan)
{
  const Eigen::Vector3d origin = scan.origin.cast<double>();
  std::unordered_set<std::uint64_t> ends; // a single ray for all points of a cube
  for (const auto& p : scan.points) {
    const Eigen::Vector3d point = p.cast<double>();
    const double range = (point - origin).norm();
    const bool is_hit = range <= options_.max_range;
    const std::size_t index = raster_.indexOf(point.x(), point.y());
    if (index == raster_.size())
      continue;
    const double height = point.z() - floors_[index];
    if (is_hit && height >= options_.from && height <= options_.to)
      states_[index] = CellState::kOccupied;
    const auto level = static_cast<std::uint64_t>(
        std::clamp((point.z() - lowest_) / raster_.resolution + kHeightSteps / 2.0,
                   0.0,
                   kHeightSteps - 1.0));
    if (!scan.has_rays || !ends.insert(index * kHeightSteps + level).second)
      continue;
    castRay(origin,
            is_hit ? point : origin + (point - origin) * (options_.max_range / range));
  }
}

std::size_t
GridMap::count(CellState state) const
{
  return static_cast<std::size_t>(std::count(states_.begin(), states_.end(), state));
}

std::filesystem::path
GridMap::imageOf(const std::filesystem::path& path)
{
  return std::filesystem::path(path).replace_extension(".pgm");
}

void
GridMap::write(const std::filesystem::path& path) const
{
  require(path.extension() == ".yaml", "path", path.string(), "a file .yaml");
  const std::filesystem::path image = imageOf(path);
  writeFileAtomically(image, [&](std::ostream& stream) {
    stream << "P5\n" << raster_.columns << ' ' << raster_.rows << "\n255\n";
    std::string line(raster_.columns, '\0');
    for (std::size_t row = raster_.rows; row-- > 0;) {
      for (std::size_t column = 0; column < raster_.columns; ++column)
        line[column] = shadeOf(states_[row * raster_.columns + column]);
      stream << line;
    }
  });
  std::string name = "\"";
  for (const char c : image.filename().string())
    name += (c == '"' || c == '\\') ? std::string{'\\', c} : std::string{c};
  writeFileAtomically(path, [&](std::ostream& stream) {
    stream << "image: " << name
           << "\"\nmode: trinary\nresolution: " << text::shortest(raster_.resolution)
           << "\norigin: [" << text::shortest(raster_.corner.x()) << ", "
           << text::shortest(raster_.corner.y())
           << ", 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  });
}

} // namespace pcl6d
