// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/deskew/elastic_terms.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
using Vector6 = Eigen::Matrix<double, 6, 1>;

/** Standard deviations at which a constraint has half its weight. */
constexpr double kDeviations = 3;

Vector6
stepBetween(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to)
{
  Vector6 step;
  step << to.translation() - from.translation(),
      rotationVector(to.linear() * from.linear().transpose());
  return step;
}

/** The constraint of equal velocities of two steps. */
ElasticTerm
sameVelocity(const std::array<std::size_t, 4>& knots,
             double first_time,
             double last_time,
             double between,
             const MotionNoise& noise)
{
  ElasticTerm term;
  term.knots = knots;
  term.first = -1 / first_time;
  term.last = 1 / last_time;
  const double change = velocityChange(between);
  const auto weight = [&](double acceleration) {
    return 1 / (acceleration * acceleration * change);
  };
  const MotionNoise plausible = MotionNoise::plausible();
  term.translation_weight = weight(noise.linear);
  term.rotation_weight = weight(noise.angular);
  term.translation_least = weight(std::max(noise.linear, plausible.linear));
  term.rotation_least = weight(std::max(noise.angular, plausible.angular));
  return term;
}
} // namespace

void
MotionNoise::validate() const
{
  require(std::isfinite(linear) && linear > 0, "linear", linear, "finite and > 0");
  require(std::isfinite(angular) && angular > 0, "angular", angular, "finite and > 0");
}

double
velocityChange(double time)
{
  constexpr double kLasting = 1; // [s] of an acceleration
  return time * std::min(time, kLasting);
}

Vector6
ElasticTerm::residual(const std::vector<Eigen::Isometry3d>& world) const
{
  const auto& [a, b, c, d] = knots;
  Vector6 value = first * stepBetween(world[a], world[b]);
  if (gap != 0)
    value += gap * stepBetween(world[b], world[c]);
  if (last != 0)
    value += last * stepBetween(world[c], world[d]);
  return value;
}

double
ElasticTerm::cost(const std::vector<Eigen::Isometry3d>& world) const
{
  const Vector6 value = residual(world);
  const auto of = [](double off_sq, double weight) {
    constexpr double kScale = kDeviations * kDeviations;
    return kScale / 2 * portableLog(1 + off_sq * weight / kScale);
  };
  return of(value.head<3>().squaredNorm(), translation_weight) +
         of(value.tail<3>().squaredNorm(), rotation_weight);
}

Vector6
ElasticTerm::weights(const Vector6& residual) const
{
  const auto left = [](double off, double weight, double least) {
    const double deviations = off * std::sqrt(weight) / kDeviations;
    return std::max(least, weight / (1 + deviations * deviations));
  };
  Vector6 weights;
  weights << Eigen::Vector3d::Constant(
      left(residual.head<3>().norm(), translation_weight, translation_least)),
      Eigen::Vector3d::Constant(
          left(residual.tail<3>().norm(), rotation_weight, rotation_least));
  return weights;
}

std::vector<ElasticTerm>
elasticTermsWithin(const std::vector<double>& stamps,
                   std::size_t first,
                   const MotionNoise& noise)
{
  noise.validate();
  std::vector<ElasticTerm> terms;
  for (std::size_t k = 0; k + 2 < stamps.size(); ++k) {
    const double before = stamps[k + 1] - stamps[k];
    const double after = stamps[k + 2] - stamps[k + 1];
    terms.push_back(
        sameVelocity({first + k, first + k + 1, first + k + 1, first + k + 2},
                     before,
                     after,
                     (before + after) / 2,
                     noise));
  }
  return terms;
}

std::vector<ElasticTerm>
elasticTermsBetween(const KnotPlace& a,
                    const KnotPlace& b,
                    const KnotPlace& c,
                    const KnotPlace& d,
                    const MotionNoise& noise,
                    double slack_translation,
                    double slack_rotation)
{
  noise.validate();
  const double before = b.stamp - a.stamp, after = d.stamp - c.stamp;
  require(before > 0 && after > 0, "time of a step", std::min(before, after), "> 0 s");
  require(slack_translation > 0 && slack_rotation > 0,
          "slack",
          std::min(slack_translation, slack_rotation),
          "> 0");
  const double gap = std::max(0.0, c.stamp - b.stamp); // scans may overlap a little
  const std::array<std::size_t, 4> knots = {a.number, b.number, c.number, d.number};
  ElasticTerm meeting;
  meeting.knots = knots;
  meeting.gap = 1;
  meeting.first = -gap / 2 / before;
  meeting.last = -gap / 2 / after;
  // Variance of a random walk of velocities known at both ends of the gap: q t^3 / 12; and the best
  // line through a parabola misses the ends by a t^2 / 12.
  const double bend = (before * before + after * after) / 2 / 12;
  const double spread = gap * gap * velocityChange(gap) / 12 + bend * bend;
  const auto weight = [&](double acceleration, double slack) {
    return 1 / (acceleration * acceleration * spread + slack * slack);
  };
  const MotionNoise plausible = MotionNoise::plausible();
  meeting.translation_weight = weight(noise.linear, slack_translation);
  meeting.rotation_weight = weight(noise.angular, slack_rotation);
  meeting.translation_least =
      weight(std::max(noise.linear, plausible.linear), slack_translation);
  meeting.rotation_least =
      weight(std::max(noise.angular, plausible.angular), slack_rotation);
  return {sameVelocity(knots, before, after, gap + (before + after) / 2, noise),
          meeting};
}

ElasticTerm
rigidTerm(std::size_t from, std::size_t to, double deviation)
{
  require(deviation > 0, "deviation", deviation, "> 0");
  ElasticTerm term;
  term.knots = {from, to, to, to};
  term.first = 1;
  term.translation_weight = term.rotation_weight = 1 / (deviation * deviation);
  term.translation_least = term.rotation_least = term.translation_weight;
  return term;
}

} // namespace pcl6d
