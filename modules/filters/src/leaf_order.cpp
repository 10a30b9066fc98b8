// SPDX-License-Identifier: BSD-3-Clause
// Numbers cells by counting bits: with a bit per cell, the number of an occupied cell is the
// count of set bits before.
#include <pcl6d/common/simd_clones.h>
#include <pcl6d/filters/leaf_cells.h>

#include <algorithm>
#include <utility>

namespace pcl6d {

namespace {
using Numbers = std::vector<std::uint32_t>;
using PointLane = float __attribute__((vector_size(16)));
using CellLane = std::int32_t __attribute__((vector_size(16)));

/** 64 cells: bits of the occupied cells, and their number in the words before. */
struct Word {
  std::uint64_t bits;
  std::uint64_t before;
};

/** Parameters of the numbering of cells. */
struct Numbering {
  PointLane inverse; ///< 1 / side
  CellLane low;      ///< the first cell
  std::uint32_t row, layer, none;
};

/** \return floor of each coordinate over the side of a cell; any number for NaN */
PCL6D_INLINE CellLane
cellLane(const PointLane& p, const PointLane& inverse)
{
  constexpr float kMost = 2147483520.F; // the largest float below 2^31
  const PointLane most = PointLane{} + kMost;
  PointLane x = p * inverse;
  x = x > -most ? x : -most; // NaN too
  x = x < most ? x : most;
  const CellLane towards_zero = __builtin_convertvector(x, CellLane);
  return towards_zero +
         (__builtin_convertvector(towards_zero, PointLane) > x); // true: -1
}

/** Numbers each point by its cell, x first; points that are not finite get the last number. */
PCL6D_SIMD_CLONES void
numberPoints(const CoordinateView& points, const Numbering& by, std::uint32_t* numbers)
{
  for (std::size_t i = 0; i < points.size; ++i) {
    const float* at = points.first + points.stride * i;
    const PointLane p{at[0], at[1], at[2], 0};
    const CellLane cell = cellLane(p, by.inverse) - by.low;
    const auto number = static_cast<std::uint32_t>(cell[0]) +
                        by.row * static_cast<std::uint32_t>(cell[1]) +
                        by.layer * static_cast<std::uint32_t>(cell[2]);
    const float poison = (p[0] - p[0]) + (p[1] - p[1]) + (p[2] - p[2]);
    numbers[i] = poison == 0 ? number : by.none;
  }
}

PCL6D_INLINE std::uint32_t
rankOf(const Word* words, std::uint32_t cell)
{
  const Word& word = words[cell / 64];
  const std::uint64_t below = (std::uint64_t{1} << cell % 64) - 1;
  return static_cast<std::uint32_t>(
      word.before +
      static_cast<std::uint64_t>(__builtin_popcountll(word.bits & below)));
}

/** Renumbers without the numbers that no point has, in order. \param[in] shift number of lowest
 * bits that stay: whole blocks of numbers are left out
 * \param[in,out] none the number of no cell, above every other */
PCL6D_SIMD_CLONES void
closeGaps(std::uint32_t* numbers, std::size_t size, std::uint32_t& none, int shift)
{
  const std::uint32_t low_bits = (std::uint32_t{1} << shift) - 1;
  std::vector<Word> all((none >> shift) / 64 + 1);
  Word* const words = all.data();
  for (std::size_t i = 0; i < size; ++i)
    words[(numbers[i] >> shift) / 64].bits |= std::uint64_t{1}
                                              << ((numbers[i] >> shift) % 64);
  std::uint64_t sum = 0;
  for (auto& word : all) {
    word.before = sum;
    sum += static_cast<std::uint64_t>(__builtin_popcountll(word.bits));
  }
  for (std::size_t i = 0; i < size; ++i)
    numbers[i] = rankOf(words, numbers[i] >> shift) << shift | (numbers[i] & low_bits);
  none = rankOf(words, none >> shift) << shift | (none & low_bits);
}

/** For grids of more cells than numbers have. \return the number of occupied cells */
std::size_t
rankBySorting(const CoordinateView& points, const LeafCells& cells, Numbers& ranks)
{
  using Member = std::pair<std::uint64_t, std::uint64_t>; // z and y; x and the index
  std::vector<Member> members;
  for (std::size_t i = 0; i < points.size; ++i) {
    const Eigen::Vector3f p = pointOf(points, i);
    if (!p.allFinite())
      continue;
    const auto cell = (cells.cellOf(p) - cells.low()).cast<std::uint64_t>().eval();
    members.emplace_back(cell.z() << 32 | cell.y(), cell.x() << 32 | i);
  }
  std::sort(members.begin(), members.end());
  std::size_t rank = 0;
  ranks.resize(points.size);
  for (std::size_t m = 0; m < members.size(); ++m) {
    const Member& last = members[m > 0 ? m - 1 : 0];
    rank +=
        members[m].first != last.first || members[m].second >> 32 != last.second >> 32;
    ranks[members[m].second & 0xffffffff] = static_cast<std::uint32_t>(rank);
  }
  const std::size_t num_cells = members.empty() ? 0 : rank + 1;
  for (std::size_t i = 0; i < points.size; ++i)
    if (!pointOf(points, i).allFinite())
      ranks[i] = static_cast<std::uint32_t>(num_cells);
  return num_cells;
}
} // namespace

LeafOrder::LeafOrder(const CoordinateView& points, const LeafCells& cells)
{
  constexpr double kMostNumbers = 4294967000.; // 2^32, minus a reserve
  const Eigen::Vector3i counts = cells.counts();
  const double total = counts.cast<double>().prod();
  if (total > kMostNumbers) {
    size_ = rankBySorting(points, cells, ranks_);
    return;
  }
  const Eigen::Array3f inverse = Eigen::Array3f::Ones() / cells.leaf().array();
  const Eigen::Vector3i& low = cells.low();
  const auto row = static_cast<std::uint32_t>(counts.x());
  const auto layer = row * static_cast<std::uint32_t>(counts.y());
  auto none = static_cast<std::uint32_t>(total);
  ranks_.resize(points.size);
  const Numbering by{PointLane{inverse[0], inverse[1], inverse[2], 0},
                     CellLane{low[0], low[1], low[2], 0},
                     row,
                     layer,
                     none};
  numberPoints(points, by, ranks_.data());
  constexpr std::size_t kSparse = 2; // words per point: counting them takes about the
                                     // time of the points
  if (none / 64 > kSparse * points.size)
    closeGaps(ranks_.data(), points.size, none, 6);
  closeGaps(ranks_.data(), points.size, none, 0);
  size_ = none;
}

namespace {
/** Sums of x, y, z and the number of the points. */
struct alignas(32) LeafSum {
  using Lane = double __attribute__((vector_size(32)));
  Lane values;
};

PCL6D_SIMD_CLONES void
addPoints(const CoordinateView& points, const std::uint32_t* ranks, LeafSum* sums)
{
  constexpr std::size_t kAhead = 16; // points ahead whose sums are prefetched
  for (std::size_t i = 0; i < points.size; ++i) {
    __builtin_prefetch(&sums[ranks[std::min(i + kAhead, points.size - 1)]], 1);
    const float* p = points.first + points.stride * i;
    sums[ranks[i]].values +=
        __builtin_convertvector((PointLane{p[0], p[1], p[2], 1}), LeafSum::Lane);
  }
}
PCL6D_SIMD_CLONES void
divideSums(const LeafSum* sums, std::size_t size, float* means, std::size_t stride)
{
  for (std::size_t c = 0; c < size; ++c) {
    const LeafSum::Lane& sum = sums[c].values;
    const LeafSum::Lane mean = sum / (LeafSum::Lane{} + sum[3]);
    for (std::size_t axis = 0; axis < 3; ++axis)
      means[stride * c + axis] = static_cast<float>(mean[axis]);
  }
}
} // namespace

void
LeafOrder::writeMeans(const CoordinateView& points,
                      float* means,
                      std::size_t stride) const
{
  std::vector<LeafSum> sums(size_ + 1); // the last sum is of points in no cell
  addPoints(points, ranks_.data(), sums.data());
  divideSums(sums.data(), size_, means, stride);
}

} // namespace pcl6d
