// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/trajectory.h>

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <vector>

/** \file
 * Smoothness constraints on the motion of a scanner: between the poses ("knots") of the motion
 * within a scan, and between the knots of successive scans. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief Standard deviation of the accelerations a per axis. Accelerations last for about a
 * second: within a short time t a velocity changes by a times t, within a longer time by a
 * times the root of t (white noise on acceleration, T. Barfoot, "State estimation for
 * robotics", 2017). */
struct MotionNoise {
  double linear = 5;  ///< [m/s^2] > 0
  double angular = 5; ///< [rad/s^2] > 0
  /** \return upper limits for any carrier of a scanner: half of gravity, like a braking car, and a
   * robot or a hand that begins to turn by 30 deg/s within a tenth of a second */
  static MotionNoise
  plausible()
  {
    return {5, 5};
  }
  /** \return usual values of a drive or a walk: a start or a bend in about a second; stronger
   * accelerations follow from the scans (ElasticTerm::weights()) */
  static MotionNoise
  usual()
  {
    return {1, 1};
  }
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \return the variance of a change of velocity within a time [s], over the variance of
 * the accelerations */
double
velocityChange(double time);

/** \brief A linear constraint on the steps between up to four knots a, b, c, d:
 * first (b - a) + gap (c - b) + last (d - c) is about zero, where the step between two poses is
 * the translation and the rotation vector in the world. */
struct ElasticTerm {
  std::array<std::size_t, 4> knots{}; ///< b == c if the two steps meet: then gap is 0
  double first = 0, gap = 0, last = 0;
  double translation_weight = 0; ///< [1 / units of the residual^2]
  double rotation_weight = 0;
  /** least weights where the constraint is violated, by a sudden turn for example */
  double translation_least = 0, rotation_least = 0;

  /** \return the derivative of the residual by the position and, for small steps, the
   * rotation of each knot */
  std::array<double, 4>
  coefficients() const
  {
    return {-first, first - gap, gap - last, last};
  }

  /** \return the weights of the constraint at a residual: half at three standard deviations, less
   * beyond (Cauchy), but not below the least weights */
  Eigen::Matrix<double, 6, 1>
  weights(const Eigen::Matrix<double, 6, 1>& residual) const;

  /** \return the robust cost (negative log-likelihood) of the residual that goes with weights(); 0
   * where the constraint is met */
  double
  cost(const std::vector<Eigen::Isometry3d>& knots_world) const;

  /** \return the residual of the constraint: translations, then rotations */
  Eigen::Matrix<double, 6, 1>
  residual(const std::vector<Eigen::Isometry3d>& knots_world) const;
};

/** \return the constraints within a scan: equal velocities of neighbouring steps
 * \param[in] stamps of the knots [s], increasing \param[in] first number of the first knot
 * \throws BadArgument the noise is invalid */
std::vector<ElasticTerm>
elasticTermsWithin(const std::vector<double>& stamps,
                   std::size_t first,
                   const MotionNoise& noise);

/** \brief A knot, by its number among the constrained knots. */
struct KnotPlace {
  std::size_t number = 0;
  double stamp = 0; ///< [s]
};

/** \brief The constraints between the last step of a scan and the first of the next. Velocities
 * are equal, the shorter the gap the more strictly. The next scan begins where the velocities
 * lead, up to the error of straight steps: a step of time t with acceleration a ends a t^2 / 12
 * off. The begin of a scan need not be the end of the scan before (P. Dellenbach et al.,
 * "CT-ICP", ICRA 2022).
 * \param[in] a, b stamps and numbers of the last two knots, c, d of the first two of the next
 * \param[in] slack_translation, slack_rotation [m, rad] least standard deviation of the gap; > 0
 * \throws BadArgument stamps do not increase (b may be c or later), or the noise is invalid */
std::vector<ElasticTerm>
elasticTermsBetween(const KnotPlace& a,
                    const KnotPlace& b,
                    const KnotPlace& c,
                    const KnotPlace& d,
                    const MotionNoise& noise,
                    double slack_translation,
                    double slack_rotation);

/** \return the constraint of equal poses of two knots: the scan is rigid, to within a standard
 * deviation [m, rad] */
ElasticTerm
rigidTerm(std::size_t from, std::size_t to, double deviation);

} // namespace pcl6d
