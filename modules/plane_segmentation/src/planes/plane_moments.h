// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>

namespace pcl6d::plane_segmentation {

/** \brief A plane with an orientation of its own: normal . p = offset. */
struct PlaneFit {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset = 0;                                ///< [m], of either sign
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< [m] mean of the points
  double mean_square = 0; ///< of the weighted points' distances

  double
  distance(const Eigen::Vector3d& p) const
  {
    return normal.dot(p) - offset;
  }

  void
  flip()
  {
    normal = -normal;
    offset = -offset;
  }
};

/** \brief Weighted sums over points about a fixed origin, for the least-squares plane
 * (book 7.1.1). Sums of parts can be added. */
class PlaneMoments {
public:
  /** \param[in] about [m] a position near the points, to save digits */
  explicit PlaneMoments(const Eigen::Vector3d& about = Eigen::Vector3d::Zero())
  : about_(about)
  {}

  /** \brief Known sums of points of weight 1 about the origin. \param[in] sum of p [m]
   * \param[in] squares sum of p p^T [m^2] */
  PlaneMoments(std::size_t count,
               const Eigen::Vector3d& sum,
               const Eigen::Matrix3d& squares)
  : about_(Eigen::Vector3d::Zero())
  , count_(count)
  , weight_(static_cast<double>(count))
  , sum_(sum)
  , squares_(squares)
  {}

  void
  add(const Eigen::Vector3d& point, double weight = 1)
  {
    const Eigen::Vector3d d = point - about_;
    weight_ += weight;
    sum_ += weight * d;
    squares_.noalias() += (weight * d) * d.transpose();
    ++count_;
  }

  /** \brief Adds sums, which may be about another origin. */
  void
  add(const PlaneMoments& other);

  std::size_t
  count() const
  {
    return count_;
  }

  /** \return the mean square of weight * distance^2 per point to a plane */
  double
  meanSquare(const PlaneFit& plane) const;

  /** \return the plane; nullopt for fewer than 3 points, or collinear points */
  std::optional<PlaneFit>
  fit() const;

  /** \return sum of w (p - mean) (p - mean)^T */
  Eigen::Matrix3d
  scatter() const
  {
    return squares_ - sum_ * sum_.transpose() / weight_;
  }

  Eigen::Vector3d
  mean() const
  {
    return about_ + sum_ / weight_;
  }

private:
  Eigen::Vector3d about_;
  std::size_t count_ = 0;
  double weight_ = 0;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares_ = Eigen::Matrix3d::Zero();
};

} // namespace pcl6d::plane_segmentation
