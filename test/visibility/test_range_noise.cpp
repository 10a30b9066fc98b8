// SPDX-License-Identifier: BSD-3-Clause
#include "support/points.h"
#include "support/room.h"

#include <pcl6d/visibility/range_noise.h>

#include <algorithm>

using pcl6d::Points;
using pcl6d::Random;
using pcl6d::rangeNoise;
using pcl6d::test::kNan;

namespace {
/** \return points on a square at a slant, at random places whose mean distance is the
 * spacing [m], with normal noise across it [m] */
Points
plane(double spacing, double sigma, std::size_t count = 20000, std::uint64_t seed = 1)
{
  Random random(seed);
  const double half = spacing * std::sqrt(static_cast<double>(count)) / 2;
  const Eigen::Matrix3d R = pcl6d::test::randomRotation(random, 1);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d p(random.uniform(-half, half),
                            random.uniform(-half, half),
                            sigma * random.normal());
    points.push_back((R * p + Eigen::Vector3d(3, 2, 1)).cast<float>());
  }
  return points;
}

/** \return a scan of a room of 12 x 8 x 3 m: 16 rows, 2 degrees apart, of dense points,
 * with normal noise of the ranges [m] */
Points
scanLines(double step, double sigma)
{
  const pcl6d::test::PillarRoom room;
  Random random(3);
  Points points;
  for (int row = 0; row < 16; ++row)
    for (double turn = 0; turn < 2 * M_PI; turn += step) {
      const double up = (2 * row - 15) * M_PI / 180;
      const Eigen::Vector3d ray(
          std::cos(up) * std::cos(turn), std::cos(up) * std::sin(turn), std::sin(up));
      const double range =
          room.range(Eigen::Vector3d::Zero(), ray) + sigma * random.normal();
      points.push_back((range * ray).cast<float>());
    }
  return points;
}
} // namespace

TEST(RangeNoise, IsThatOfAPlane)
{
  // Up to 2 spacings: a patch of 48 points would be a ball cut out of the noise.
  for (const double sigma : {0.002, 0.005, 0.01, 0.02, 0.05})
    for (const double spacing : {0.5 * sigma, sigma, 3 * sigma, 0.1, 0.3})
      EXPECT_NEAR(rangeNoise(plane(spacing, sigma)), sigma, 0.25 * sigma)
          << "spacing " << spacing;
}

TEST(RangeNoise, IsNoneOnAPlaneWithoutNoise)
{
  EXPECT_LT(rangeNoise(plane(0.02, 0)), 1e-6) << "rounding of float";
}

TEST(RangeNoise, IsThatOfTheSurfacesOfARoom)
{
  Random random(2);
  for (const double sigma : {0.005, 0.02})
    EXPECT_NEAR(rangeNoise(pcl6d::test::roomCorner(random, 30000, 5, sigma)),
                sigma,
                0.25 * sigma);
}

TEST(RangeNoise, IsSeenOnScanLines)
{
  // Neighbours are of one line, as its points are 1 to 40 mm apart. Noise across a slanted
  // surface is less than along the ray.
  for (const double step : {0.0005, 0.002, 0.008})
    for (const double sigma : {0.005, 0.01, 0.02}) {
      const double noise = rangeNoise(scanLines(step, sigma));
      EXPECT_GT(noise, 0.4 * sigma) << step;
      EXPECT_LT(noise, 1.25 * sigma) << step;
    }
}

TEST(RangeNoise, GrowsWithTheScale)
{
  const Points points = plane(0.02, 0.01);
  const double noise = rangeNoise(points);
  for (const float scale : {0.01F, 100.0F, 1024.0F}) {
    Points scaled = points;
    for (auto& p : scaled)
      p *= scale;
    EXPECT_NEAR(rangeNoise(scaled), scale * noise, 1e-3 * scale * noise);
  }
}

TEST(RangeNoise, DoesNotDependOnThePose)
{
  const Points points = plane(0.02, 0.01);
  Random random(9);
  const auto moved =
      pcl6d::transformed(points, pcl6d::test::randomPose(random, 5, 2.5));
  EXPECT_NEAR(rangeNoise(moved), rangeNoise(points), 1e-3 * rangeNoise(points));
}

TEST(RangeNoise, DoesNotSeePointsThatAreNotFinite)
{
  const Points points = plane(0.02, 0.01);
  Points spoilt(300000, {kNan, kNan, kNan}); // the sky, in the first rows of the scan
  spoilt.insert(spoilt.end(), points.begin(), points.end());
  EXPECT_EQ(rangeNoise(spoilt), rangeNoise(points));
}

TEST(RangeNoise, IsZeroWithoutASurface)
{
  EXPECT_EQ(rangeNoise({}), 0);
  EXPECT_EQ(rangeNoise({{1, 2, 3}}), 0);
  EXPECT_EQ(rangeNoise(plane(0.02, 0.01, 47)), 0) << "fewer than 48 points";
  EXPECT_GT(rangeNoise(plane(0.02, 0.01, 48)), 0);
  EXPECT_EQ(rangeNoise(Points(100, {kNan, 0, 0})), 0);
  EXPECT_EQ(rangeNoise(Points(100, {1, 2, 3})), 0) << "one place";
  Points line;
  for (int i = 0; i < 5000; ++i)
    line.push_back({0.01F * static_cast<float>(i), 1, 2});
  EXPECT_EQ(rangeNoise(line), 0);
}
