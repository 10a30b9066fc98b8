// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/filters/voxel_reduction.h>

#include <pcl/types.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief View of coordinates in memory: x, y, z [m] of point i begin at the float
 * first[stride * i]. */
struct CoordinateView {
  const float* first = nullptr;
  std::size_t stride = 3; ///< floats; >= 3
  std::size_t size = 0;   ///< points
};

/** \return a view of points, valid during their lifetime */
inline CoordinateView
viewOf(const Points& points)
{
  return {points.empty() ? nullptr : points.front().data(), 3, points.size()};
}

/** \return the point at a place of the view */
inline Eigen::Vector3f
pointOf(const CoordinateView& points, std::size_t i)
{
  return Eigen::Map<const Eigen::Vector3f>(points.first + points.stride * i);
}

/** \return the mean [m] of the chosen points, at least one; summed in double */
Eigen::Vector3f
meanOf(const CoordinateView& points, const IndexRange& indices);

/** \brief The cells of pcl::VoxelGrid around a cloud: boxes of any three sides. The cell of a
 * coordinate is floor(x * (1 / side)) in float, exactly like in PCL. Unlike in PCL, the product of
 * the numbers of cells along the axes is not limited.
 * \ingroup filters */
class LeafCells {
public:
  /** No cells. */
  LeafCells() = default;

  /** \param[in] points points that are not finite lie in no cell
   * \param[in] leaf sides of a cell [m]
   * \throws BadArgument a side is not finite and > 0, or a point is 2^30 cells or
   * more from the origin along an axis */
  LeafCells(const CoordinateView& points, const Eigen::Vector3f& leaf);

  /** \return the first and the last cell of the points; 0 and -1 without points */
  const Eigen::Vector3i&
  low() const
  {
    return low_;
  }
  const Eigen::Vector3i&
  high() const
  {
    return high_;
  }

  /** \return the cell of a place anywhere; at most 2^31 from the origin */
  Eigen::Vector3i
  cellOf(const Eigen::Vector3f& place) const
  {
    return cellOf(place, leaf_);
  }
  static Eigen::Vector3i
  cellOf(const Eigen::Vector3f& place, const Eigen::Vector3f& leaf);

  /** \return the centre of a cell [m] */
  Eigen::Vector3d
  centreOf(const Eigen::Vector3i& cell) const
  {
    return (cell.cast<double>().array() + 0.5) * leaf_.cast<double>().array();
  }

  const Eigen::Vector3f&
  leaf() const
  {
    return leaf_;
  }

  /** \return the number of cells from the first to the last along each axis */
  Eigen::Vector3i
  counts() const
  {
    return high_ - low_ + Eigen::Vector3i::Ones();
  }

private:
  Eigen::Vector3f leaf_ = Eigen::Vector3f::Zero();
  Eigen::Vector3i low_ = Eigen::Vector3i::Zero(), high_ = -Eigen::Vector3i::Ones();
};

/** \brief Points ordered by cell. Occupied cells are numbered in PCL's order: x runs fastest, z
 * slowest. Time is linear in the number of points: no sorting, but a bit per cell, and not even a
 * bit for most empty cells. */
class LeafOrder {
public:
  /** \param[in] points the points of the cells */
  LeafOrder(const CoordinateView& points, const LeafCells& cells);

  /** \return the number of occupied cells */
  std::size_t
  size() const
  {
    return size_;
  }

  /** \return the number of the occupied cell of each point; size() for a point without a cell */
  const std::vector<std::uint32_t>&
  ranks() const
  {
    return ranks_;
  }

  /** \brief Writes the mean of the points of each cell, summed in double.
   * \param[in] points the points given to the constructor
   * \param[out] means x, y, z of cell c, from means[stride * c] on */
  void
  writeMeans(const CoordinateView& points, float* means, std::size_t stride) const;

private:
  std::vector<std::uint32_t> ranks_;
  std::size_t size_ = 0;
};

/** \return for each point, whether no other point of its cell is nearer to the centre; of equally
 * near points, the first. Distances are in double
 * \param[in] points, cells given to the order */
std::vector<bool>
nearestToCentres(const CoordinateView& points,
                 const LeafCells& cells,
                 const LeafOrder& order);

/** \brief The points of each cell, ascending. */
class LeafGroups {
public:
  explicit LeafGroups(const LeafOrder& order);

  std::size_t
  size() const
  {
    return begin_.size() - 1;
  }

  /** \return indices of points; valid during the lifetime of this object */
  IndexRange
  indices(std::size_t group) const
  {
    return {indices_.data() + begin_[group], indices_.data() + begin_[group + 1]};
  }

  /** \brief Chooses at most count points of each group. The choice depends only on the seed, the
   * cell and the order of its points. \param[in] points, cells given to the order \return indices
   * of points, group by group, ascending inside a group */
  pcl::Indices
  chooseRandom(const std::vector<std::size_t>& groups,
               const CoordinateView& points,
               const LeafCells& cells,
               int count,
               std::uint64_t seed) const;

private:
  pcl::Indices indices_;
  std::vector<pcl::index_t> begin_;
};

} // namespace pcl6d
