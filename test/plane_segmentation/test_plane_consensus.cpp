// SPDX-License-Identifier: BSD-3-Clause
#include "plane_scenes.h"

#include <pcl6d/common/error.h>
#include <pcl6d/plane_segmentation/plane_consensus.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {
using namespace pcl6d;

ConsensusPoints
packed(const Points& points)
{
  ConsensusPoints result(points.size());
  for (const auto& p : points)
    result.add(p.x(), p.y(), p.z());
  return result;
}

/** A plane with so many points, in a cube of others, evenly by chance. */
Points
planeInClutter(std::size_t on_plane, std::size_t others, double noise, Random& random)
{
  Points points;
  test::addRectangle(
      points, {-1, -1, 0.25}, {2, 0, 0.3}, {0, 2, 0}, on_plane, noise, random);
  for (std::size_t i = 0; i < others; ++i)
    points.emplace_back(
        random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  return points;
}

/** \return the most points nearer than a limit to a plane through three of them */
std::size_t
mostByAllTriples(const Points& points, double limit)
{
  std::size_t most = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        const Eigen::Vector3f p = points[i];
        const Eigen::Vector3f normal =
            (points[j] - p).cross(points[k] - p).normalized();
        most = std::max<std::size_t>(
            most, std::count_if(points.begin(), points.end(), [&](const auto& q) {
              return std::abs(normal.dot(q - p)) < static_cast<float>(limit);
            }));
      }
  return most;
}

std::size_t
countOn(const Points& points, const PlaneConsensus& plane, double limit)
{
  return static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [&](const auto& p) {
        return std::abs(plane.distance(p.template cast<double>())) < limit;
      }));
}

void
expectSame(const PlaneConsensus& a, const PlaneConsensus& b)
{
  EXPECT_EQ(a.inliers, b.inliers);
  EXPECT_EQ(a.normal, b.normal); // to the last bit
  EXPECT_EQ(a.offset, b.offset);
  EXPECT_EQ(a.draws, b.draws);
  EXPECT_EQ(a.sample, b.sample);
}
} // namespace

TEST(PlaneConsensus, FindsAsManyPointsAsTheBestOfAllTriples)
{
  constexpr double kLimit = 0.05; // [m]
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Points points = planeInClutter(30, 70, 0.03, random);
    PlaneConsensusOptions options;
    options.max_distance = kLimit;
    options.max_iterations = 1000;
    options.probability = 1; // all the effort
    options.refine = false;
    const auto found = findPlaneConsensus(packed(points), options);
    ASSERT_EQ(found.status, Status::kOk);
    EXPECT_GE(found.inliers.size(), mostByAllTriples(points, kLimit));
    EXPECT_EQ(found.inliers.size(), countOn(points, found, kLimit));
  }
}

TEST(PlaneConsensus, FindsTheLargestOfManyPlanes)
{
  // Six faces of a cube with 10 % of the points each, one with 12 % and clutter: a
  // draw is on the largest once in 579.
  Points points = test::noisyCube(4, 5000, 0.005, 1);
  Random random(2);
  test::addRectangle(points, {-2, -2, 0.5}, {4, 0, 0}, {0, 4, 1}, 6000, 0.005, random);
  for (int i = 0; i < 14000; ++i)
    points.emplace_back(
        random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3));
  PlaneConsensusOptions options;
  options.max_distance = 0.02;
  std::size_t right = 0;
  for (options.seed = 1; options.seed <= 20; ++options.seed) {
    const auto found = findPlaneConsensus(packed(points), options);
    const Eigen::Vector3d truth = Eigen::Vector3d(0, -1, 4).normalized();
    if (std::abs(found.normal.dot(truth)) > 1 - 1e-5)
      ++right;
  }
  EXPECT_GE(right, 19u); // the probability is 0.99 each
}

TEST(PlaneConsensus, IsExactOnExactPoints)
{
  Random random(3);
  Points points;
  const Eigen::Vector3d normal = Eigen::Vector3d(1, 2, 3).normalized();
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d p(random.uniform(), random.uniform(), random.uniform());
    points.push_back((p - (normal.dot(p) - 0.7) * normal).cast<float>());
  }
  const auto found = findPlaneConsensus(packed(points));
  ASSERT_EQ(found.inliers.size(), points.size());
  // Half an ulp of a coordinate below 2, as an angle over a metre.
  EXPECT_LT(found.normal.cross(normal).norm(), 6e-8);
  EXPECT_NEAR(std::abs(found.offset), 0.7, 6e-8);
}

TEST(PlaneConsensus, IsTheSameFarFromTheOrigin)
{
  // Coordinates are multiples of 2^-8 m, which single floats hold at 2^15 m as well.
  Random random(4);
  Points points = planeInClutter(3000, 2000, 0.004, random), far;
  for (auto& p : points)
    for (auto& value : p)
      value = std::round(value * 256) / 256;
  const Eigen::Vector3f shift(32768, 16384, -8192);
  for (const auto& p : points)
    far.push_back(p + shift);
  const auto here = findPlaneConsensus(packed(points));
  const auto there = findPlaneConsensus(packed(far));
  EXPECT_EQ(here.inliers, there.inliers);
  EXPECT_LT((here.normal - there.normal).norm(), 1e-12);
  EXPECT_NEAR(there.distance(shift.cast<double>()), -here.offset, 1e-9);
}

TEST(PlaneConsensus, HasTheSameBitsForAnyNumberOfThreads)
{
  Random random(5);
  const Points points = planeInClutter(6000, 60000, 0.02, random);
  for (const auto criterion : {ConsensusCriterion::kMostPoints,
                               ConsensusCriterion::kTruncatedSquares,
                               ConsensusCriterion::kLeastMedian}) {
    PlaneConsensusOptions options;
    options.criterion = criterion;
    const auto one = findPlaneConsensus(packed(points), options);
    for (const unsigned threads : {2u, 3u, 0u}) {
      options.num_threads = threads;
      expectSame(one, findPlaneConsensus(packed(points), options));
    }
  }
}

TEST(PlaneConsensus, TurnsWithThePoints)
{
  Random random(6);
  const Points points = planeInClutter(4000, 4000, 0.005, random);
  const Eigen::Isometry3d motion(
      Eigen::Translation3d(3, -2, 1) *
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()));
  const auto before = findPlaneConsensus(packed(points));
  const auto after = findPlaneConsensus(packed(transformed(points, motion)));
  const Eigen::Vector3d turned = motion.linear() * before.normal;
  // Points at the limit change sides by rounding; each moves the fit by limit / count.
  EXPECT_LT(after.normal.cross(turned).norm(), 1e-3);
  EXPECT_NEAR(static_cast<double>(after.inliers.size()),
              static_cast<double>(before.inliers.size()),
              0.005 * 4000);
}

TEST(PlaneConsensus, WeighsSquaresWhereTheyAreAskedFor)
{
  // Two planes: one with more points, spread over the slab, one with fewer that are
  // exact.
  Random random(7);
  Points points;
  test::addRectangle(points, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 1000, 0.049, random);
  test::addRectangle(points, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, 900, 0.001, random);
  PlaneConsensusOptions options;
  options.max_distance = 0.05;
  const auto most = findPlaneConsensus(packed(points), options);
  EXPECT_GT(std::abs(most.normal.z()), 0.99);
  options.criterion = ConsensusCriterion::kTruncatedSquares;
  const auto closest = findPlaneConsensus(packed(points), options);
  EXPECT_GT(std::abs(closest.normal.y()), 0.99);
}

TEST(PlaneConsensus, FindsTheLeastMedianWithoutItsThreshold)
{
  Random random(8);
  const Points points = planeInClutter(700, 300, 0.002, random);
  PlaneConsensusOptions options;
  options.criterion = ConsensusCriterion::kLeastMedian;
  options.max_distance = 1; // says who is an inlier, not which plane
  const auto found = findPlaneConsensus(packed(points), options);
  ASSERT_EQ(found.status, Status::kOk);
  const Eigen::Vector3d truth = Eigen::Vector3d(-0.3, 0, 2).normalized();
  EXPECT_LT(found.normal.cross(truth).norm(), 2e-3);
}

TEST(PlaneConsensus, KeepsDirectionsWithinTheirLimit)
{
  Random random(9);
  Points points; // a floor that slopes by 0.2 rad, and half as many points on a wall
  test::addRectangle(points, {-1, -1, 0}, {2, 0, 0.4054}, {0, 2, 0}, 2000, 0, random);
  test::addRectangle(points, {1.5, -1, -1}, {0, 2, 0}, {0, 0, 2}, 1000, 0, random);
  PlaneConsensusOptions options;
  for (const double most : {0.01, 0.1, 0.25}) {
    options.direction = DirectionLimit{Eigen::Vector3d(0, 0, -7), 0, most};
    const auto found = findPlaneConsensus(packed(points), options);
    const double angle = std::acos(std::min(1.0, std::abs(found.normal.z())));
    EXPECT_LE(angle, most);
    EXPECT_GE(found.inliers.size(), most > 0.2 ? 2000u : 200u);
  }
  options.direction =
      DirectionLimit{Eigen::Vector3d::UnitZ(), M_PI / 2 - 0.05, M_PI / 2};
  const auto wall = findPlaneConsensus(packed(points), options);
  EXPECT_GT(std::abs(wall.normal.x()), std::cos(0.05));
  EXPECT_GE(wall.inliers.size(), 1000u);
}

TEST(PlaneConsensus, CountsNormalsByTheirWeight)
{
  // Two layers of one plane; the normals of the larger one contradict it.
  Random random(10);
  Points points;
  test::addRectangle(points, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 2000, 0.001, random);
  test::addRectangle(points, {-1, 1.5, -1}, {2, 0, 0}, {0, 0, 2}, 1000, 0.001, random);
  for (const float weight : {0.0f, 0.5f}) {
    ConsensusPoints with(points.size(), true);
    for (std::size_t i = 0; i < points.size(); ++i)
      with.add(points[i], {0, 3, 0}, weight);
    PlaneConsensusOptions options;
    options.max_distance = 0.05;
    const auto found = findPlaneConsensus(std::move(with), options);
    EXPECT_GE(found.inliers.size(), weight > 0 ? 1000u : 2000u);
    EXPECT_GT(std::abs(weight > 0 ? found.normal.y() : found.normal.z()), 0.99);
  }
}

TEST(PlaneConsensus, LeavesOutWhatIsNotFinite)
{
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Random random(11);
  Points points = planeInClutter(300, 0, 0, random);
  points.insert(points.begin(), {kNan, 0, 0});
  points.insert(points.begin() + 100, {0, kInfinity, 0});
  points.emplace_back(0, 0, -kInfinity);
  const auto found = findPlaneConsensus(packed(points));
  ASSERT_EQ(found.inliers.size(), 300u);
  EXPECT_EQ(found.inliers.front(), 1u);
  EXPECT_EQ(found.inliers.back(), 301u);
  EXPECT_TRUE(std::is_sorted(found.inliers.begin(), found.inliers.end()));
}

TEST(PlaneConsensus, SaysWhatHasNoPlane)
{
  EXPECT_EQ(findPlaneConsensus(packed({})).status, Status::kTooFewPairs);
  EXPECT_EQ(findPlaneConsensus(packed({{0, 0, 0}, {1, 0, 0}})).status,
            Status::kTooFewPairs);
  Points line, place;
  for (int i = 0; i < 100; ++i) {
    line.emplace_back(0.1f * static_cast<float>(i), 0, 5);
    place.emplace_back(1, 2, 3);
  }
  for (const auto& points : {line, place}) {
    const auto none = findPlaneConsensus(packed(points));
    EXPECT_EQ(none.status, Status::kRankDeficient);
    EXPECT_TRUE(none.inliers.empty());
  }
  const auto three = findPlaneConsensus(packed({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}));
  EXPECT_EQ(three.status, Status::kOk);
  EXPECT_EQ(three.inliers.size(), 3u);
}

TEST(PlaneConsensus, TellsWhichOptionIsWrong)
{
  const auto refuse = [](auto change) {
    PlaneConsensusOptions options;
    change(options);
    EXPECT_THROW(findPlaneConsensus(packed({}), options), BadArgument);
  };
  refuse([](auto& o) { o.max_distance = 0; });
  refuse([](auto& o) { o.max_distance = std::nan(""); });
  refuse([](auto& o) { o.probability = 1.1; });
  refuse([](auto& o) { o.max_iterations = 0; });
  refuse([](auto& o) { o.direction = DirectionLimit{Eigen::Vector3d::Zero(), 0, 1}; });
  refuse([](auto& o) {
    o.direction = DirectionLimit{Eigen::Vector3d::UnitX(), 1, 0.5};
  });
  refuse([](auto& o) { o.direction = DirectionLimit{Eigen::Vector3d::UnitX(), 0, 2}; });
}
