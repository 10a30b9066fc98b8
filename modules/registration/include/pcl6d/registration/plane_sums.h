// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/registration/twist.h>

#include <cstddef>

namespace pcl6d {

/** \brief All that a point-to-plane step needs to know of its pairs: the normal
 * equations A u = b of sum w (n . (m - d - v(d)))^2 for a small motion v, the twist u
 * about the centroid of the source points (book 4.1.2 with normals).
 *
 * d: source point, m: target point [m], n: unit normal in m, w: weight. Sums of parts
 * are merged pairwise (4.1.6), like PairSums. \ingroup registration */
struct PlaneSums {
  using Matrix = Eigen::Matrix<double, 6, 6>;

  std::size_t count = 0;                                 ///< pairs
  double weight = 0;                                     ///< W = sum w
  Eigen::Vector3d mean_source = Eigen::Vector3d::Zero(); ///< c_d [m]
  Matrix A = Matrix::Zero(); ///< sum w a a^T, a = (n, (d - c_d) x n)
  Twist b = Twist::Zero();   ///< sum w a n.(m - d)
  double residual_sq = 0;    ///< sum w (n.(m - d))^2 [m^2]
  double source_sq = 0;      ///< sum w |d - c_d|^2 [m^2]

  /** \return the sums of two disjoint sets of pairs */
  static PlaneSums
  merge(const PlaneSums& a, const PlaneSums& b);
};

/** \brief Adds up pairs one by one, about the first source point, so that points far
 * from the origin lose no digits. */
class PlaneAccumulator {
public:
  /** What pairs must have to fix a motion, for error messages. */
  static constexpr const char* kNeeds =
      "the normals must resist all six directions of motion";

  /** \brief Adds a pair. The normal counts by its direction alone; pairs with a value
   * that is not finite, and normals of no length (never estimated), are skipped. */
  void
  add(const Eigen::Vector3d& source,
      const Eigen::Vector3d& target,
      const Eigen::Vector3d& normal,
      double weight = 1);

  PlaneSums
  sums() const;

private:
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  PlaneSums sums_; ///< about origin_, with the mean relative to it and not yet divided
};

} // namespace pcl6d
