// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/number_range.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/localisation/segment_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace pcl6d {

namespace {
void
requireFinite(const Segments& segments)
{
  for (std::size_t i = 0; i < segments.size(); ++i)
    if (!isPlace(segments[i].a) || !isPlace(segments[i].b))
      throw BadArgument("segment " + std::to_string(i) +
                        " of the map has a coordinate that is infinite, NaN, or 1e9 m "
                        "or farther from the origin");
}

/** \return the segments of non-zero length, each once, in order; direction does not matter */
Segments
withoutRepetitions(const Segments& segments)
{
  std::set<std::array<double, 4>> known;
  Segments once;
  for (const Segment& s : segments) {
    std::array<double, 2> a{s.a.x(), s.a.y()}, b{s.b.x(), s.b.y()};
    if (b < a)
      std::swap(a, b);
    if (a != b && known.insert({a[0], a[1], b[0], b[1]}).second)
      once.push_back(s);
  }
  return once;
}

Eigen::Vector2d
offsetOf(const Segments& segments)
{
  Eigen::Isometry3d first = Eigen::Isometry3d::Identity();
  first.translation() << segments.front().a, 0;
  return worldOffset(first).head<2>();
}
} // namespace

void
SegmentMapOptions::validate() const
{
  const auto isLength = [](double value) { return std::isfinite(value) && value > 0; };
  require(isLength(max_distance), "max_distance", max_distance, "finite and > 0");
  require(isLength(cell), "cell", cell, "finite and > 0");
  require(max_cells > 0, "max_cells", max_cells, "> 0");
}

SegmentMap::SegmentMap(const Segments& segments, const SegmentMapOptions& options)
: max_distance_(options.max_distance)
{
  options.validate();
  requireFinite(segments);
  segments_ = withoutRepetitions(segments);
  if (segments_.empty())
    throw BadArgument("the map has no line segment");
  offset_ = offsetOf(segments_);
  low_ = high_ = segments_.front().a - offset_;
  for (auto& s : segments_) {
    s.a -= offset_;
    s.b -= offset_;
    low_ = low_.cwiseMin(s.a).cwiseMin(s.b);
    high_ = high_.cwiseMax(s.a).cwiseMax(s.b);
  }
  chooseCell(options);
  fillGrid();
}

void
SegmentMap::chooseCell(const SegmentMapOptions& options)
{
  grid_low_ = low_.array() - max_distance_;
  const Eigen::Vector2d size = (high_ - low_).array() + 2 * max_distance_;
  const auto cellsAlong = [&](double length) { return std::floor(length / cell_) + 1; };
  cell_ = options.cell;
  while (cellsAlong(size.x()) * cellsAlong(size.y()) >
         static_cast<double>(options.max_cells))
    cell_ *= 2;
  columns_ = static_cast<std::size_t>(cellsAlong(size.x()));
  rows_ = static_cast<std::size_t>(cellsAlong(size.y()));
}

Eigen::Vector2d
SegmentMap::centreOf(std::size_t column, std::size_t row) const
{
  return grid_low_ + cell_ * Eigen::Vector2d(static_cast<double>(column) + 0.5,
                                             static_cast<double>(row) + 0.5);
}

/** Calls visit(cell, distance of its centre) for every cell with its centre within reach
 * of the segment. */
template <typename Visit>
void
SegmentMap::forCellsNear(const Segment& s, double reach, Visit visit) const
{
  const auto place = [&](double offset, std::size_t count) {
    const double cell = std::floor(offset / cell_);
    return static_cast<std::size_t>(
        std::clamp(cell, 0.0, static_cast<double>(count - 1)));
  };
  const Eigen::Vector2d from = s.a.cwiseMin(s.b) - grid_low_;
  const Eigen::Vector2d to = s.a.cwiseMax(s.b) - grid_low_;
  const std::size_t last_row = place(to.y() + reach, rows_);
  const std::size_t last_column = place(to.x() + reach, columns_);
  for (std::size_t row = place(from.y() - reach, rows_); row <= last_row; ++row)
    for (std::size_t c = place(from.x() - reach, columns_); c <= last_column; ++c) {
      const double distance = std::sqrt(squaredDistance(centreOf(c, row), s));
      if (distance <= reach)
        visit(row * columns_ + c, distance);
    }
}

void
SegmentMap::fillGrid()
{
  constexpr double kRounding = 1 + 1e-9; // keeps candidates at the edge of the bound
  const double diagonal = cell_ * M_SQRT2;
  const double reach = max_distance_ + diagonal / 2;
  std::vector<double> nearest(columns_ * rows_, reach);
  for (const auto& s : segments_)
    forCellsNear(s, reach, [&](std::size_t cell, double distance) {
      nearest[cell] = std::min(nearest[cell], distance);
    });
  const auto isCandidate = [&](std::size_t cell, double distance) {
    return distance <= (nearest[cell] + diagonal) * kRounding;
  };
  first_.assign(columns_ * rows_ + 1, 0);
  for (const auto& s : segments_)
    forCellsNear(s, reach, [&](std::size_t cell, double distance) {
      first_[cell + 1] += isCandidate(cell, distance) ? 1 : 0;
    });
  for (std::size_t cell = 0; cell < columns_ * rows_; ++cell)
    first_[cell + 1] += first_[cell];
  candidates_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < segments_.size(); ++i)
    forCellsNear(segments_[i], reach, [&](std::size_t cell, double distance) {
      if (isCandidate(cell, distance))
        candidates_[next[cell]++] = static_cast<std::uint32_t>(i);
    });
}

double
SegmentMap::distance(const Eigen::Vector2d& place) const
{
  const Eigen::Vector2d cell = (place - grid_low_) / cell_;
  if (!(cell.x() >= 0 && cell.x() < static_cast<double>(columns_) && cell.y() >= 0 &&
        cell.y() < static_cast<double>(rows_)))
    return max_distance_;
  const std::size_t index = static_cast<std::size_t>(cell.y()) * columns_ +
                            static_cast<std::size_t>(cell.x());
  double nearest_sq = max_distance_ * max_distance_;
  for (std::uint32_t i = first_[index]; i < first_[index + 1]; ++i)
    nearest_sq =
        std::min(nearest_sq, squaredDistance(place, segments_[candidates_[i]]));
  return std::sqrt(nearest_sq);
}

} // namespace pcl6d
