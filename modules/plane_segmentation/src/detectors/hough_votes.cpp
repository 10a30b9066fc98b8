// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/hough_votes.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::plane_segmentation {

namespace {
/** The surfels with normals in each cell of the ball. */
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

/** Votes per direction, one direction after another. */
class DirectionVotes {
public:
  DirectionVotes(const SurfelColumns& surfels,
                 const AccumulatorBall& ball,
                 const FacingDirections& facing,
                 double offset_cell)
  : surfels_(surfels)
  , by_direction_(surfels, ball)
  , facing_(facing)
  , per_metre_(static_cast<float>(1 / offset_cell))
  , middle_(reachOf(surfels, offset_cell))
  {}

  /** Calls visit(offset, votes) for the cells with votes, by rising offset. */
  template <typename Visit>
  void
  visit(std::size_t direction, const Visit& visit) const
  {
    const Eigen::Vector3f normal = facing_.centre(direction);
    std::vector<std::uint32_t> votes; // allocated with the first vote
    for (const std::uint32_t facing : facing_.of(direction))
      by_direction_.visit(facing, [&](std::size_t slot) {
        if (votes.empty())
          votes.assign(static_cast<std::size_t>(2 * middle_), 0);
        const float offset = std::floor(normal.dot(surfels_.point(slot)) * per_metre_);
        ++votes[static_cast<std::size_t>(static_cast<std::int32_t>(offset) + middle_)];
      });
    for (std::size_t i = 0; i < votes.size(); ++i)
      if (votes[i] > 0)
        visit(static_cast<std::int32_t>(i) - middle_, votes[i]);
  }

private:
  const SurfelColumns& surfels_;
  SurfelsByDirection by_direction_;
  const FacingDirections& facing_;
  float per_metre_;
  std::int32_t middle_;
};

/** \return the cells of every direction by falling count */
std::vector<HoughCell>
byCount(const std::vector<std::vector<HoughCell>>& rows)
{
  std::vector<HoughCell> cells;
  for (const auto& row : rows)
    cells.insert(cells.end(), row.begin(), row.end());
  std::stable_sort(
      cells.begin(), cells.end(), [](const HoughCell& a, const HoughCell& b) {
        return a.votes > b.votes;
      });
  return cells;
}
} // namespace

FacingDirections::FacingDirections(const AccumulatorBall& ball,
                                   double max_angle,
                                   unsigned int num_threads)
: facing_(ball.size())
{
  for (std::size_t cell = 0; cell < ball.size(); ++cell)
    centres_.push_back(ball.centre(cell).cast<float>());
  const auto cosine = static_cast<float>(portableSinCos(max_angle).cos);
  parallelFor(ball.size(), num_threads, [&](std::size_t direction) {
    for (std::uint32_t facing = 0; facing < centres_.size(); ++facing)
      if (centres_[facing].dot(centres_[direction]) >= cosine)
        facing_[direction].push_back(facing);
  });
}

std::int32_t
reachOf(const SurfelColumns& surfels, double cell)
{
  float farthest = 0;
  for (std::size_t i = 0; i < surfels.size(); ++i)
    farthest = std::max(farthest, surfels.point(i).squaredNorm());
  // Largest number of cells on either side of the origin that float can tell apart.
  constexpr double kMost = 1 << 22;
  const double reach = std::sqrt(static_cast<double>(farthest));
  require(reach <= kMost * cell,
          "offset_cell",
          cell,
          "larger where points lie " + std::to_string(reach) +
              " m from the origin: at least this / 2^22");
  return static_cast<std::int32_t>(reach / cell) + 2;
}

std::vector<HoughCell>
voteForAll(const SurfelColumns& surfels,
           const AccumulatorBall& ball,
           const HoughVoteOptions& options)
{
  const FacingDirections facing(ball, options.max_angle, options.num_threads);
  const DirectionVotes votes(surfels, ball, facing, options.offset_cell);
  std::vector<std::vector<HoughCell>> rows(ball.size());
  parallelFor(ball.size(), options.num_threads, [&](std::size_t direction) {
    votes.visit(direction, [&](std::int32_t offset, std::uint32_t count) {
      if (count >= options.min_votes)
        rows[direction].push_back({direction, offset, count});
    });
  });
  return byCount(rows);
}

HoughVotes::HoughVotes(const AccumulatorBall& ball, const HoughVoteOptions& options)
: ball_(ball)
, options_(options)
, facing_(ball, options.max_angle, options.num_threads)
, rows_(ball.size())
{}

void
HoughVotes::count(const SurfelColumns& surfels, int sign)
{
  const DirectionVotes votes(surfels, ball_, facing_, options_.offset_cell);
  parallelFor(ball_.size(), options_.num_threads, [&](std::size_t direction) {
    std::vector<Count> sum;
    auto next = rows_[direction].cbegin();
    const auto end = rows_[direction].cend();
    votes.visit(direction, [&](std::int32_t offset, std::uint32_t count) {
      while (next != end && next->offset < offset)
        sum.push_back(*next++);
      const std::uint32_t before =
          next != end && next->offset == offset ? (next++)->votes : 0;
      const std::uint32_t after = sign > 0 ? before + count : before - count;
      if (after > 0)
        sum.push_back({offset, after});
    });
    sum.insert(sum.end(), next, end);
    rows_[direction] = std::move(sum);
  });
}

std::vector<HoughCell>
HoughVotes::cells(std::uint32_t min_votes) const
{
  std::vector<std::vector<HoughCell>> rows(rows_.size());
  for (std::size_t direction = 0; direction < rows_.size(); ++direction)
    for (const Count& cell : rows_[direction])
      if (cell.votes >= min_votes)
        rows[direction].push_back({direction, cell.offset, cell.votes});
  return byCount(rows);
}

std::uint64_t
HoughVotes::votesFor(std::size_t direction) const
{
  std::uint64_t votes = 0;
  for (const Count& cell : rows_[direction])
    votes += cell.votes;
  return votes;
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
