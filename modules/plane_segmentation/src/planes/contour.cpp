// SPDX-License-Identifier: BSD-3-Clause
#include "planes/contour.h"

#include <pcl6d/common/polygon.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace pcl6d::plane_segmentation {

namespace {
constexpr std::uint32_t kNone = 0xffffffff;

/** The crossings of a level with the edges between adjacent cells, linked into rings.
 * The edge from cell i to the right has the number 2 i, the edge upwards 2 i + 1. */
class Crossings {
public:
  Crossings(const Raster<float>& field, float level)
  : field_(field), level_(level), next_(2 * field.cells.size(), kNone)
  {
    for (std::size_t y = 0; y + 1 < field.height; ++y)
      for (std::size_t x = 0; x + 1 < field.width; ++x)
        addSquare(x, y);
  }

  std::vector<Ring>
  rings()
  {
    std::vector<Ring> found;
    for (std::uint32_t first = 0; first < next_.size(); ++first) {
      Ring ring;
      for (std::uint32_t edge = first; next_[edge] != kNone;) {
        ring.push_back(placeOf(edge));
        edge = std::exchange(next_[edge], kNone);
      }
      if (ring.size() >= 3)
        found.push_back(std::move(ring));
    }
    return found;
  }

private:
  /** Joins the crossings of a square of four cells, walking about the square to the
   * left: a line starts where the walk leaves the inside, and ends where it last came
   * in. */
  void
  addSquare(std::size_t x, std::size_t y)
  {
    const auto cell = static_cast<std::uint32_t>(y * field_.width + x);
    const auto above = static_cast<std::uint32_t>(cell + field_.width);
    const std::array<std::uint32_t, 4> edges{
        2 * cell, 2 * (cell + 1) + 1, 2 * above, 2 * cell + 1};
    const std::array<bool, 4> inside{
        isInside(cell), isInside(cell + 1), isInside(above + 1), isInside(above)};
    for (std::size_t side = 0; side < 4; ++side) {
      if (!inside[side] || inside[(side + 1) % 4])
        continue;
      std::size_t entry = side;
      while (inside[entry])
        entry = (entry + 3) % 4;
      next_[edges[side]] = edges[entry];
    }
  }

  bool
  isInside(std::uint32_t cell) const
  {
    return field_.cells[cell] >= level_;
  }

  Eigen::Vector2d
  placeOf(std::uint32_t edge) const
  {
    const std::size_t cell = edge / 2;
    const std::size_t other = edge % 2 == 0 ? cell + 1 : cell + field_.width;
    const float share =
        (level_ - field_.cells[cell]) / (field_.cells[other] - field_.cells[cell]);
    Eigen::Vector2d place(static_cast<double>(cell % field_.width),
                          static_cast<double>(cell / field_.width));
    place[edge % 2] += static_cast<double>(share);
    return place;
  }

  const Raster<float>& field_;
  const float level_;
  std::vector<std::uint32_t> next_;
};

/** Keeps the corners between two corners that are far from their connecting line. */
void
keepBetween(const Ring& ring,
            std::size_t first,
            std::size_t last,
            double tolerance,
            std::vector<char>& kept)
{
  const Eigen::Vector2d a = ring[first];
  const Eigen::Vector2d along = (ring[last % ring.size()] - a).normalized();
  double farthest = tolerance;
  std::size_t corner = first;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double distance = std::abs(cross(along, ring[i] - a));
    if (distance > farthest) {
      farthest = distance;
      corner = i;
    }
  }
  if (corner == first)
    return;
  kept[corner] = 1;
  keepBetween(ring, first, corner, tolerance, kept);
  keepBetween(ring, corner, last, tolerance, kept);
}
} // namespace

std::vector<Ring>
contours(const Raster<float>& field, float level)
{
  return Crossings(field, level).rings();
}

Ring
simplified(const Ring& ring, double tolerance)
{
  std::size_t opposite = 0;
  for (std::size_t i = 1; i < ring.size(); ++i)
    if ((ring[i] - ring[0]).squaredNorm() > (ring[opposite] - ring[0]).squaredNorm())
      opposite = i;
  std::vector<char> kept(ring.size(), 0);
  kept[0] = kept[opposite] = 1;
  keepBetween(ring, 0, opposite, tolerance, kept);
  keepBetween(ring, opposite, ring.size(), tolerance, kept);
  Ring result;
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (kept[i])
      result.push_back(ring[i]);
  return result;
}

std::vector<Ring>
nested(std::vector<Ring> rings)
{
  std::stable_sort(rings.begin(), rings.end(), [](const Ring& a, const Ring& b) {
    return signedArea(a) > signedArea(b);
  });
  const auto lakes = std::find_if(
      rings.begin(), rings.end(), [](const Ring& r) { return signedArea(r) < 0; });
  std::vector<char> placed(rings.size(), 0);
  std::vector<Ring> result;
  for (auto island = rings.begin(); island != lakes; ++island) {
    result.push_back(*island);
    for (auto lake = lakes; lake != rings.end(); ++lake) {
      char& done = placed[static_cast<std::size_t>(lake - rings.begin())];
      if (!done && isInside(*island, lake->front())) {
        result.push_back(*lake);
        done = 1;
      }
    }
  }
  return result;
}

} // namespace pcl6d::plane_segmentation
