// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/filters/pcl/leaf_grid.h>

namespace pcl6d {

void
LeafGrid::setLeafSize(float x, float y, float z)
{
  leaf_ = Eigen::Vector3f(x, y, z);
}

Eigen::Vector3i
LeafGrid::getGridCoordinates(float x, float y, float z) const
{
  return LeafCells::cellOf({x, y, z}, getLeafSize());
}

int
LeafGrid::getCentroidIndexAt(const Eigen::Vector3i& cell) const
{
  if ((cell.array() < cells_.low().array()).any() ||
      (cell.array() > cells_.high().array()).any() || layout_.empty())
    return -1;
  return layout_[static_cast<std::size_t>(
      (cell - cells_.low()).dot(getDivisionMultiplier()))];
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

void
LeafGrid::findCells(const CoordinateView& points)
{
  layout_.clear();
  cells_ = {};
  const LeafCells cells(points, getLeafSize());
  const double count = cells.counts().cast<double>().prod();
  if (save_layout_)
    require(count < 2147483647., "cells of the layout", count, "below 2^31");
  cells_ = cells;
}

std::vector<std::size_t>
LeafGrid::keptGroups(const LeafGroups& groups, const CoordinateView& points)
{
  std::vector<std::size_t> kept;
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (groups.indices(g).size() >= least_points_)
      kept.push_back(g);
  if (!save_layout_ || groups.size() == 0)
    return kept;
  layout_.assign(static_cast<std::size_t>(cells_.counts().cast<std::int64_t>().prod()),
                 -1);
  const Eigen::Vector3i steps = getDivisionMultiplier();
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const auto first = static_cast<std::size_t>(*groups.indices(kept[k]).begin());
    const Eigen::Vector3i cell = cells_.cellOf(pointOf(points, first)) - cells_.low();
    layout_[static_cast<std::size_t>(cell.dot(steps))] = static_cast<int>(k);
  }
  return kept;
}

} // namespace pcl6d
