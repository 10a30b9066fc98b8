// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/scanner/measurement_principles.h>
#include <pcl6d/scanner/range_error_model.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace {
using pcl6d::Echo;
using pcl6d::Random;
using pcl6d::RangeErrorModel;
using pcl6d::RangeOptions;
using pcl6d::RangeSample;

constexpr int kCount = 20000; // measurements of a statistic
constexpr double kInfinity = std::numeric_limits<double>::infinity();

RangeOptions
exact()
{
  RangeOptions options;
  options.max_range = 200;
  return options.withoutErrors();
}

Echo
echoAt(double range, double reflectance = 1, double incidence = 0)
{
  const double c = std::cos(incidence);
  return {range, reflectance * c, c, 7};
}

RangeSample
measureOnce(const RangeOptions& options, std::vector<Echo> echoes)
{
  Random random(1);
  return RangeErrorModel(options).measure(echoes, random);
}

struct Statistics {
  double mean = 0;
  double sigma = 0;
  int returns = 0;
};

Statistics
errorsOf(const RangeOptions& options, const std::function<Echo(Random&)>& truth)
{
  const RangeErrorModel model(options);
  Random random(5);
  Random of_truth(6);
  Statistics s;
  double sum_sq = 0;
  for (int i = 0; i < kCount; ++i) {
    std::vector<Echo> echoes = {truth(of_truth)};
    const double range = echoes.front().range;
    const RangeSample sample = model.measure(echoes, random);
    if (std::isnan(sample.range))
      continue;
    ++s.returns;
    s.mean += sample.range - range;
    sum_sq += (sample.range - range) * (sample.range - range);
  }
  s.mean /= s.returns;
  s.sigma = std::sqrt(sum_sq / s.returns - s.mean * s.mean);
  return s;
}

// Within five standard errors of mean and standard deviation.
void
expectNoise(const RangeOptions& options, const Echo& echo, double sigma)
{
  const Statistics s = errorsOf(options, [&](Random&) { return echo; });
  EXPECT_EQ(s.returns, kCount);
  EXPECT_NEAR(s.mean, 0, 5 * sigma / std::sqrt(kCount));
  EXPECT_NEAR(s.sigma, sigma, 5 * sigma / std::sqrt(2.0 * kCount));
}
} // namespace

TEST(RangeErrorModel, AddsConstantNoise)
{
  RangeOptions options = exact();
  options.noise = 0.02;
  expectNoise(options, echoAt(3), 0.02);
  expectNoise(options, echoAt(80, 0.1, 1.2), 0.02);
}

TEST(RangeErrorModel, NoiseGrowsWithTheRange)
{
  RangeOptions options = exact();
  options.noise_per_range = 1e-3;
  expectNoise(options, echoAt(10), 0.01);
  expectNoise(options, echoAt(100), 0.1);
  options = exact();
  options.noise_per_range_sq = 1e-3;
  expectNoise(options, echoAt(1), 0.001);
  expectNoise(options, echoAt(10), 0.1);
}

TEST(RangeErrorModel, NoiseGrowsWithTheIncidence)
{
  RangeOptions options = exact();
  options.incidence_noise = 0.01;
  EXPECT_EQ(measureOnce(options, {echoAt(10)}).range, 10); // hit squarely
  for (const double incidence : {0.3, 0.8, 1.4})
    expectNoise(options, echoAt(10, 1, incidence), 0.01 * std::tan(incidence));
}

TEST(RangeErrorModel, NoiseGrowsWithDarkness)
{
  RangeOptions options = exact();
  options.signal_noise = 0.003;
  expectNoise(options, echoAt(10), 0.003);
  expectNoise(options, echoAt(10, 0.04), 0.003 / 0.2);
  expectNoise(options, echoAt(10, 1, M_PI / 3), 0.003 / std::sqrt(0.5));
  EXPECT_TRUE(std::isnan(measureOnce(options, {echoAt(10, 0)}).range)); // black
}

TEST(RangeErrorModel, NoisesAddAsIndependentOnesDo)
{
  RangeOptions options = exact();
  options.noise = 0.003;
  options.noise_per_range = 4e-4; // 0.004 at 10 m
  options.signal_noise = 0.006;   // 0.012 at an intensity of 0.25
  const double sigma = 0.013;
  EXPECT_NEAR(RangeErrorModel(options).sigma(10, 0.25, 1), sigma, 1e-15);
  expectNoise(options, echoAt(10, 0.25), sigma);
}

TEST(RangeErrorModel, QuantisationRoundsToMultiples)
{
  RangeOptions options = exact();
  options.quantum = 0.05;
  for (double range = 1; range < 3; range += 0.0131) {
    const double measured = measureOnce(options, {echoAt(range)}).range;
    EXPECT_NEAR(std::remainder(measured, options.quantum), 0, 1e-12);
    EXPECT_LE(std::abs(measured - range), options.quantum / 2 + 1e-12);
  }
  // Even over the range the error is that of a uniform number: q / sqrt(12).
  const Statistics s =
      errorsOf(options, [](Random& random) { return echoAt(random.uniform(10, 20)); });
  const double sigma = options.quantum / std::sqrt(12.0);
  EXPECT_NEAR(s.mean, 0, 5 * sigma / std::sqrt(kCount));
  EXPECT_NEAR(s.sigma, sigma, 5 * sigma / std::sqrt(2.0 * kCount));
}

TEST(RangeErrorModel, PhaseShiftRepeatsAfterTheAmbiguityInterval)
{
  RangeOptions options = exact();
  options.ambiguity_interval = pcl6d::ambiguityInterval(20e6);
  options.min_range = 0;
  for (double range = 0.05; range < 40; range += 0.31)
    EXPECT_NEAR(measureOnce(options, {echoAt(range)}).range,
                std::fmod(range, options.ambiguity_interval),
                1e-12);
  options.max_range = 30; // is that of the light, not of the reading
  EXPECT_TRUE(std::isnan(measureOnce(options, {echoAt(30.1)}).range));
}

TEST(RangeErrorModel, DropsTheGivenShare)
{
  RangeOptions options = exact();
  options.dropout = 0.07;
  const Statistics s = errorsOf(options, [](Random&) { return echoAt(5); });
  EXPECT_NEAR(
      1 - double(s.returns) / kCount, 0.07, 5 * std::sqrt(0.07 * 0.93 / kCount));
}

TEST(RangeErrorModel, SeesDarkSurfacesLessFar)
{
  RangeOptions options = exact();
  options.signal_range = 100;
  EXPECT_EQ(measureOnce(options, {echoAt(99.9)}).range, 99.9);
  EXPECT_TRUE(std::isnan(measureOnce(options, {echoAt(100.1)}).range));
  EXPECT_EQ(measureOnce(options, {echoAt(49.9, 0.25)}).range, 49.9);
  EXPECT_TRUE(std::isnan(measureOnce(options, {echoAt(50.1, 0.25)}).range));
}

TEST(RangeErrorModel, TakesTheSameRandomNumbersWhateverThereIs)
{
  RangeOptions options;
  options.dropout = 0.5;
  const RangeErrorModel model(options);
  Random seen(1);
  Random unseen(1);
  for (int i = 0; i < 100; ++i) {
    std::vector<Echo> echoes = {echoAt(5)};
    std::vector<Echo> none;
    model.measure(echoes, seen);
    EXPECT_TRUE(std::isnan(model.measure(none, unseen).range));
    ASSERT_EQ(seen.uniform(), unseen.uniform());
  }
}

TEST(RangeErrorModel, RaysFillTheSpotEvenly)
{
  RangeOptions options = exact();
  options.beam = {0.02, 5e-3, 400, kInfinity};
  const RangeErrorModel model(options);
  ASSERT_EQ(model.numRays(), 400);
  const pcl6d::Ray axis{{1, 2, 3}, Eigen::Vector3d(1, -2, 0.5).normalized()};
  for (const double range : {0.0, 1.0, 20.0}) {
    const double radius =
        pcl6d::footprintDiameter(range, 0.02, 5e-3) / 2; // of the spot
    const Eigen::Vector3d centre = axis.origin + range * axis.direction;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double sum_sq = 0;
    for (int i = 0; i < 400; ++i) {
      const pcl6d::Ray ray = model.ray(axis, i);
      ASSERT_NEAR(ray.direction.norm(), 1, 1e-15);
      const double way =
          (centre - ray.origin).dot(axis.direction) / ray.direction.dot(axis.direction);
      const Eigen::Vector3d aside = ray.origin + way * ray.direction - centre;
      ASSERT_LT(aside.norm(), radius * (1 + 1e-12));
      sum += aside;
      sum_sq += aside.squaredNorm();
    }
    EXPECT_LT(sum.norm() / 400, 0.02 * radius);
    EXPECT_NEAR(sum_sq / 400, radius * radius / 2, 1e-9); // of an even disc
  }
}

// A spot of few rays that lies aside of its axis is a scanner with wrong elevations.
TEST(RangeErrorModel, TheSpotLiesAboutItsAxisHoweverFewItsRays)
{
  for (const int rays : {1, 2, 3, 7, 19}) {
    RangeOptions options = exact();
    options.beam = {0.02, 5e-3, rays, kInfinity};
    const RangeErrorModel model(options);
    const pcl6d::Ray axis{{1, 2, 3}, Eigen::Vector3d(1, -2, 0.5).normalized()};
    for (const double range : {0.0, 20.0}) {
      const double radius = pcl6d::footprintDiameter(range, 0.02, 5e-3) / 2;
      const Eigen::Vector3d centre = axis.origin + range * axis.direction;
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (int i = 0; i < rays; ++i) {
        const pcl6d::Ray ray = model.ray(axis, i);
        const double way = (centre - ray.origin).dot(axis.direction) /
                           ray.direction.dot(axis.direction);
        const Eigen::Vector3d aside = ray.origin + way * ray.direction - centre;
        EXPECT_LT(aside.norm(), radius * (1 + 1e-12)) << rays << " rays";
        sum += aside;
      }
      EXPECT_LT(sum.norm() / rays, 1e-12) << rays << " rays at " << range << " m";
    }
  }
}

TEST(RangeErrorModel, MixesEchoesByTheirLight)
{
  RangeOptions options = exact();
  options.beam.rays = 4;
  const RangeSample sample =
      measureOnce(options, {echoAt(6, 0.9), echoAt(5, 0.5), echoAt(5, 0.5)});
  const double near = 2 * 0.5 / 25; // light of the surfaces
  const double far = 0.9 / 36;
  EXPECT_NEAR(sample.range, (5 * near + 6 * far) / (near + far), 1e-12);
  EXPECT_NEAR(sample.intensity, (2 * 0.5 + 0.9) / 4, 1e-12); // a ray met nothing
}

TEST(RangeErrorModel, TakesTheStrongestOfSeparateEchoes)
{
  RangeOptions options = exact();
  options.beam.rays = 3;
  options.beam.echo_separation = 0.5;
  const std::vector<Echo> weak_behind = {echoAt(6, 0.9), echoAt(5), echoAt(5.2)};
  EXPECT_NEAR(measureOnce(options, weak_behind).range,
              (5 / 25.0 + 5.2 / 27.04) / (1 / 25.0 + 1 / 27.04),
              1e-12);
  const std::vector<Echo> weak_ahead = {echoAt(6), echoAt(5, 0.1), echoAt(6.5)};
  EXPECT_NEAR(measureOnce(options, weak_ahead).range,
              (6 / 36.0 + 6.5 / 42.25) / (1 / 36.0 + 1 / 42.25),
              1e-12);
}

TEST(RangeErrorModel, PhaseShiftMixesWavesNotRanges)
{
  RangeOptions options = exact();
  options.beam.rays = 2;
  options.ambiguity_interval = 7.5;
  // Equal light at 0.4 and 0.4 + 0.6 intervals: the sum of the waves lies on the far
  // side of the circle, at 0.4 + 0.3 + 0.5 = 0.2 of the next interval.
  Echo near = echoAt(3);
  Echo far = echoAt(7.5);
  near.intensity = 9.0 / 100;
  far.intensity = 56.25 / 100;
  EXPECT_NEAR(measureOnce(options, {near, far}).range, 0.2 * 7.5, 1e-9);
  // Close surfaces: the mean of the ranges.
  EXPECT_NEAR(measureOnce(options, {echoAt(3), echoAt(3.001)}).range, 3.0005, 1e-6);
}

TEST(RangeErrorModel, RefusesBrokenOptions)
{
  const auto refused = [](auto change) {
    RangeOptions options;
    change(options);
    EXPECT_THROW(RangeErrorModel{options}, pcl6d::BadArgument);
  };
  const double nan = std::nan("");
  for (double RangeOptions::*field : {&RangeOptions::noise,
                                      &RangeOptions::noise_per_range,
                                      &RangeOptions::noise_per_range_sq,
                                      &RangeOptions::incidence_noise,
                                      &RangeOptions::signal_noise,
                                      &RangeOptions::quantum,
                                      &RangeOptions::min_range,
                                      &RangeOptions::dropout})
    for (const double value : {-0.1, nan, kInfinity})
      refused([&](auto& o) { o.*field = value; });
  for (double RangeOptions::*field :
       {&RangeOptions::ambiguity_interval, &RangeOptions::signal_range})
    for (const double value : {0.0, -1.0, nan})
      refused([&](auto& o) { o.*field = value; });
  refused([](auto& o) { o.dropout = 1.1; });
  refused([&](auto& o) { o.max_range = nan; });
  refused([](auto& o) { o.beam.rays = 0; });
  refused([](auto& o) { o.beam.rays = 1001; });
  refused([](auto& o) { o.beam.exit_diameter = -1; });
  refused([&](auto& o) { o.beam.divergence = nan; });
  refused([](auto& o) { o.beam.divergence = 2; });
  refused([&](auto& o) { o.beam.echo_separation = nan; });
}
