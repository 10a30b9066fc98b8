// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/hough_votes.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/portable_math.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::plane_segmentation {

namespace {
/** The surfels that face into each cell of the ball. */
class SurfelsByDirection {
public:
  SurfelsByDirection(const SurfelColumns& surfels, const AccumulatorBall& ball)
  : first_(ball.size() + 1, 0), slots_(surfels.size())
  {
    std::vector<std::size_t> cells;
    for (std::size_t i = 0; i < surfels.size(); ++i) {
      cells.push_back(ball.cellOf(surfels.normal(i).cast<double>()));
      ++first_[cells.back() + 1];
    }
    for (std::size_t cell = 0; cell < ball.size(); ++cell)
      first_[cell + 1] += first_[cell];
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < surfels.size(); ++i)
      slots_[next[cells[i]]++] = i;
  }

  template <typename Visit>
  void
  visit(std::size_t cell, const Visit& visit) const
  {
    for (std::size_t i = first_[cell]; i < first_[cell + 1]; ++i)
      visit(slots_[i]);
  }

private:
  std::vector<std::size_t> first_; // slot of each cell
  std::vector<std::size_t> slots_;
};

std::int64_t
keyOf(std::size_t direction, std::int32_t offset)
{
  return static_cast<std::int64_t>(offset) * (std::int64_t{1} << 32) +
         static_cast<std::int64_t>(direction);
}

/** How far the surfels are from the origin, in cells, rounded up. */
std::int32_t
reach(const SurfelColumns& surfels, double cell)
{
  float farthest = 0;
  for (std::size_t i = 0; i < surfels.size(); ++i)
    farthest = std::max(farthest, surfels.point(i).squaredNorm());
  return static_cast<std::int32_t>(std::sqrt(static_cast<double>(farthest)) / cell) + 2;
}
} // namespace

std::vector<HoughCell>
voteForAll(const SurfelColumns& surfels,
           const AccumulatorBall& ball,
           const HoughVoteOptions& options)
{
  const SurfelsByDirection by_direction(surfels, ball);
  std::vector<Eigen::Vector3f> centres;
  for (std::size_t cell = 0; cell < ball.size(); ++cell)
    centres.push_back(ball.centre(cell).cast<float>());
  const auto cosine = static_cast<float>(portableSinCos(options.max_angle).cos);
  const auto per_metre = static_cast<float>(1 / options.offset_cell);
  const std::int32_t middle = reach(surfels, options.offset_cell);
  std::vector<std::vector<HoughCell>> rows(ball.size());
  parallelFor(ball.size(), options.num_threads, [&](std::size_t direction) {
    const Eigen::Vector3f normal = centres[direction];
    std::vector<std::uint32_t> votes(static_cast<std::size_t>(2 * middle), 0);
    for (std::size_t facing = 0; facing < ball.size(); ++facing)
      if (centres[facing].dot(normal) >= cosine)
        by_direction.visit(facing, [&](std::size_t slot) {
          const float offset = std::floor(normal.dot(surfels.point(slot)) * per_metre);
          ++votes[static_cast<std::size_t>(static_cast<std::int32_t>(offset) + middle)];
        });
    for (std::int32_t offset = -middle; offset < middle; ++offset) {
      const std::uint32_t count = votes[static_cast<std::size_t>(offset + middle)];
      if (count >= options.min_votes)
        rows[direction].push_back({direction, offset, count});
    }
  });
  std::vector<HoughCell> cells;
  for (const auto& row : rows)
    cells.insert(cells.end(), row.begin(), row.end());
  std::stable_sort(
      cells.begin(), cells.end(), [](const HoughCell& a, const HoughCell& b) {
        return a.votes > b.votes;
      });
  return cells;
}

const HoughCell*
HoughPeaks::next()
{
  for (; next_ < cells_.size(); ++next_) {
    const HoughCell& cell = cells_[next_];
    if (covered_.count(keyOf(cell.direction, cell.offset)))
      continue;
    for (const auto direction : ball_.window(cell.direction, steps_))
      for (std::int32_t step = -steps_; step <= steps_; ++step)
        covered_.insert(keyOf(direction, cell.offset + step));
    return &cell;
  }
  return nullptr;
}

} // namespace pcl6d::plane_segmentation
