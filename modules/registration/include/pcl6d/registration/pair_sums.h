// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/status.h>

#include <Eigen/Core>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Sums over matched points, the input of the closed-form minimisers (book
 * 4.1.1): source (data) points d, target (model) points m, weights w, in one
 * right-handed frame.
 *
 * Sums of parts are merged pairwise (4.1.6): in parallel, bit-identical for any number
 * of threads. \ingroup registration */
struct PairSums {
  std::size_t count = 0;                                 ///< pairs
  double weight = 0;                                     ///< W = sum w
  Eigen::Vector3d mean_source = Eigen::Vector3d::Zero(); ///< c_d [m]
  Eigen::Vector3d mean_target = Eigen::Vector3d::Zero(); ///< c_m [m]
  Eigen::Matrix3d cross = Eigen::Matrix3d::Zero(); ///< S = sum w d' m'^T, centred [m^2]
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero(); ///< sum w d' d'^T [m^2]
  double target_sq = 0;                              ///< s_m = sum w |m'|^2 [m^2]

  /** \return s_d = sum w |d'|^2 [m^2] */
  double
  sourceSq() const
  {
    return scatter.trace();
  }

  /** \return the sums of two disjoint sets of pairs */
  static PairSums
  merge(const PairSums& a, const PairSums& b);

  /** \return sum w |m - T d|^2 [m^2] for a rigid motion T */
  double
  errorSq(const Eigen::Isometry3d& T) const;
};

/** \brief Adds up pairs one by one. Sums are taken about the first pair: points far
 * from the origin lose no digits. */
class PairAccumulator {
public:
  /** Condition on pairs that fix a motion, for error messages. */
  static constexpr const char* kNeeds =
      "at least 3 that are not on one line are needed";

  /** \brief Adds a pair; pairs with a coordinate that is not finite are skipped. */
  void
  add(const Eigen::Vector3d& source, const Eigen::Vector3d& target, double weight = 1);

  PairSums
  sums() const;

private:
  std::size_t count_ = 0;
  double weight_ = 0;
  Eigen::Vector3d origin_source_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d origin_target_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d sum_source_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d sum_target_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d sum_cross_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d sum_scatter_ = Eigen::Matrix3d::Zero();
  double sum_target_sq_ = 0;
};

} // namespace pcl6d
