// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/trajectory.h>

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <vector>

/** \file
 * How smoothly a scanner moves: what joins the poses that a motion within a scan is made of
 * ("knots"), and those of one scan with those of the next. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief How much velocities change: the standard deviation of the accelerations per axis.
 * They last for about a second, so that a velocity changes within the time t by a times t, for
 * longer by a times the root of t (white noise on acceleration, T. Barfoot, "State estimation
 * for robotics", 2017). */
struct MotionNoise {
  double linear = 5;  ///< [m/s^2] > 0
  double angular = 5; ///< [rad/s^2] > 0
  /** \return what is plausible of anything that carries a scanner: half of what weighs it
   * down, as of a car that brakes, and a robot or a hand that begins to turn by 30 deg/s
   * within a tenth of a second */
  static MotionNoise
  plausible()
  {
    return {5, 5};
  }
  /** \return what is usual of a drive or a walk: a start or a bend in a second or so; the rest
   * is left to what scans show (ElasticTerm::weights()) */
  static MotionNoise
  usual()
  {
    return {1, 1};
  }
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \return the variance of a change of velocity within a time [s], over that of the
 * accelerations */
double
velocityChange(double time);

/** \brief A linear rule about the steps between up to four knots a, b, c, d:
 * first (b - a) + gap (c - b) + last (d - c) is about zero, where the step from a pose to
 * another is its translation in the world and the rotation vector there. */
struct ElasticTerm {
  std::array<std::size_t, 4> knots{}; ///< b == c if the two steps meet: then gap is 0
  double first = 0, gap = 0, last = 0;
  double translation_weight = 0; ///< [1 / units of the rule^2]
  double rotation_weight = 0;
  /** weights that are left where the rule is broken, as by a sudden turn */
  double translation_least = 0, rotation_least = 0;

  /** \return how the rule's value changes with the position and, for small steps, the
   * rotation of each knot */
  std::array<double, 4>
  coefficients() const
  {
    return {-first, first - gap, gap - last, last};
  }

  /** \return how much the rule counts at a value: half as much at three standard deviations, less
   * beyond (Cauchy), but not less than the least weights */
  Eigen::Matrix<double, 6, 1>
  weights(const Eigen::Matrix<double, 6, 1>& residual) const;

  /** \return how unlikely the rule's value is, as the logarithm that goes with weights(); 0 where
   * it is kept */
  double
  cost(const std::vector<Eigen::Isometry3d>& knots_world) const;

  /** \return the value of the rule: translations, then rotations */
  Eigen::Matrix<double, 6, 1>
  residual(const std::vector<Eigen::Isometry3d>& knots_world) const;
};

/** \return the rules that hold within a scan: velocities of neighbouring steps are alike
 * \param[in] stamps of the knots [s], increasing \param[in] first number of the first knot
 * \throws BadArgument a rule of the noise is broken */
std::vector<ElasticTerm>
elasticTermsWithin(const std::vector<double>& stamps,
                   std::size_t first,
                   const MotionNoise& noise);

/** \brief A knot among all that rules speak of. */
struct KnotPlace {
  std::size_t number = 0;
  double stamp = 0; ///< [s]
};

/** \brief The rules between the last step of a scan and the first of the next: velocities are
 * alike, the more so the shorter the gap, and the next one begins where these lead, as far as
 * straight steps can tell: one of the time t with the acceleration a ends a t^2 / 12 off. The
 * begin of a scan need not be the end of the one before (P. Dellenbach et al., "CT-ICP",
 * ICRA 2022).
 * \param[in] a, b stamps and numbers of the last two knots, c, d of the first two of the next
 * \param[in] slack [m] and [rad] by which scans do not meet even without a gap; > 0
 * \throws BadArgument stamps do not increase (b may be c or later), or a rule is broken */
std::vector<ElasticTerm>
elasticTermsBetween(const KnotPlace& a,
                    const KnotPlace& b,
                    const KnotPlace& c,
                    const KnotPlace& d,
                    const MotionNoise& noise,
                    double slack_translation,
                    double slack_rotation);

/** \return the rule that two knots are one: the scan is rigid, to within a standard
 * deviation [m, rad] */
ElasticTerm
rigidTerm(std::size_t from, std::size_t to, double deviation);

} // namespace pcl6d
