// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/simulation/ground_map.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d {
namespace {
constexpr double kHalfDiagonal = 0.70710678118654757; // of a cell of length 1

// Turns squared distances across a line of cells into squared distances within the
// plane: the lower envelope of parabolas (P. F. Felzenszwalb, D. P. Huttenlocher,
// "Distance transforms of sampled functions", Theory of Computing 8, 2012). Cells
// beyond both ends are not free.
void
spreadAlong(std::vector<double>& line)
{
  const auto count = static_cast<std::ptrdiff_t>(line.size());
  const auto valueAt = [&](std::ptrdiff_t i) {
    return i < 0 || i >= count ? 0.0 : line[static_cast<std::size_t>(i)];
  };
  std::vector<std::ptrdiff_t> tips;
  std::vector<double> begins;
  for (std::ptrdiff_t i = -1; i <= count; ++i) {
    const auto x = static_cast<double>(i);
    double begin = -std::numeric_limits<double>::infinity();
    while (!tips.empty()) {
      const auto tip = static_cast<double>(tips.back());
      begin = (valueAt(i) + x * x - valueAt(tips.back()) - tip * tip) / (2 * (x - tip));
      if (begin > begins.back())
        break;
      tips.pop_back();
      begins.pop_back();
    }
    if (tips.empty())
      begin = -std::numeric_limits<double>::infinity();
    tips.push_back(i);
    begins.push_back(begin);
  }
  std::vector<double> spread(line.size());
  std::size_t k = 0;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    while (k + 1 < tips.size() && begins[k + 1] <= static_cast<double>(i))
      ++k;
    const auto off = static_cast<double>(i - tips[k]);
    spread[static_cast<std::size_t>(i)] = off * off + valueAt(tips[k]);
  }
  line = std::move(spread);
}

// From the middle of each cell to the middle of the next occupied cell, in cells.
std::vector<float>
gapsOf(const GroundMap::Raster& raster)
{
  // Farther than any cell, with an exact square.
  const double far = 4.0 * static_cast<double>(raster.columns + raster.rows);
  std::vector<float> squares(raster.floors.size());
  std::vector<double> line(raster.columns);
  for (std::size_t row = 0; row < raster.rows; ++row) {
    for (std::size_t i = 0; i < raster.columns; ++i)
      line[i] = std::isnan(raster.floors[row * raster.columns + i]) ? 0 : far * far;
    spreadAlong(line);
    for (std::size_t i = 0; i < raster.columns; ++i)
      squares[row * raster.columns + i] = static_cast<float>(line[i]);
  }
  line.resize(raster.rows);
  for (std::size_t column = 0; column < raster.columns; ++column) {
    for (std::size_t i = 0; i < raster.rows; ++i)
      line[i] = squares[i * raster.columns + column];
    spreadAlong(line);
    for (std::size_t i = 0; i < raster.rows; ++i)
      squares[i * raster.columns + column] = static_cast<float>(std::sqrt(line[i]));
  }
  return squares;
}
} // namespace

GroundMap::GroundMap(Raster raster) : raster_(std::move(raster))
{
  require(raster_.cell > 0 && std::isfinite(raster_.cell),
          "cell of the ground",
          raster_.cell,
          "> 0");
  require(raster_.low.allFinite(), "corner", raster_.low.transpose(), "finite");
  require(raster_.floors.size() == raster_.columns * raster_.rows,
          "number of floors",
          raster_.floors.size(),
          "that of the cells");
  gaps_ = gapsOf(raster_);
  for (auto& gap : gaps_)
    gap *= static_cast<float>(raster_.cell);
}

std::optional<std::size_t>
GroundMap::cellAt(const Eigen::Vector2d& place) const
{
  const Eigen::Vector2d at = (place - raster_.low) / raster_.cell;
  if (!(at.x() >= 0 && at.y() >= 0 && at.x() < static_cast<double>(raster_.columns) &&
        at.y() < static_cast<double>(raster_.rows)))
    return std::nullopt;
  return static_cast<std::size_t>(at.y()) * raster_.columns +
         static_cast<std::size_t>(at.x());
}

Eigen::Vector2d
GroundMap::middle(std::size_t cell) const
{
  return raster_.low +
         raster_.cell *
             Eigen::Vector2d(static_cast<double>(cell % raster_.columns) + 0.5,
                             static_cast<double>(cell / raster_.columns) + 0.5);
}

std::optional<double>
GroundMap::floor(const Eigen::Vector2d& place) const
{
  const auto cell = cellAt(place);
  if (!cell || std::isnan(raster_.floors[*cell]))
    return std::nullopt;
  // Interpolates the four cells with middles around the position; unknown floors have
  // no weight.
  const Eigen::Array2d at = (place - raster_.low).array() / raster_.cell - 0.5;
  const Eigen::Array2d first = at.floor();
  double sum = 0;
  double weights = 0;
  for (const double dx : {0.0, 1.0})
    for (const double dy : {0.0, 1.0}) {
      const Eigen::Array2d near = first + Eigen::Array2d(dx, dy);
      if (near.minCoeff() < 0 || near.x() >= static_cast<double>(raster_.columns) ||
          near.y() >= static_cast<double>(raster_.rows))
        continue;
      const double height =
          raster_.floors[static_cast<std::size_t>(near.y()) * raster_.columns +
                         static_cast<std::size_t>(near.x())];
      const double weight = (1 - (at - near).abs()).prod();
      if (std::isnan(height))
        continue;
      sum += weight * height;
      weights += weight;
    }
  return weights > 0 ? sum / weights : raster_.floors[*cell];
}

// Room about the middle of a cell.
double
GroundMap::roomOf(std::size_t cell) const
{
  return std::max(0.0, gaps_[cell] - kHalfDiagonal * raster_.cell);
}

double
GroundMap::room(const Eigen::Vector2d& place) const
{
  const auto cell = cellAt(place);
  return cell ? std::max(0.0, roomOf(*cell) - (place - middle(*cell)).norm()) : 0;
}

bool
GroundMap::isFree(const Eigen::Vector2d& from,
                  const Eigen::Vector2d& to,
                  double radius) const
{
  const double length = (to - from).norm();
  const int steps = std::max(1, static_cast<int>(std::ceil(2 * length / raster_.cell)));
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Vector2d place = from + (to - from) * i / steps;
    const auto cell = cellAt(place);
    if (!cell || std::isnan(raster_.floors[*cell]) ||
        (radius > 0 && room(place) < radius))
      return false;
  }
  return true;
}

} // namespace pcl6d
