// SPDX-License-Identifier: BSD-3-Clause
#include "support/fit_oracles.h"
#include "support/points.h"
#include "support/poses.h"

#include <pcl6d/benchmarking/map_entropy.h>

#include <gtest/gtest.h>

#include <cmath>

using pcl6d::LocalSpread;
using pcl6d::localSpreads;
using pcl6d::MapEntropyOptions;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::test::kNan;

namespace {
/** By the definition, in double, looking at every point. */
LocalSpread
bruteForce(const Eigen::Vector3f& place, const Points& map, double radius)
{
  Eigen::Matrix3Xd near(3, 0);
  for (const auto& p : map)
    if ((p - place).norm() <= radius) {
      near.conservativeResize(3, near.cols() + 1);
      near.rightCols<1>() = p.cast<double>();
    }
  const Eigen::Matrix3Xd d = near.colwise() - Eigen::Vector3d(near.rowwise().mean());
  const Eigen::Matrix3d S = d * d.transpose() / static_cast<double>(near.cols());
  LocalSpread spread;
  spread.points = static_cast<std::size_t>(near.cols());
  spread.entropy = 0.5 * std::log((2 * M_PI * M_E * S).determinant());
  spread.variance = pcl6d::test::smallestEigenvalue(S);
  return spread;
}

/** A square in the plane z = 0 with normal noise [m]. */
Points
plane(double sigma, std::size_t count = 4000)
{
  Random random(3);
  Points points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back(Eigen::Vector3d(random.uniform(-1, 1),
                                     random.uniform(-1, 1),
                                     sigma * random.normal())
                         .cast<float>());
  return points;
}
} // namespace

TEST(LocalSpreads, AreThoseOfTheDefinition)
{
  Random random(1);
  const Points map = pcl6d::test::randomCube(random, 3000, 4);
  const Points places = pcl6d::test::randomCube(random, 200, 4.5);
  const double radius = 0.7;
  const auto spreads = localSpreads(places, map, {radius, 10, 1});
  std::size_t compared = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const LocalSpread expected = bruteForce(places[i], map, radius);
    EXPECT_EQ(spreads[i].points, expected.points);
    if (expected.points < 10) {
      EXPECT_TRUE(std::isnan(spreads[i].entropy));
      continue;
    }
    // Sums of squares of coordinates below the radius, in float.
    EXPECT_NEAR(spreads[i].entropy, expected.entropy, 1e-4);
    EXPECT_NEAR(spreads[i].variance, expected.variance, 1e-6 * radius * radius);
    ++compared;
  }
  EXPECT_GT(compared, 100u);
}

TEST(LocalSpreads, OfANoisyPlaneKnowItsNoise)
{
  // A disc of radius r has the variance r^2 / 4 along each of its axes.
  const double sigma = 0.02, radius = 0.5;
  const auto spread = localSpreads({{0, 0, 0}}, plane(sigma, 40000), {radius})[0];
  EXPECT_NEAR(std::sqrt(spread.variance), sigma, 0.02 * sigma);
  const double det = sigma * sigma * std::pow(radius * radius / 4, 2);
  EXPECT_NEAR(spread.entropy, 0.5 * std::log(std::pow(2 * M_PI * M_E, 3) * det), 0.03);
}

TEST(LocalSpreads, OfTwoSheetsAreLargerThanOfOne)
{
  const Points sheet = plane(0.005);
  Points doubled = sheet;
  for (std::size_t i = 0; i < doubled.size(); i += 2)
    doubled[i].z() += 0.05f;
  const auto one = localSpreads({{0, 0, 0}}, sheet)[0];
  const auto two = localSpreads({{0, 0, 0}}, doubled)[0];
  EXPECT_NEAR(std::sqrt(two.variance), 0.0255, 0.002); // half of 5 cm, and the noise
  EXPECT_NEAR(two.entropy - one.entropy, std::log(0.0255 / 0.005), 0.1);
}

TEST(LocalSpreads, OfAnExactPlaneAreFinite)
{
  const auto spread = localSpreads({{0, 0, 0}}, plane(0))[0];
  EXPECT_TRUE(std::isfinite(spread.entropy));
  EXPECT_EQ(spread.variance, 1e-8);
}

TEST(LocalSpreads, DoNotDependOnThreadsOrRigidMotion)
{
  Random random(2);
  const Points map = pcl6d::test::randomCube(random, 5000, 4);
  const auto motion = pcl6d::test::randomPose(random, 3, 1);
  const auto one = localSpreads(map, map, {0.5, 10, 1});
  const auto three = localSpreads(map, map, {0.5, 10, 3});
  const Points moved = pcl6d::transformed(map, motion);
  const auto turned = localSpreads(moved, moved, {0.5, 10, 2});
  double mean = 0, mean_turned = 0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    EXPECT_TRUE(one[i].entropy == three[i].entropy ||
                (std::isnan(one[i].entropy) && std::isnan(three[i].entropy)));
    mean += std::isnan(one[i].entropy) ? 0 : one[i].entropy;
    mean_turned += std::isnan(turned[i].entropy) ? 0 : turned[i].entropy;
  }
  EXPECT_NEAR(mean / 5000, mean_turned / 5000, 1e-3);
}

TEST(LocalSpreads, LeaveOutWhatIsNotFinite)
{
  Points map = plane(0.01);
  const auto clean = localSpreads({{0, 0, 0}}, map)[0];
  map.emplace_back(kNan, 0, 0);
  map.emplace_back(0, pcl6d::test::kInfinity, 0);
  EXPECT_EQ(localSpreads({{0, 0, 0}}, map)[0].entropy, clean.entropy);
  const auto nowhere = localSpreads({{kNan, 0, 0}}, map)[0];
  EXPECT_EQ(nowhere.points, 0u);
  EXPECT_TRUE(std::isnan(nowhere.entropy));
  EXPECT_TRUE(std::isnan(localSpreads({{0, 0, 0}}, {})[0].entropy));
  EXPECT_TRUE(localSpreads({}, map).empty());
}

TEST(LocalSpreads, RefuseBrokenOptions)
{
  using pcl6d::test::badArgumentOf;
  for (const double radius : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_NE(badArgumentOf([&] { localSpreads({}, {}, {radius}); }).find("radius = "),
              std::string::npos);
  EXPECT_NE(badArgumentOf([&] {
              localSpreads({}, {}, {0.3, 3});
            }).find("min_points"),
            std::string::npos);
}
