// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/plane_segmentation/accumulator_ball.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
constexpr double kPi = 3.14159265358979323846;
} // namespace

AccumulatorBall::AccumulatorBall(int slices)
{
  require(slices >= 2 && slices <= 1000, "slices", slices, "in [2, 1000]");
  const double wanted = kPi * kPi / (slices * slices); // [sr] area of a cell
  cap_ = portableAcos(1 - wanted / (2 * kPi));
  height_ = (kPi - 2 * cap_) / slices;
  first_ = {0, 1};
  for (int i = 0; i < slices; ++i) {
    const double slice = 2 * kPi *
                         (portableSinCos(cap_ + i * height_).cos -
                          portableSinCos(cap_ + (i + 1) * height_).cos);
    const auto cells = static_cast<std::size_t>(std::lround(slice / wanted));
    first_.push_back(first_.back() + std::max<std::size_t>(1, cells));
  }
}

std::size_t
AccumulatorBall::cellOf(const Eigen::Vector3d& direction) const
{
  const double polar = portableAcos(std::clamp(direction.z(), -1.0, 1.0));
  if (polar < cap_)
    return 0;
  if (polar >= kPi - cap_)
    return first_.back();
  const std::size_t slice = std::min(
      1 + static_cast<std::size_t>((polar - cap_) / height_), first_.size() - 2);
  const double turn =
      portableAtan2(direction.y(), direction.x()) / (2 * kPi); // in [-0.5, 0.5]
  const auto cells = static_cast<double>(width(slice));
  const auto index = static_cast<std::size_t>((turn < 0 ? turn + 1 : turn) * cells);
  return first_[slice] + std::min(index, width(slice) - 1);
}

AccumulatorBall::Place
AccumulatorBall::placeOf(std::size_t cell) const
{
  const auto next = std::upper_bound(first_.begin(), first_.end(), cell);
  const auto slice = static_cast<std::size_t>(next - first_.begin()) - 1;
  return {slice, cell - first_[slice]};
}

Eigen::Vector3d
AccumulatorBall::centre(std::size_t cell) const
{
  const auto [slice, index] = placeOf(cell);
  if (slice == 0 || slice + 1 == first_.size())
    return slice == 0 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d(0, 0, -1);
  const SinCos polar =
      portableSinCos(cap_ + (static_cast<double>(slice) - 0.5) * height_);
  const SinCos turn = portableSinCos(2 * kPi * (static_cast<double>(index) + 0.5) /
                                     static_cast<double>(width(slice)));
  return {turn.cos * polar.sin, turn.sin * polar.sin, polar.cos};
}

double
AccumulatorBall::area(std::size_t cell) const
{
  const std::size_t slice = placeOf(cell).slice;
  if (slice == 0 || slice + 1 == first_.size())
    return 2 * kPi * (1 - portableSinCos(cap_).cos);
  const double upper = cap_ + static_cast<double>(slice - 1) * height_;
  return 2 * kPi * (portableSinCos(upper).cos - portableSinCos(upper + height_).cos) /
         static_cast<double>(width(slice));
}

/** Appends the cells of a slice that touch a cell's range of turns. */
void
AccumulatorBall::appendTouching(const Place& place,
                                std::size_t slice,
                                std::vector<std::size_t>& cells) const
{
  const std::size_t mine = width(place.slice), theirs = width(slice);
  if (mine == 1 || theirs <= 3) {
    for (std::size_t i = 0; i < theirs; ++i)
      cells.push_back(first_[slice] + i);
    return;
  }
  // Cell i spans [i, i + 1] / width; one turn more keeps the numbers positive.
  const std::size_t begin = (place.index + mine) * theirs;
  const std::size_t end = (place.index + 1 + mine) * theirs;
  const std::size_t first = begin % mine == 0 ? begin / mine - 1 : begin / mine;
  for (std::size_t i = first; i <= end / mine; ++i)
    cells.push_back(first_[slice] + i % theirs);
}

std::vector<std::size_t>
AccumulatorBall::neighbours(std::size_t cell) const
{
  const Place place = placeOf(cell);
  std::vector<std::size_t> cells;
  for (std::size_t slice = place.slice > 0 ? place.slice - 1 : 0;
       slice <= std::min(place.slice + 1, first_.size() - 1);
       ++slice)
    appendTouching(place, slice, cells);
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  cells.erase(std::find(cells.begin(), cells.end(), cell));
  return cells;
}

std::vector<std::size_t>
AccumulatorBall::window(std::size_t cell, int steps) const
{
  std::vector<std::size_t> reached = {cell}, rim = {cell};
  for (int step = 0; step < steps; ++step) {
    std::vector<std::size_t> next;
    for (const auto from : rim)
      for (const auto to : neighbours(from))
        next.push_back(to);
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    rim.clear();
    std::set_difference(next.begin(),
                        next.end(),
                        reached.begin(),
                        reached.end(),
                        std::back_inserter(rim));
    reached.insert(reached.end(), rim.begin(), rim.end());
    std::sort(reached.begin(), reached.end());
  }
  return reached;
}

} // namespace pcl6d
