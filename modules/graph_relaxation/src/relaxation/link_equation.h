// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/pose_graph.h>
#include <pcl6d/graph_relaxation/link_sums.h>
#include <pcl6d/registration/twist.h>

namespace pcl6d::graph_relaxation {

/** \brief The linear equation of a link for its two scans: K (X_a - X_b) = g, for motions about
 * a centre.
 * \tparam Size 6: xb, x; 7: xb, scale, x */
template <int Size>
struct LinkEquation {
  using Matrix = Eigen::Matrix<double, Size, Size>;
  using Vector = Eigen::Matrix<double, Size, 1>;

  Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< [m] in the world
  Matrix K = Matrix::Zero();
  Vector g = Vector::Zero();
  Vector D = Vector::Zero(); ///< K D = g; zero in open directions
  double variance = 0;       ///< s^2 of the pairs [m^2]
  int open_directions = 0;   ///< motions left open by the pairs
};

/** A motion is open if the constraint of the pairs is below this limit; K and g are then zeroed
 * in its direction. Measured as in Localizability: the eigenvalues e of A u = e B u, where B
 * is A with each norm replaced by the unit matrix. For turns that hardly move the points,
 * about a line of points, the points count as a tenth of their extent away from the line:
 * within a hundredth of the extent such turns are open. */
constexpr double kOpenDirection = 0.01;

/** \param[in] least_variance guard of s^2 [m^2] */
template <int Size>
LinkEquation<Size>
equationOf(const LinkSums& sums, double least_variance);

/** \brief The equation of a measured relative pose at the current poses; K is the inverse of a
 * covariance. Minimises e^T information e, e the twist of the error pose (6.3), by
 * Gauss-Newton steps. The measurement contains no scale: its change is held at zero. */
template <int Size>
LinkEquation<Size>
equationOf(const PoseLink& link,
           const Eigen::Isometry3d& T_world_from,
           const Eigen::Isometry3d& T_world_to);

/** \return S of X_centre = S X, which moves the origin of a motion */
template <int Size>
Eigen::Matrix<double, Size, Size>
originShift(const Eigen::Vector3d& from, const Eigen::Vector3d& to)
{
  Eigen::Matrix<double, Size, Size> S = Eigen::Matrix<double, Size, Size>::Identity();
  if constexpr (Size == 7)
    S.template block<3, 1>(0, 3) = to - from;
  S.template topRightCorner<3, 3>() = -skew(to - from);
  return S;
}

} // namespace pcl6d::graph_relaxation
