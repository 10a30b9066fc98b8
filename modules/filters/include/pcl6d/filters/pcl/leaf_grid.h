// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/filters/leaf_cells.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The grid of pcl::VoxelGrid (LeafCells), with its setters and getters.
 * \ingroup filters */
class LeafGrid {
public:
  /** \brief Sides of a leaf [m]. */
  void
  setLeafSize(float x, float y, float z);
  void
  setLeafSize(const Eigen::Vector4f& size)
  {
    setLeafSize(size.x(), size.y(), size.z());
  }
  Eigen::Vector3f
  getLeafSize() const
  {
    return leaf_ ? *leaf_ : Eigen::Vector3f::Zero();
  }

  /** \brief Whether every field is averaged, or x, y, z alone; true unless set. */
  void
  setDownsampleAllData(bool downsample)
  {
    downsample_all_ = downsample;
  }
  bool
  getDownsampleAllData() const
  {
    return downsample_all_;
  }

  /** \brief Leaves with fewer points are left out; 0 unless set. */
  void
  setMinimumPointsNumberPerVoxel(unsigned int count)
  {
    least_points_ = count;
  }
  unsigned int
  getMinimumPointsNumberPerVoxel() const
  {
    return least_points_;
  }

  /** \brief Filters points by limits of a field (negative: points outside the limits stay). */
  void
  setFilterFieldName(const std::string& name)
  {
    field_ = name;
  }
  std::string
  getFilterFieldName() const
  {
    return field_;
  }
  void
  setFilterLimits(double least, double most)
  {
    least_ = least;
    most_ = most;
  }
  void
  getFilterLimits(double& least, double& most) const
  {
    least = least_;
    most = most_;
  }
  void
  setFilterLimitsNegative(bool negative)
  {
    negative_ = negative;
  }
  bool
  getFilterLimitsNegative() const
  {
    return negative_;
  }

  /** \brief Whether the place of each cell's point in the output is kept, for the getters
   * below; false unless set. */
  void
  setSaveLeafLayout(bool save)
  {
    save_layout_ = save;
  }
  bool
  getSaveLeafLayout() const
  {
    return save_layout_;
  }
  std::vector<int>
  getLeafLayout() const
  {
    return layout_;
  }

  /** \return of the last filter(): first and last cell, number of cells along each axis, and steps
   * of the layout along the axes */
  Eigen::Vector3i
  getMinBoxCoordinates() const
  {
    return cells_.low();
  }
  Eigen::Vector3i
  getMaxBoxCoordinates() const
  {
    return cells_.high();
  }
  Eigen::Vector3i
  getNrDivisions() const
  {
    return cells_.counts();
  }
  Eigen::Vector3i
  getDivisionMultiplier() const
  {
    const Eigen::Vector3i count = getNrDivisions();
    return {1, count.x(), count.x() * count.y()};
  }

  /** \return the cell of a place */
  Eigen::Vector3i
  getGridCoordinates(float x, float y, float z) const;

  /** \return the index in the output of a cell's point; -1: no point, or the layout was not kept */
  int
  getCentroidIndexAt(const Eigen::Vector3i& cell) const;
  template <typename PointT>
  int
  getCentroidIndex(const PointT& p) const
  {
    return getCentroidIndexAt(getGridCoordinates(p.x, p.y, p.z));
  }
  int
  getCentroidIndex(float x, float y, float z) const
  {
    return getCentroidIndexAt(getGridCoordinates(x, y, z));
  }

  /** \return getCentroidIndexAt() of the cells around a point. \param[in] relative a column each */
  template <typename PointT>
  std::vector<int>
  getNeighborCentroidIndices(const PointT& p, const Eigen::MatrixXi& relative) const
  {
    return neighborIndices(getGridCoordinates(p.x, p.y, p.z), relative);
  }
  std::vector<int>
  getNeighborCentroidIndices(float x,
                             float y,
                             float z,
                             const Eigen::MatrixXi& relative) const
  {
    return neighborIndices(getGridCoordinates(x, y, z), relative);
  }

protected:
  LeafGrid() = default;
  ~LeafGrid() = default;

  bool
  hasLeaf() const
  {
    return leaf_.has_value();
  }

  /** \return whether the field of a point is within its limits */
  bool
  isWithinLimits(double value) const
  {
    return negative_ ? !(value < most_ && value > least_)
                     : !(value > most_ || value < least_);
  }

  /** \brief Finds the cells of points; points that are not finite have no cell.
   * \throws BadArgument see LeafCells(), or more than 2^31 cells with a layout to be kept */
  void
  findCells(const CoordinateView& points);
  const LeafCells&
  cells() const
  {
    return cells_;
  }

  /** \return the groups of enough points; also keeps their indices in the output, if the
   * layout is to be kept */
  std::vector<std::size_t>
  keptGroups(const LeafGroups& groups, const CoordinateView& points);

  bool downsample_all_ = true;
  unsigned int least_points_ = 0;
  std::string field_;

private:
  std::vector<int>
  neighborIndices(const Eigen::Vector3i& cell, const Eigen::MatrixXi& relative) const;

  std::optional<Eigen::Vector3f> leaf_; ///< [m]
  LeafCells cells_;
  double least_ = std::numeric_limits<float>::lowest();
  double most_ = std::numeric_limits<float>::max();
  bool negative_ = false;
  bool save_layout_ = false;
  std::vector<int> layout_;
};

} // namespace pcl6d
