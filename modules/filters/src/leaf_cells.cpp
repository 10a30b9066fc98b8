// SPDX-License-Identifier: BSD-3-Clause
#include "random_members.h"

#include <pcl6d/common/random.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/leaf_cells.h>

#include <pcl/types.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace pcl6d {

namespace {
constexpr double kFarthestLeaf = 1073741000; ///< from 0: differences stay below 2^31

using FourFloats = float __attribute__((vector_size(16)));

struct LeafCorners {
  FourFloats low = FourFloats{} + std::numeric_limits<float>::max();
  FourFloats high = -low;

  void
  add(const FourFloats& p)
  {
    low = p < low ? p : low;
    high = p > high ? p : high;
  }
};

FourFloats
pointAt(const CoordinateView& points, std::size_t i)
{
  const float* p = points.first + points.stride * i;
  return FourFloats{p[0], p[1], p[2], 0};
}

/** \return zero for each finite coordinate, NaN otherwise */
FourFloats
poisonOf(const FourFloats& p)
{
  return p - p;
}

bool
isClean(const FourFloats& poison)
{
  return poison[0] == 0 && poison[1] == 0 && poison[2] == 0;
}

/** \return the corners of the box of the finite points. Blocks of points are processed assuming
 * finite points, and again one by one where a point is not finite. */
LeafCorners
cornersOfFinite(const CoordinateView& points)
{
  constexpr std::size_t kBlock = 64;
  LeafCorners all;
  for (std::size_t begin = 0; begin < points.size; begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, points.size);
    LeafCorners of_block = all;
    FourFloats poison{};
    for (std::size_t i = begin; i < end; ++i) {
      const FourFloats p = pointAt(points, i);
      poison += poisonOf(p);
      of_block.add(p);
    }
    if (isClean(poison))
      all = of_block;
    else
      for (std::size_t i = begin; i < end; ++i)
        if (isClean(poisonOf(pointAt(points, i))))
          all.add(pointAt(points, i));
  }
  return all;
}
} // namespace

LeafCells::LeafCells(const CoordinateView& points, const Eigen::Vector3f& leaf)
: leaf_(leaf)
{
  require(leaf.allFinite() && leaf.minCoeff() > 0,
          "leaf size",
          leaf.transpose(),
          "finite and > 0");
  const LeafCorners corners = cornersOfFinite(points);
  if (!(corners.low[0] <= corners.high[0]))
    return;
  for (int axis = 0; axis < 3; ++axis) {
    const float inverse = 1 / leaf[axis];
    const double first = std::floor(corners.low[axis] * inverse);
    const double last = std::floor(corners.high[axis] * inverse);
    require(std::abs(first) < kFarthestLeaf && std::abs(last) < kFarthestLeaf,
            "cells from the origin",
            std::max(std::abs(first), std::abs(last)),
            "below 2^30: take larger leaves");
    low_[axis] = static_cast<int>(first);
    high_[axis] = static_cast<int>(last);
  }
}

Eigen::Vector3i
LeafCells::cellOf(const Eigen::Vector3f& place, const Eigen::Vector3f& leaf)
{
  const Eigen::Array3f inverse = Eigen::Array3f::Ones() / leaf.array();
  const Eigen::Array3f cell = (place.array() * inverse).floor();
  constexpr float kMost = 2147483520.F; // the largest float below 2^31
  return cell.min(kMost).max(-kMost).cast<int>();
}

Eigen::Vector3f
meanOf(const CoordinateView& points, const IndexRange& indices)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto i : indices)
    sum += pointOf(points, static_cast<std::size_t>(i)).cast<double>();
  return (sum / static_cast<double>(indices.size())).cast<float>();
}

std::vector<bool>
nearestToCentres(const CoordinateView& points,
                 const LeafCells& cells,
                 const LeafOrder& order)
{
  struct Nearest {
    double distance_sq = std::numeric_limits<double>::infinity();
    std::size_t point = 0;
  };
  std::vector<Nearest> nearest(order.size());
  const Eigen::Array3f inverse = Eigen::Array3f::Ones() / cells.leaf().array();
  const Eigen::Array3d leaf = cells.leaf().cast<double>().array();
  for (std::size_t i = 0; i < points.size; ++i) {
    const std::uint32_t rank = order.ranks()[i];
    if (rank >= order.size())
      continue;
    const Eigen::Vector3f p = pointOf(points, i);
    const Eigen::Array3d cell = (p.array() * inverse).floor().cast<double>();
    const double distance_sq =
        (p.cast<double>().array() - (cell + 0.5) * leaf).matrix().squaredNorm();
    if (distance_sq < nearest[rank].distance_sq)
      nearest[rank] = {distance_sq, i};
  }
  std::vector<bool> is_nearest(points.size);
  for (const auto& n : nearest)
    is_nearest[n.point] = true;
  return is_nearest;
}

LeafGroups::LeafGroups(const LeafOrder& order)
: begin_(order.size() + 2) // one more, while counting
{
  const std::vector<std::uint32_t>& ranks = order.ranks();
  for (const auto rank : ranks)
    if (rank < order.size())
      ++begin_[rank + 2];
  for (std::size_t g = 2; g < begin_.size(); ++g)
    begin_[g] += begin_[g - 1];
  indices_.resize(static_cast<std::size_t>(begin_.back()));
  for (std::size_t i = 0; i < ranks.size(); ++i)
    if (ranks[i] < order.size())
      indices_[static_cast<std::size_t>(begin_[ranks[i] + 1]++)] =
          static_cast<pcl::index_t>(i);
  begin_.pop_back();
}

pcl::Indices
LeafGroups::chooseRandom(const std::vector<std::size_t>& groups,
                         const CoordinateView& points,
                         const LeafCells& cells,
                         int count,
                         std::uint64_t seed) const
{
  pcl::Indices chosen;
  for (const std::size_t g : groups) {
    const auto first = static_cast<std::size_t>(*indices(g).begin());
    const Eigen::Vector3i cell = cells.cellOf(pointOf(points, first));
    std::uint64_t bits = mixBits(seed);
    for (int axis = 0; axis < 3; ++axis)
      bits = mixBits(bits ^ static_cast<std::uint32_t>(cell[axis]));
    filters::appendRandom(indices(g), static_cast<std::size_t>(count), bits, chosen);
  }
  return chosen;
}

} // namespace pcl6d
