// SPDX-License-Identifier: BSD-3-Clause
#include "rooms/plan_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl6d::semantic_map {

namespace {
/** Walks along the border of a part with the part on the left. */
class BorderWalk {
public:
  BorderWalk(const PlanGrid& grid, std::int32_t part) : grid_(grid), part_(part) {}

  /** \param[in] column, row of the first cell of the part: no cell of the part is
   * below */
  std::vector<Eigen::Vector2d>
  walk(std::int64_t column, std::int64_t row)
  {
    std::vector<Eigen::Vector2d> corners{grid_.corner(column, row)};
    const Node start{column, row, 0};
    Node node{column + 1, row, 0}; // first along the lower side of the first cell
    while (node.column != start.column || node.row != start.row) {
      const int before = node.direction;
      turn(node);
      if (node.direction != before)
        corners.push_back(grid_.corner(node.column, node.row));
      node.column += kSteps[static_cast<std::size_t>(node.direction)][0];
      node.row += kSteps[static_cast<std::size_t>(node.direction)][1];
    }
    return corners;
  }

private:
  struct Node { ///< a corner of cells and the direction of the next step
    std::int64_t column;
    std::int64_t row;
    int direction; ///< east, north, west, south
  };
  static constexpr std::array<std::array<int, 2>, 4> kSteps{
      {{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

  bool
  isPart(std::int64_t column, std::int64_t row) const
  {
    const auto columns = static_cast<std::int64_t>(grid_.columns());
    if (column < 0 || row < 0 || column >= columns)
      return false;
    const auto cell = static_cast<std::size_t>(row * columns + column);
    return cell < grid_.numCells() && grid_.label(cell) == part_;
  }

  // Turns left where the cell ahead on the left is not in the part, right where the
  // part continues on the right. Where two cells touch only at a corner, the walk stays
  // with the cell on its left.
  void
  turn(Node& node) const
  {
    static constexpr std::array<std::array<int, 2>, 4> kAheadLeft{
        {{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};
    static constexpr std::array<std::array<int, 2>, 4> kAheadRight{
        {{0, -1}, {0, 0}, {-1, 0}, {-1, -1}}};
    const auto d = static_cast<std::size_t>(node.direction);
    const bool left =
        isPart(node.column + kAheadLeft[d][0], node.row + kAheadLeft[d][1]);
    const bool right =
        isPart(node.column + kAheadRight[d][0], node.row + kAheadRight[d][1]);
    if (!left)
      node.direction = (node.direction + 1) % 4;
    else if (right)
      node.direction = (node.direction + 3) % 4;
  }

  const PlanGrid& grid_;
  std::int32_t part_;
};
} // namespace

std::vector<Eigen::Vector2d>
PlanGrid::outline(std::int32_t part) const
{
  for (std::size_t cell = 0; cell < labels_.size(); ++cell)
    if (labels_[cell] == part)
      return BorderWalk(*this, part)
          .walk(static_cast<std::int64_t>(cell % columns_),
                static_cast<std::int64_t>(cell / columns_));
  return {};
}

namespace {
constexpr double kMostCells = 1 << 24;

/** Calls body(i, share) for each i in [0, count) with low + i between a and b; share is
 * the position, 0 at a, 1 at b. */
template <typename Body>
void
forEachCrossing(double a, double b, std::size_t count, Body body)
{
  const double low = std::min(a, b), high = std::max(a, b);
  if (!(low < high))
    return;
  const double first = std::max(0.0, std::ceil(low));
  const double end = std::min(static_cast<double>(count), std::ceil(high));
  for (double i = first; i < end; ++i)
    body(static_cast<std::size_t>(i), (i - a) / (b - a));
}
} // namespace

PlanGrid::PlanGrid(const Eigen::AlignedBox2d& bounds, double cell) : cell_(cell)
{
  const Eigen::Vector2d size = bounds.sizes();
  while ((size.x() / cell_ + 2) * (size.y() / cell_ + 2) > kMostCells)
    cell_ *= 2;
  columns_ = static_cast<std::size_t>(size.x() / cell_) + 2;
  rows_ = static_cast<std::size_t>(size.y() / cell_) + 2;
  const Eigen::Vector2d whole(static_cast<double>(columns_),
                              static_cast<double>(rows_));
  origin_ = bounds.center() - cell_ / 2 * whole;
  labels_.assign(columns_ * rows_, kOutside);
  wall_right_.assign(labels_.size(), false);
  wall_above_.assign(labels_.size(), false);
}

Eigen::Vector2d
PlanGrid::corner(std::int64_t column, std::int64_t row) const
{
  return origin_ +
         cell_ * Eigen::Vector2d(static_cast<double>(column), static_cast<double>(row));
}

Eigen::Vector2d
PlanGrid::centre(std::size_t cell) const
{
  return corner(static_cast<std::int64_t>(cell % columns_),
                static_cast<std::int64_t>(cell / columns_)) +
         Eigen::Vector2d::Constant(cell_ / 2);
}

std::int32_t
PlanGrid::labelAt(const Eigen::Vector2d& point) const
{
  const Eigen::Vector2d place = (point - origin_) / cell_;
  if (!(place.x() >= 0 && place.y() >= 0 && place.x() < static_cast<double>(columns_) &&
        place.y() < static_cast<double>(rows_)))
    return kOutside;
  return labels_[static_cast<std::size_t>(place.y()) * columns_ +
                 static_cast<std::size_t>(place.x())];
}

void
PlanGrid::addLine(const PlanLine& line)
{
  constexpr double kBeyond = 1e-6; // [cells] overlap of ends that touch
  const Eigen::Vector2d half(0.5, 0.5);
  Eigen::Vector2d a = (line.from - origin_) / cell_ - half; // centres are whole numbers
  Eigen::Vector2d b = (line.to - origin_) / cell_ - half;
  if (a == b)
    return;
  const Eigen::Vector2d along = (b - a).normalized();
  a -= kBeyond * along;
  b += kBeyond * along;
  forEachCrossing(a.y(), b.y(), rows_, [&](std::size_t row, double share) {
    const double column = std::floor(a.x() + share * (b.x() - a.x()));
    if (column >= 0 && column < static_cast<double>(columns_))
      wall_right_[row * columns_ + static_cast<std::size_t>(column)] = true;
  });
  forEachCrossing(a.x(), b.x(), columns_, [&](std::size_t column, double share) {
    const double row = std::floor(a.y() + share * (b.y() - a.y()));
    if (row >= 0 && row < static_cast<double>(rows_))
      wall_above_[static_cast<std::size_t>(row) * columns_ + column] = true;
  });
}

void
PlanGrid::fill(std::size_t start, std::int32_t part)
{
  std::vector<std::size_t> open{start};
  labels_[start] = part;
  const auto visit = [&](std::size_t cell) {
    if (labels_[cell] != kNoRoom)
      return;
    labels_[cell] = part;
    open.push_back(cell);
  };
  while (!open.empty()) {
    const std::size_t cell = open.back();
    open.pop_back();
    const std::size_t column = cell % columns_;
    if (column + 1 < columns_ && !wall_right_[cell])
      visit(cell + 1);
    if (column > 0 && !wall_right_[cell - 1])
      visit(cell - 1);
    if (cell + columns_ < labels_.size() && !wall_above_[cell])
      visit(cell + columns_);
    if (cell >= columns_ && !wall_above_[cell - columns_])
      visit(cell - columns_);
  }
}

std::int32_t
PlanGrid::findParts(const std::function<bool(const Eigen::Vector2d&)>& inside)
{
  for (std::size_t cell = 0; cell < labels_.size(); ++cell)
    labels_[cell] = inside(centre(cell)) ? kNoRoom : kOutside;
  std::int32_t num_parts = 0;
  for (std::size_t cell = 0; cell < labels_.size(); ++cell)
    if (labels_[cell] == kNoRoom)
      fill(cell, num_parts++);
  return num_parts;
}

std::vector<std::size_t>
PlanGrid::largestSquares(std::int32_t num_parts) const
{
  std::vector<std::size_t> largest(static_cast<std::size_t>(num_parts), 0);
  std::vector<std::size_t> below(columns_, 0), row(columns_, 0); // ending at each cell
  for (std::size_t cell = 0; cell < labels_.size(); ++cell) {
    const std::size_t column = cell % columns_;
    if (column == 0)
      std::swap(below, row);
    row[column] = 0;
    if (labels_[cell] < 0)
      continue;
    row[column] = 1;
    if (column > 0 && cell >= columns_ && labels_[cell - 1] == labels_[cell] &&
        labels_[cell - columns_] == labels_[cell] &&
        labels_[cell - columns_ - 1] == labels_[cell])
      row[column] = 1 + std::min({row[column - 1], below[column], below[column - 1]});
    auto& best = largest[static_cast<std::size_t>(labels_[cell])];
    best = std::max(best, row[column]);
  }
  return largest;
}

} // namespace pcl6d::semantic_map
