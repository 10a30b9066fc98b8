// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/graph_relaxation/link_sums.h>

namespace pcl6d::graph_relaxation {

/** \brief What is added up pair by pair, about an origin that all blocks of a link share,
 * so that merging is adding. */
struct PairMoments {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  std::size_t count = 0;
  double weight = 0;
  double weight_sq = 0;
  Vector6 first = Vector6::Zero();  ///< sum w (c, Z)
  Matrix6 second = Matrix6::Zero(); ///< sum w (c, Z) (c, Z)^T

  bool has_norms = false; ///< the rest is filled in
  double trace = 0;       ///< sum tr W
  double trace_sq = 0;    ///< sum tr W^2
  LinkSums::Matrix A = LinkSums::Matrix::Zero();
  LinkSums::Vector b = LinkSums::Vector::Zero();
  double residual_sq = 0;

  /** \param[in] c, Z midpoint about the origin and difference of a pair */
  void
  add(const Eigen::Vector3d& c, const Eigen::Vector3d& Z, double w);

  /** The same of a pair with a norm, times its weight. */
  void
  addNorm(const Eigen::Vector3d& c, const Eigen::Vector3d& Z, const Eigen::Matrix3d& W);

  static PairMoments
  merge(const PairMoments& a, const PairMoments& b);

  /** \return the sums about the mean of c */
  LinkSums
  about(const Eigen::Vector3d& origin) const;
};

} // namespace pcl6d::graph_relaxation
