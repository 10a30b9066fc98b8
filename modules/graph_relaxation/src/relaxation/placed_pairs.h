// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/graph_relaxation/link_sums.h>

#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>

namespace pcl6d {

/** The pairs of a link in the axes of the world, about the origin of the first scan: coordinates stay
 * small. */
class PlacedPairs {
public:
  PlacedPairs(const LinkPairs& pairs,
              const Eigen::Isometry3d& T_world_from,
              const Eigen::Isometry3d& T_world_to)
  : pairs_(pairs)
  , origin_(T_world_from.translation())
  , R_from_(T_world_from.linear())
  , R_to_(T_world_to.linear())
  , t_to_(T_world_to.translation() - origin_)
  {}

  std::size_t
  size() const
  {
    return pairs_.points_from.size();
  }

  const Eigen::Vector3d&
  origin() const
  {
    return origin_;
  }

  /** \return whether the pair counts \param[out] c, Z midpoint about the origin and
   * difference [m] */
  bool
  place(std::size_t k, Eigen::Vector3d& c, Eigen::Vector3d& Z) const
  {
    const Eigen::Vector3d pa = R_from_ * pairs_.points_from[k].cast<double>();
    const Eigen::Vector3d pb = R_to_ * pairs_.points_to[k].cast<double>() + t_to_;
    Z = pa - pb;
    c = 0.5 * (pa + pb);
    const double w = weight(k);
    // A sum of squares is finite only if each term is.
    return w > 0 && std::isfinite(w) &&
           std::isfinite(c.squaredNorm() + Z.squaredNorm());
  }

  double
  weight(std::size_t k) const
  {
    return pairs_.weights.empty() ? 1 : pairs_.weights[k];
  }

  bool
  hasNorms() const
  {
    return !pairs_.norms.empty();
  }

  const Eigen::Matrix3d&
  norm(std::size_t k) const
  {
    return pairs_.norms[k];
  }

private:
  const LinkPairs& pairs_;
  Eigen::Vector3d origin_;
  Eigen::Matrix3d R_from_, R_to_;
  Eigen::Vector3d t_to_;
};

} // namespace pcl6d
