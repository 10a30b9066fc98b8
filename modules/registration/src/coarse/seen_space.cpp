// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/registration/seen_space.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d {

namespace {
constexpr double kRangeMargin = 0.05; // of the range: a slanted surface within a cell

/** The place of a direction on the faces of the cube, -1 to 1 along u and v. */
struct OnCube {
  int face;
  float u, v;
};

OnCube
projected(const Eigen::Vector3f& p)
{
  Eigen::Index axis = 0;
  const float length = p.cwiseAbs().maxCoeff(&axis);
  const int face = 2 * static_cast<int>(axis) + (p[axis] < 0 ? 1 : 0);
  return {face, p[(axis + 1) % 3] / length, p[(axis + 2) % 3] / length};
}
} // namespace

SeenSpace::SeenSpace(const Points& measured)
{
  // Several points a cell, if they were spread over all directions.
  const double wanted = std::sqrt(static_cast<double>(measured.size()) / 24);
  side_ = static_cast<int>(std::min(std::max(wanted, 8.0), 48.0));
  const std::size_t cells = static_cast<std::size_t>(6 * side_ * side_);
  constexpr float kUnseen = std::numeric_limits<float>::infinity();
  std::vector<float> nearest(cells, kUnseen);
  for (const auto& p : measured)
    if (!p.isZero(0)) {
      float& range = nearest[static_cast<std::size_t>(cellOf(p))];
      range = std::min(range, p.norm());
    }
  range_.assign(cells, 0);
  for (int cell = 0; cell < static_cast<int>(cells); ++cell) {
    if (nearest[cell] == kUnseen)
      continue;
    const int face = cell / (side_ * side_);
    const int row = cell / side_ % side_, column = cell % side_;
    float smallest = nearest[cell];
    for (int r = std::max(row - 1, 0); r <= std::min(row + 1, side_ - 1); ++r)
      for (int c = std::max(column - 1, 0); c <= std::min(column + 1, side_ - 1); ++c)
        smallest = std::min(smallest, nearest[(face * side_ + r) * side_ + c]);
    range_[cell] = smallest;
  }
}

int
SeenSpace::cellOf(const Eigen::Vector3f& p) const
{
  const OnCube place = projected(p);
  const auto cell = [this](float x) {
    return std::min(static_cast<int>((x + 1) / 2 * static_cast<float>(side_)),
                    side_ - 1);
  };
  return (place.face * side_ + cell(place.u)) * side_ + cell(place.v);
}

bool
SeenSpace::sawThrough(const Eigen::Vector3f& p, double margin) const
{
  const double range = p.norm();
  if (side_ == 0 || !(range > 0))
    return false;
  return range + margin + kRangeMargin * range < range_[cellOf(p)];
}

} // namespace pcl6d
