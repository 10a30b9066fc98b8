// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/plane_segmentation/plane_cloud.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl6d::plane_segmentation {

/** \brief Surfels side by side, for loops over all of them. */
struct PCL6D_EXPORTS SurfelColumns { // shown to a test
  std::vector<float> x, y, z;        ///< [m]
  std::vector<float> nx, ny, nz;     ///< unit normals
  std::vector<float> reach;          ///< [m] that a plane may be away

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
  append(const Eigen::Vector3f& point, const Eigen::Vector3f& normal, float reach);
};

/** \brief How far a surfel may be from its plane: the larger of the two. */
struct SurfelReach {
  double sigmas = 3; ///< of the noise where it is
  double least = 0;  ///< [m]
};

/** \brief The smooth surfels of a cloud that are on no plane yet, in the order of the
 * cells of an octree, so that all those of a cell follow each other.
 *
 * A surfel is known by its slot, which changes as others are removed. Coordinates count
 * from a corner of the cloud, where float is finest. */
class RemainingSurfels {
public:
  static constexpr std::uint32_t kGone = 0xffffffff;

  /** \param[in] finest [m] edge of the cells of level 0; made larger if the cloud has
   * more than 2^21 of them along an axis */
  RemainingSurfels(const PlaneCloud& cloud, double finest, const SurfelReach& reach);

  std::size_t
  size() const
  {
    return surfels_.size();
  }

  const SurfelColumns&
  columns() const
  {
    return columns_;
  }

  /** \return the surfel of a slot, by which it is known when slots have changed */
  std::uint32_t
  surfel(std::size_t slot) const
  {
    return surfels_[slot];
  }

  /** \return the slot of a surfel, or kGone */
  std::uint32_t
  slotOf(std::uint32_t surfel) const
  {
    return slots_[surfel];
  }

  /** \return the surfels that remain, in an order of chance */
  std::vector<std::uint32_t>
  shuffled(std::uint64_t seed) const;

  /** \return those of some surfels that remain, in their order */
  SurfelColumns
  columnsOf(const std::vector<std::uint32_t>& surfels) const;

  /** \brief Slots from begin up to, but not with, end. */
  struct Range {
    std::size_t begin = 0, end = 0;
  };

  /** \return those in the same cell. \param[in] level of cells of the edge finest times
   * 2^level, in [0, 21] */
  Range
  cell(std::size_t slot, int level) const;

  /** \return a sample, evenly over the slots, each drawn by chance among its like */
  SurfelColumns
  sample(std::size_t size, std::uint64_t seed) const;

  /** \brief Calls visit(slot) for the neighbours of a surfel that remain. */
  template <typename Visit>
  void
  visitNeighbours(std::size_t slot, const Visit& visit) const
  {
    const Surfels& all = cloud_.surfels();
    const std::uint32_t surfel = surfels_[slot];
    for (std::size_t k = all.link_begin[surfel]; k < all.link_begin[surfel + 1]; ++k)
      if (slots_[all.links[k]] != kGone)
        visit(slots_[all.links[k]]);
  }

  /** \return the points of some surfels, ascending places in the cloud */
  std::vector<std::uint32_t>
  pointsOf(const std::vector<std::uint32_t>& slots) const;

  /** \brief Takes surfels out. \param[in] slots ascending */
  void
  remove(const std::vector<std::uint32_t>& slots);

private:
  void
  numberSlots();

  const PlaneCloud& cloud_;
  SurfelColumns columns_;
  std::vector<std::uint64_t> codes_;   // of the octree, ascending
  std::vector<std::uint32_t> surfels_; // of each slot
  std::vector<std::uint32_t> slots_;   // of each surfel, or kGone
};

} // namespace pcl6d::plane_segmentation
