// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sweep_matcher.h"

#include <vector>

namespace pcl6d::odometry {

/** \brief Sums of the normal equations of a part of the sweep, split by the shares of begin and end. */
struct PartSums {
  Matrix6 begin = Matrix6::Zero(), mixed = Matrix6::Zero(), end = Matrix6::Zero();
  Twist begin_side = Twist::Zero(), end_side = Twist::Zero();

  /** \param[in] row d distance / d motion \param[in] weight [1/m^2] */
  void
  add(const Twist& row, double distance, double weight, double share)
  {
    const double rest = 1 - share;
    const double bb = weight * rest * rest, be = weight * rest * share,
                 ee = weight * share * share;
    for (int c = 0; c < 6; ++c)
      for (int r = c; r < 6; ++r) {
        const double product = row(r) * row(c);
        begin(r, c) += bb * product;
        mixed(r, c) += be * product;
        end(r, c) += ee * product;
      }
    begin_side += (weight * rest * distance) * row;
    end_side += (weight * share * distance) * row;
  }

  friend PartSums
  operator+(PartSums a, const PartSums& b)
  {
    a.begin += b.begin;
    a.mixed += b.mixed;
    a.end += b.end;
    a.begin_side += b.begin_side;
    a.end_side += b.end_side;
    return a;
  }
};

/** \return the sums of each part over both */
std::vector<PartSums>
added(std::vector<PartSums> a, const std::vector<PartSums>& b);

/** \brief The normal equations of a match: unknown are the motions of the poses at the begin, between
 * the parts, and at the end, in world axes about the centre of the prior. */
class SweepEquations {
public:
  /** \param[in] data one for each part */
  explicit SweepEquations(const std::vector<PartSums>& data);

  /** \brief Drops what the data say outside a subspace. \param[in] fixed projection on it */
  void
  project(const Matrix6& fixed);

  /** \brief Adds the prior of begin and velocity, and with several parts that of the velocities of
   * the parts. */
  void
  add(const SweepPrior& prior, const SweepMotion& motion);

  Eigen::VectorXd
  solve() const
  {
    return normal_.ldlt().solve(-side_);
  }

  const Eigen::MatrixXd&
  normal() const
  {
    return normal_;
  }

private:
  void
  addSteadiness(const SweepPrior& prior, const SweepMotion& motion);

  Eigen::MatrixXd normal_;
  Eigen::VectorXd side_;
};

} // namespace pcl6d::odometry
