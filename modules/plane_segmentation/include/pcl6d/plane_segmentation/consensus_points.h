// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The points for findPlaneConsensus(), packed in columns. A point's index
 * counts the points offered before it, left out or not.
 * \ingroup plane_segmentation */
class ConsensusPoints {
public:
  /** \param[in] capacity largest number of points to offer
   * \param[in] with_normals whether each point has a normal */
  explicit ConsensusPoints(std::size_t capacity, bool with_normals = false);

  /** \brief Adds a point without a normal [m]; a non-finite point is left out. */
  void
  add(float x, float y, float z)
  {
    xs_[size_] = x;
    ys_[size_] = y;
    zs_[size_] = z;
    places_[size_] = offered_++;
    // Zero times a non-finite number is not zero.
    const float zero = 0 * x + 0 * y + 0 * z;
    size_ += static_cast<std::size_t>(zero == 0);
  }

  /** \brief Adds a point with its normal; left out unless both are finite and the
   * normal is not zero.
   * \param[in] point [m] \param[in] normal of any length and sign
   * \param[in] weight of the angle between normal and plane, in [0, 1]; see
   * PlaneConsensusOptions::max_distance */
  void
  add(const Eigen::Vector3f& point, const Eigen::Vector3f& normal, float weight);

  /** \return the number of points kept */
  std::size_t
  size() const
  {
    return size_;
  }

  bool
  hasNormals() const
  {
    return !weights_.empty();
  }

  /** \return the origin of x, y and z, in the frame of the points [m] */
  const Eigen::Vector3f&
  origin() const
  {
    return origin_;
  }

  Eigen::Vector3f
  point(std::size_t i) const
  {
    return {xs_[i], ys_[i], zs_[i]};
  }

  /** \return the index of a kept point; ascending, except in a sample() */
  std::uint32_t
  place(std::size_t i) const
  {
    return places_[i];
  }

  /** \return the position of the point with an index, if indices ascend; nullopt if the
   * point was left out */
  std::optional<std::size_t>
  find(std::uint32_t place) const;

  const float*
  x() const
  {
    return xs_.data();
  }
  const float*
  y() const
  {
    return ys_.data();
  }
  const float*
  z() const
  {
    return zs_.data();
  }

  /** \return component 0, 1 or 2 of the unit normals, only if hasNormals() */
  const float*
  normal(std::size_t axis) const
  {
    return normals_[axis].data();
  }
  const float*
  weight() const
  {
    return weights_.data();
  }

  /** \brief Makes coordinates relative to a position amid the points, to save digits
   * far from their origin: the median of a sample, robust to outliers. */
  void
  centre();

  /** \return a random subset in random order, one point from each of `count` runs of
   * equal length; every point if there are at most `count`. \param[in] seed of the
   * choice */
  ConsensusPoints
  sample(std::size_t count, std::uint64_t seed) const;

private:
  std::size_t size_ = 0;
  std::uint32_t offered_ = 0;
  Eigen::Vector3f origin_ = Eigen::Vector3f::Zero();
  std::vector<float> xs_, ys_, zs_;
  std::vector<float> normals_[3];
  std::vector<float> weights_;
  std::vector<std::uint32_t> places_;
};

} // namespace pcl6d
