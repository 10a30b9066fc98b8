// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/plane_segmentation/plane_cloud.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl6d::plane_segmentation {

/** \brief Surfels in columns, for loops over many surfels. */
struct PCL6D_EXPORTS SurfelColumns { // shown to a test
  std::vector<float> x, y, z;        ///< [m]
  std::vector<float> nx, ny, nz;     ///< unit normals
  std::vector<float> reach;          ///< [m] largest distance of a plane

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

/** \brief Largest distance of a surfel to its plane: the larger of the two values. */
struct SurfelReach {
  double sigmas = 3; ///< of the noise at the surfel
  double least = 0;  ///< [m]
};

/** \brief The smooth surfels of a cloud without a plane yet, in the order of the cells
 * of an octree, so that the surfels of a cell are contiguous.
 *
 * A surfel is addressed by its slot, which changes when others are removed. Coordinates
 * are relative to a corner of the cloud, where float is finest. */
class RemainingSurfels {
public:
  static constexpr std::uint32_t kGone = 0xffffffff;

  /** \param[in] finest [m] edge of the cells of level 0; enlarged for at most 2^21
   * cells along an axis */
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

  /** \return the surfel of a slot, a constant identity while slots change */
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

  /** \return the remaining surfels, in random order */
  std::vector<std::uint32_t>
  shuffled(std::uint64_t seed) const;

  /** \return the remaining surfels of a list, in its order */
  SurfelColumns
  columnsOf(const std::vector<std::uint32_t>& surfels) const;

  /** \brief Slots from begin up to, but not with, end. */
  struct Range {
    std::size_t begin = 0, end = 0;
  };

  /** \return the slots of the same cell. \param[in] level of cells with an edge of
   * finest times 2^level, in [0, 21] */
  Range
  cell(std::size_t slot, int level) const;

  /** \return a sample, evenly over the slots, drawn at random in each interval */
  SurfelColumns
  sample(std::size_t size, std::uint64_t seed) const;

  /** \brief Calls visit(slot) for the remaining neighbours of a surfel. */
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

  /** \return the points of some surfels, ascending indices into the cloud */
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
