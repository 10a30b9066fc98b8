// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/visibility/cube_faces.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d::visibility {

namespace {
/** \return the index of a cell in a face with the given rows and columns */
std::size_t
indexOf(int row, int col, int side)
{
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(side) +
         static_cast<std::size_t>(col);
}

constexpr std::uint16_t kNone = std::numeric_limits<std::uint16_t>::max();

/** Maps equal angles to about equal lengths: within 14 % of the mean, while the
 * tangent would vary by a factor of two. */
float
evenly(float tangent)
{
  constexpr float kSlope = 1.27324F; // 4 / pi
  return tangent * (kSlope - (kSlope - 1) * std::abs(tangent));
}

int
cellAlong(float place, int side)
{
  return std::min(static_cast<int>((place + 1) / 2 * static_cast<float>(side)),
                  side - 1);
}

/** A cell by face, row and column. */
struct CellOnCube {
  std::size_t face;
  int row, col;
};

/** \return the cell itself or, beyond an edge of its face, the neighbouring face's cell: both faces
 * number the cells along their common edge alike */
CellOnCube
acrossEdge(const CellOnCube& cell, int side)
{
  // Along the axis of its old face, the cell lies at the border of the new face.
  const std::size_t axis = cell.face / 2;
  const int border = cell.face % 2 == 0 ? side - 1 : 0;
  if (cell.col < 0 || cell.col >= side)
    return {2 * ((axis + 1) % 3) + (cell.col < 0 ? 1 : 0), border, cell.row};
  if (cell.row < 0 || cell.row >= side)
    return {2 * ((axis + 2) % 3) + (cell.row < 0 ? 1 : 0), cell.col, border};
  return cell;
}

/** A face with the cells beside it all around (none at the corners), each quantity in a separate
 * array, which lets the compiler vectorise. */
class BorderedFace {
public:
  BorderedFace(const Faces& measured, std::size_t face, int side)
  : side_(side)
  , width_(static_cast<std::size_t>(side) + 2)
  , nearest_(width_ * width_, kNone)
  , farthest_(width_ * width_, 0)
  , filled_(width_ * width_, 0)
  , around_(width_ * width_, 0)
  {
    for (int row = 0; row < side; ++row)
      for (int col = 0; col < side; ++col)
        set(row, col, measured[face][indexOf(row, col, side)]);
    for (int k = 0; k < side; ++k)
      for (const auto& [row, col] : {std::pair(-1, k),
                                     std::pair(side, k),
                                     std::pair(k, -1),
                                     std::pair(k, side)}) {
        const CellOnCube at = acrossEdge({face, row, col}, side);
        if (!measured[at.face].empty())
          set(row, col, measured[at.face][indexOf(at.row, at.col, side)]);
      }
  }

  /** Merges each cell with the two cells at the given distance before and after it. */
  void
  dilate(std::size_t step)
  {
    join(nearest_, step, [](auto a, auto b) { return std::min(a, b); });
    join(farthest_, step, [](auto a, auto b) { return std::max(a, b); });
    join(around_, step, [](auto a, auto b) {
      return static_cast<std::uint16_t>(a + b);
    });
  }

  std::size_t
  width() const
  {
    return width_;
  }

  std::vector<Interval>
  cells(int filled, bool enclosed) const
  {
    std::vector<Interval> cells(static_cast<std::size_t>(side_) *
                                static_cast<std::size_t>(side_));
    auto* cell = cells.data();
    for (int row = 0; row < side_; ++row)
      for (int col = 0; col < side_; ++col, ++cell)
        if (const std::size_t i = place(row, col);
            around_[i] >= filled && (!enclosed || isEnclosed(i)))
          *cell = {nearest_[i], farthest_[i]};
    return cells;
  }

private:
  std::size_t
  place(int row, int col) const
  {
    return static_cast<std::size_t>(row + 1) * width_ +
           static_cast<std::size_t>(col + 1);
  }

  /** \return whether there are measurements on each of the four sides of a cell. Otherwise six
   * filled neighbours would claim free space beyond the last line, without any ray */
  bool
  isEnclosed(std::size_t i) const
  {
    const auto row = [&](std::size_t k) {
      return filled_[k - 1] + filled_[k] + filled_[k + 1] > 0;
    };
    const auto column = [&](std::size_t k) {
      return filled_[k - width_] + filled_[k] + filled_[k + width_] > 0;
    };
    return row(i - width_) && row(i + width_) && column(i - 1) && column(i + 1);
  }

  void
  set(int row, int col, const Interval& interval)
  {
    if (interval.isEmpty())
      return;
    const std::size_t i = place(row, col);
    nearest_[i] = interval.nearest;
    farthest_[i] = interval.farthest;
    filled_[i] = around_[i] = 1;
  }

  template <typename Join>
  static void
  join(std::vector<std::uint16_t>& cells, std::size_t step, Join of)
  {
    const std::vector<std::uint16_t> before = cells;
    const std::uint16_t* from = before.data();
    std::uint16_t* to = cells.data();
    for (std::size_t i = step; i + step < cells.size(); ++i)
      to[i] = of(of(from[i - step], from[i]), from[i + step]);
  }

  int side_;
  std::size_t width_;
  std::vector<std::uint16_t> nearest_, farthest_, filled_, around_;
};
} // namespace

OnCube
onCube(const Eigen::Vector3f& ray)
{
  Eigen::Index axis = 0;
  const float length = ray.cwiseAbs().maxCoeff(&axis);
  const auto face = static_cast<std::size_t>(2 * axis + (ray[axis] < 0 ? 1 : 0));
  return {
      face, evenly(ray[(axis + 1) % 3] / length), evenly(ray[(axis + 2) % 3] / length)};
}

std::size_t
cellOf(const OnCube& place, int side)
{
  return indexOf(cellAlong(place.v, side), cellAlong(place.u, side), side);
}

std::vector<Interval>
haloOf(const Faces& measured, std::size_t face, int side, int filled, bool enclosed)
{
  if (measured[face].empty())
    return {};
  BorderedFace bordered(measured, face, side);
  bordered.dilate(1); // wraps around at the borders only, and border cells are not used
  bordered.dilate(bordered.width());
  return bordered.cells(filled, enclosed);
}

} // namespace pcl6d::visibility
