// SPDX-License-Identifier: BSD-3-Clause
#include "plan_grid.h"

#include <array>

namespace pcl6d {
namespace {
/** Walks along the border of a part with the part on the left. */
class BorderWalk {
public:
  BorderWalk(const PlanGrid& grid, std::int32_t part) : grid_(grid), part_(part) {}

  /** \param[in] column, row of the first cell of the part: nothing of it is below */
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
  struct Node { ///< a corner of cells and the way that leads on from it
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

  // Left where the part ends ahead on both sides, right where it goes on to the right;
  // where two cells meet at a corner only, the walk stays with the one that it follows.
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

} // namespace pcl6d
