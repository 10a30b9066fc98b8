// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/range_error_model.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl6d {
namespace {
constexpr double kNoRange = std::numeric_limits<double>::quiet_NaN();

// Sunflower pattern: every point represents an equal area. Its mean is moved to the axis and its mean
// square to that of an even disc: seven points of the plain pattern lie 9 % of the radius aside, like
// a scanner with wrong elevations, and shorten all ranges to a floor.
std::vector<Eigen::Vector2d>
spotPattern(int count)
{
  if (count == 1)
    return {Eigen::Vector2d::Zero()};
  const double golden_angle = M_PI * (3 - std::sqrt(5.0));
  std::vector<Eigen::Vector2d> points;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double sum_sq = 0;
  for (int i = 0; i < count; ++i) {
    const SinCos at = portableSinCos(i * golden_angle);
    points.emplace_back(std::sqrt((i + 0.5) / count) * Eigen::Vector2d(at.cos, at.sin));
    sum += points.back();
    sum_sq += points.back().squaredNorm();
  }
  const Eigen::Vector2d mean = sum / count;
  const double scale = std::sqrt(0.5 / (sum_sq / count - mean.squaredNorm()));
  for (Eigen::Vector2d& point : points)
    point = scale * (point - mean);
  return points;
}

// Light returned by a surface to the scanner, up to a factor.
double
power(const Echo& echo)
{
  return echo.intensity / (echo.range * echo.range);
}

void
requireNotNegative(const char* name, double value)
{
  require(value >= 0 && std::isfinite(value), name, value, ">= 0 and finite");
}
} // namespace

RangeOptions
RangeOptions::withoutErrors() const
{
  RangeOptions exact;
  exact.noise = 0;
  exact.min_range = min_range;
  exact.max_range = max_range;
  exact.seed = seed;
  exact.num_threads = num_threads;
  return exact;
}

void
RangeOptions::validate() const
{
  requireNotNegative("noise", noise);
  requireNotNegative("min_range", min_range);
  require(max_range > min_range, "max_range", max_range, "> min_range");
  requireNotNegative("noise_per_range", noise_per_range);
  requireNotNegative("noise_per_range_sq", noise_per_range_sq);
  requireNotNegative("incidence_noise", incidence_noise);
  requireNotNegative("signal_noise", signal_noise);
  requireNotNegative("quantum", quantum);
  require(ambiguity_interval > 0, "ambiguity_interval", ambiguity_interval, "> 0");
  require(dropout >= 0 && dropout <= 1, "dropout", dropout, "in [0, 1]");
  require(signal_range > 0, "signal_range", signal_range, "> 0");
  requireNotNegative("beam.exit_diameter", beam.exit_diameter);
  require(beam.divergence >= 0 && beam.divergence <= M_PI / 2,
          "beam.divergence",
          beam.divergence,
          "in [0, pi / 2]");
  require(beam.rays >= 1 && beam.rays <= 1000, "beam.rays", beam.rays, "in [1, 1000]");
  require(
      beam.echo_separation >= 0, "beam.echo_separation", beam.echo_separation, ">= 0");
}

RangeErrorModel::RangeErrorModel(const RangeOptions& options) : options_(options)
{
  options.validate();
  spot_ = spotPattern(options.beam.rays);
  const SinCos half = portableSinCos(options.beam.divergence / 2);
  spread_ = half.sin / half.cos;
}

Ray
RangeErrorModel::ray(const Ray& axis, int i) const
{
  if (spot_.size() == 1)
    return axis;
  Eigen::Index most_across = 0; // an axis far from the beam's
  axis.direction.cwiseAbs().minCoeff(&most_across);
  const Eigen::Vector3d u =
      axis.direction.cross(Eigen::Vector3d::Unit(most_across)).normalized();
  const Eigen::Vector3d v = axis.direction.cross(u);
  const Eigen::Vector2d& at = spot_[static_cast<std::size_t>(i)];
  const Eigen::Vector3d aside = at.x() * u + at.y() * v;
  return {axis.origin + options_.beam.exit_diameter / 2 * aside,
          (axis.direction + spread_ * aside).normalized()};
}

double
RangeErrorModel::sigma(double range, double intensity, double cos_incidence) const
{
  const RangeOptions& o = options_;
  double variance = o.noise * o.noise;
  const auto add = [&variance](double deviation) { variance += deviation * deviation; };
  add(o.noise_per_range * range);
  add(o.noise_per_range_sq * range * range);
  if (o.incidence_noise > 0) // a beam along a surface: no measurement, see measure()
    add(o.incidence_noise *
        std::sqrt(std::max(0.0, 1 - cos_incidence * cos_incidence)) / cos_incidence);
  if (o.signal_noise > 0)
    add(o.signal_noise / std::sqrt(intensity));
  return std::sqrt(variance);
}

RangeSample
RangeErrorModel::measure(std::vector<Echo>& echoes, Random& random) const
{
  const double error = random.normal();
  const bool fails = options_.dropout > 0 && random.uniform() < options_.dropout;
  const RangeSample no_return{kNoRange, 0, 0};
  if (fails || echoes.empty())
    return no_return;
  const Echo echo =
      echoes.size() == 1 && numRays() == 1 ? echoes.front() : strongestEcho(echoes);
  double range =
      echo.range + sigma(echo.range, echo.intensity, echo.cos_incidence) * error;
  // Negated: a NaN range is no return.
  if (!(range <= options_.max_range) ||
      range > options_.signal_range * std::sqrt(echo.intensity))
    return no_return;
  if (std::isfinite(options_.ambiguity_interval))
    range -=
        std::floor(range / options_.ambiguity_interval) * options_.ambiguity_interval;
  if (options_.quantum > 0)
    range = std::round(range / options_.quantum) * options_.quantum;
  if (!(range >= options_.min_range && range <= options_.max_range))
    return no_return;
  return {range, echo.intensity, echo.triangle};
}

// Of the groups of echoes that the scanner cannot separate, the brightest group.
Echo
RangeErrorModel::strongestEcho(std::vector<Echo>& echoes) const
{
  std::sort(echoes.begin(), echoes.end(), [](const Echo& a, const Echo& b) {
    return a.range < b.range || (a.range == b.range && a.triangle < b.triangle);
  });
  const Echo* const end = echoes.data() + echoes.size();
  const Echo* best_begin = nullptr;
  const Echo* best_end = nullptr;
  double most = -1;
  for (const Echo* begin = echoes.data(); begin != end;) {
    const Echo* last = begin;
    double light = power(*begin);
    for (; last + 1 != end &&
           last[1].range - last->range <= options_.beam.echo_separation;
         ++last)
      light += power(last[1]);
    if (light > most) {
      most = light;
      best_begin = begin;
      best_end = last + 1;
    }
    begin = last + 1;
  }
  return mixed(best_begin, best_end);
}

// Merges echoes: triangle and incidence of the brightest surface, a range between the surfaces.
Echo
RangeErrorModel::mixed(const Echo* begin, const Echo* end) const
{
  Echo echo = *std::max_element(
      begin, end, [](const Echo& a, const Echo& b) { return power(a) < power(b); });
  echo.range = mixedRange(begin, end);
  echo.intensity = 0;
  for (const Echo* part = begin; part != end; ++part)
    echo.intensity += part->intensity / numRays();
  return echo;
}

// The mean, weighted by the light. A phase-shift scanner sees the sum of waves instead.
double
RangeErrorModel::mixedRange(const Echo* begin, const Echo* end) const
{
  const double nearest = begin->range;
  double light = 0;
  double sum = 0;
  double sine = 0;
  double cosine = 0;
  const double interval = options_.ambiguity_interval;
  for (const Echo* part = begin; part != end; ++part) {
    const double weight = power(*part);
    const double behind = part->range - nearest;
    light += weight;
    sum += weight * behind;
    if (std::isfinite(interval)) {
      const SinCos wave =
          portableSinCos(2 * M_PI * std::fmod(behind, interval) / interval);
      sine += weight * wave.sin;
      cosine += weight * wave.cos;
    }
  }
  if (!(light > 0))
    return kNoRange; // nothing but black surfaces
  return nearest + (std::isfinite(interval)
                        ? portableAtan2(sine, cosine) * interval / (2 * M_PI)
                        : sum / light);
}

} // namespace pcl6d
