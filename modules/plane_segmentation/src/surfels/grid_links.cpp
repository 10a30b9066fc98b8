// SPDX-License-Identifier: BSD-3-Clause
#include "surfels/grid_links.h"

#include <pcl6d/common/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pcl6d::plane_segmentation {

namespace {
constexpr std::size_t kBlockSize = 1024;                      // surfels
constexpr std::size_t kCandidates = 4 * Surfels::kNeighbours; // visited, at least
constexpr std::uint32_t kNone = 0xffffffff;

/** Lists of surfels with adjacent points: the list of surfel i is others[begin[i]] ..
 * others[begin[i + 1]]. */
struct Adjacency {
  std::vector<std::uint32_t> begin;
  std::vector<std::uint32_t> others;
};

/** \return the surfel of each cell of the grid, row by row, the last row filled up */
std::vector<std::uint32_t>
surfelsOfCells(const Surfels& surfels, const PointGrid& grid)
{
  const std::vector<std::uint32_t>& places = *grid.places;
  const std::size_t rows = places.empty() ? 0 : places.back() / grid.width + 1;
  std::vector<std::uint32_t> cells(rows * grid.width, kNone);
  for (std::size_t i = 0; i < places.size(); ++i)
    cells[places[i]] = surfels.of_point[i];
  return cells;
}

/** \return pairs of surfels with adjacent points, both ways, with duplicates */
std::vector<std::pair<std::uint32_t, std::uint32_t>>
adjacentPairs(const std::vector<std::uint32_t>& cells, std::size_t width)
{
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  const auto join = [&](std::size_t cell, std::size_t other) {
    if (other >= cells.size() || cells[other] == kNone || cells[other] == cells[cell])
      return;
    pairs.emplace_back(cells[cell], cells[other]);
    pairs.emplace_back(cells[other], cells[cell]);
  };
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (cells[cell] == kNone)
      continue;
    const std::size_t column = cell % width;
    if (column + 1 < width) {
      join(cell, cell + 1);
      join(cell, cell + width + 1);
    }
    join(cell, cell + width);
    if (column > 0)
      join(cell, cell + width - 1);
  }
  return pairs;
}

Adjacency
adjacencyOf(const Surfels& surfels, const PointGrid& grid)
{
  const auto pairs = adjacentPairs(surfelsOfCells(surfels, grid), grid.width);
  Adjacency adjacency;
  adjacency.begin.assign(surfels.size() + 1, 0);
  for (const auto& pair : pairs)
    ++adjacency.begin[pair.first + 1];
  for (std::size_t i = 0; i < surfels.size(); ++i)
    adjacency.begin[i + 1] += adjacency.begin[i];
  adjacency.others.resize(pairs.size());
  auto next = adjacency.begin;
  for (const auto& [from, to] : pairs)
    adjacency.others[next[from]++] = to;
  // Sorts each list and drops duplicates.
  const auto others = adjacency.others.begin();
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    const auto begin = others + adjacency.begin[i];
    const auto end = others + next[i];
    std::sort(begin, end);
    const auto unique_end = std::unique(begin, end);
    adjacency.begin[i] = kept;
    kept += static_cast<std::uint32_t>(std::copy(begin, unique_end, others + kept) -
                                       (others + kept));
  }
  adjacency.begin[surfels.size()] = kept;
  adjacency.others.resize(kept);
  return adjacency;
}

/** Walks outwards from a surfel. */
class Walk {
public:
  Walk(const Surfels& surfels, const Adjacency& adjacency)
  : surfels_(surfels), adjacency_(adjacency), seen_by_(surfels.size(), kNone)
  {}

  /** \return the nearest surfels around a surfel, nearest first, itself included */
  const std::vector<std::pair<float, std::uint32_t>>&
  around(std::uint32_t start)
  {
    near_.clear();
    add(start, start);
    for (std::size_t next = 0; next < near_.size() && near_.size() < kCandidates;
         ++next) {
      const std::uint32_t from = near_[next].second;
      for (auto k = adjacency_.begin[from]; k < adjacency_.begin[from + 1]; ++k)
        add(start, adjacency_.others[k]);
    }
    const std::size_t kept = std::min(near_.size(), Surfels::kNeighbours);
    const auto end = near_.begin() + static_cast<std::ptrdiff_t>(kept);
    std::nth_element(near_.begin(), end - 1, near_.end());
    std::sort(near_.begin(), end);
    near_.resize(kept);
    return near_;
  }

private:
  void
  add(std::uint32_t start, std::uint32_t surfel)
  {
    if (seen_by_[surfel] == start)
      return;
    seen_by_[surfel] = start;
    near_.emplace_back((surfels_.points[surfel] - surfels_.points[start]).squaredNorm(),
                       surfel);
  }

  const Surfels& surfels_;
  const Adjacency& adjacency_;
  std::vector<std::uint32_t> seen_by_;
  std::vector<std::pair<float, std::uint32_t>> near_;
};
} // namespace

void
linkByGrid(Surfels& surfels, const PointGrid& grid, unsigned int num_threads)
{
  const Adjacency adjacency = adjacencyOf(surfels, grid);
  const std::size_t size = surfels.size();
  std::vector<std::vector<std::uint32_t>> links(size);
  surfels.radii.resize(size);
  parallelBlocks(size, kBlockSize, num_threads, [&](const Block& block) {
    Walk walk(surfels, adjacency);
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const auto& near = walk.around(static_cast<std::uint32_t>(i));
      surfels.radii[i] = std::sqrt(near.back().first);
      links[i].reserve(near.size());
      for (const auto& [distance_sq, surfel] : near)
        links[i].push_back(surfel);
    }
  });
  surfels.link_begin.assign(1, 0);
  for (const auto& own : links) {
    surfels.links.insert(surfels.links.end(), own.begin(), own.end());
    surfels.link_begin.push_back(static_cast<std::uint32_t>(surfels.links.size()));
  }
}

} // namespace pcl6d::plane_segmentation
