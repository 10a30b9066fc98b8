// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/filters/pcl/leaf_grid.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pcl6d {

namespace {
constexpr std::int64_t kMostCells = std::int64_t{1} << 21; ///< of an axis, see VoxelKey
constexpr float kHalfCells = static_cast<float>(1 << 20);

/** \return the cell of a coordinate, as pcl::VoxelGrid counts: in float */
float
cellOf(float x, float inverse)
{
  return std::floor(x * inverse);
}
} // namespace

void
LeafGrid::setLeafSize(float x, float y, float z)
{
  leaf_ = Eigen::Vector3f(x, y, z);
  inverse_ = Eigen::Array3f::Ones() / leaf_->array();
}

Eigen::Vector3i
LeafGrid::getGridCoordinates(float x, float y, float z) const
{
  const Eigen::Array3f cell = (Eigen::Array3f(x, y, z) * inverse_).floor();
  constexpr float kMost = 2147483520.F; // the largest float below 2^31
  return cell.min(kMost).max(-kMost).cast<int>();
}

int
LeafGrid::getCentroidIndexAt(const Eigen::Vector3i& cell) const
{
  if ((cell.array() < low_.array()).any() || (cell.array() > high_.array()).any() ||
      layout_.empty())
    return -1;
  return layout_[static_cast<std::size_t>((cell - low_).dot(getDivisionMultiplier()))];
}

std::vector<int>
LeafGrid::neighborIndices(const Eigen::Vector3i& cell,
                          const Eigen::MatrixXi& relative) const
{
  require(relative.rows() == 3, "rows of relative coordinates", relative.rows(), "3");
  std::vector<int> found;
  for (Eigen::Index i = 0; i < relative.cols(); ++i)
    found.push_back(getCentroidIndexAt(cell + relative.col(i)));
  return found;
}

Points
LeafGrid::placesOf(const Points& points)
{
  require(leaf_->allFinite() && leaf_->minCoeff() > 0,
          "leaf size",
          leaf_->transpose(),
          "finite and > 0");
  constexpr float kMost = std::numeric_limits<float>::max();
  Eigen::Array3f low = Eigen::Array3f::Constant(kMost), high = -low;
  for (const auto& p : points)
    if (p.allFinite()) {
      low = low.min(p.array());
      high = high.max(p.array());
    }
  Points places;
  layout_.clear();
  low_.setZero();
  high_.setConstant(-1);
  if (!(low[0] <= high[0]))
    return places;
  for (int axis = 0; axis < 3; ++axis) {
    const double first = cellOf(low[axis], inverse_[axis]);
    const double last = cellOf(high[axis], inverse_[axis]);
    require(std::abs(first) < 2147483000. && std::abs(last) < 2147483000. &&
                last - first < static_cast<double>(kMostCells),
            "cells along an axis",
            last - first + 1,
            "at most 2097152, and within 2^31 of the origin: take larger leaves");
    low_[axis] = static_cast<int>(first);
    high_[axis] = static_cast<int>(last);
  }
  const Eigen::Array3f first = low_.cast<float>().array();
  const Eigen::Array3f in_middle = Eigen::Array3f::Constant(0.5F - kHalfCells);
  places.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Array3f cell =
        (points[i].array() * inverse_).floor() - first + in_middle;
    places[i] = {cell[2], cell[1], cell[0]};
  }
  return places;
}

std::vector<std::size_t>
LeafGrid::keptGroups(const VoxelGroups& groups, const Points& places)
{
  std::vector<std::size_t> kept;
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (groups.indices(g).size() >= least_points_)
      kept.push_back(g);
  if (!save_layout_ || groups.size() == 0)
    return kept;
  const double cells = getNrDivisions().cast<double>().prod();
  require(cells < 2147483647., "cells of the layout", cells, "below 2^31");
  layout_.assign(static_cast<std::size_t>(cells), -1);
  const Eigen::Vector3i steps = getDivisionMultiplier();
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Eigen::Vector3f& place = places[*groups.indices(kept[k]).begin()];
    const Eigen::Array3i cell =
        (place.array() + (kHalfCells - 0.5F)).reverse().cast<int>();
    layout_[static_cast<std::size_t>(cell.matrix().dot(steps))] = static_cast<int>(k);
  }
  return kept;
}

Eigen::Vector3f
LeafGrid::centreOf(const Eigen::Vector3f& place) const
{
  const Eigen::Array3f cell = (place.array() + kHalfCells).reverse();
  return ((cell + low_.cast<float>().array()) * leaf_->array()).matrix();
}

} // namespace pcl6d
