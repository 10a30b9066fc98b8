// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/plane_segmentation/plane_cloud.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl6d {

/** \brief Coordinates and normals side by side, for loops over all points. */
struct PointColumns {
  std::vector<float> x, y, z;    ///< [m]
  std::vector<float> nx, ny, nz; ///< unit normals

  std::size_t
  size() const
  {
    return x.size();
  }
  Eigen::Vector3f
  point(std::size_t i) const
  {
    return {x[i], y[i], z[i]};
  }
  Eigen::Vector3f
  normal(std::size_t i) const
  {
    return {nx[i], ny[i], nz[i]};
  }
  void
  append(const Eigen::Vector3f& point, const Eigen::Vector3f& normal);
};

/** \brief The points of a cloud that are on no plane yet and have a normal, in the order
 * of the cells of an octree, so that all points of a cell follow each other.
 *
 * A point is known by its slot, which changes as points are removed. Coordinates count
 * from a corner of the cloud, where float is finest. */
class RemainingPoints {
public:
  /** \param[in] finest [m] edge of the cells of level 0; made larger if the cloud has
   * more than 2^21 of them along an axis */
  RemainingPoints(const PlaneCloud& cloud, double finest);

  std::size_t
  size() const
  {
    return places_.size();
  }

  const PointColumns&
  columns() const
  {
    return columns_;
  }

  /** \return the places in the cloud of some slots, ascending */
  std::vector<std::uint32_t>
  places(const std::vector<std::uint32_t>& slots) const;

  /** \brief Slots from begin up to, but not with, end. */
  struct Range {
    std::size_t begin = 0, end = 0;
  };

  /** \return the points in the same cell. \param[in] level of cells of the edge finest
   * times 2^level, in [0, 21] */
  Range
  cell(std::size_t slot, int level) const;

  /** \brief A sample of all points, evenly over the slots, each drawn by chance among its
   * like. \param[in] seed of the choice */
  PointColumns
  sample(std::size_t size, std::uint64_t seed) const;

  /** \brief Takes points out. \param[in] slots ascending */
  void
  remove(const std::vector<std::uint32_t>& slots);

private:
  PointColumns columns_;
  std::vector<std::uint64_t> codes_; // of the octree, ascending
  std::vector<std::uint32_t> places_;
};

} // namespace pcl6d
