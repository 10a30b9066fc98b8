// SPDX-License-Identifier: BSD-3-Clause
// Every exact structure gives the same answers, to the bit and the index.
#include "oracle.h"
#include "support/points.h"

#include <pcl6d/search/point_list.h>
#include <pcl6d/search/point_octree.h>
#include <pcl6d/search/point_tree.h>

#include <functional>
#include <memory>

using namespace pcl6d::test;
using pcl6d::Neighbour;
using pcl6d::Points;
using pcl6d::PointTree;
using pcl6d::Random;
using Neighbours = std::vector<Neighbour>;

namespace {
/** A structure over some points, whatever its type. */
struct Searches {
  std::function<Neighbour(const Eigen::Vector3f&, float)> nearest;
  std::function<Neighbours(const Eigen::Vector3f&, std::size_t)> nearest_k;
  std::function<Neighbours(const Eigen::Vector3f&, float, std::size_t)> within;
};

struct Structure {
  std::string name;
  std::function<Searches(const Points&)> make;
};

void
PrintTo(const Structure& structure, std::ostream* out)
{
  *out << structure.name;
}

template <typename Core>
Searches
searchesOf(std::shared_ptr<Core> core)
{
  return {[=](const auto& q, float limit_sq) { return core->nearest(q, limit_sq); },
          [=](const auto& q, std::size_t k) { return core->nearestK(q, k); },
          [=](const auto& q, float radius_sq, std::size_t max_count) {
            return core->withinRadius(q, radius_sq, max_count);
          }};
}

Searches
cachedSearches(const Points& points)
{
  const auto tree = std::make_shared<PointTree>(points, 1, PointTree::Cells::kKeep);
  Searches searches = searchesOf(tree);
  const auto leaf = std::make_shared<int>(-1); // one for all: starts are far and near
  searches.nearest = [=](const auto& q, float limit_sq) {
    return tree->nearestFrom(*leaf, q, limit_sq);
  };
  return searches;
}

Searches
approximateSearches(const Points& points)
{
  const auto tree = std::make_shared<PointTree>(points);
  Searches searches = searchesOf(tree);
  searches.nearest = [=](const auto& q, float limit_sq) {
    return tree->nearestApproximate(q, limit_sq, 0);
  };
  return searches;
}

class Structures : public testing::TestWithParam<Structure> {
protected:
  void
  expectAgreesWithOracle(const Points& points, const Points& queries) const
  {
    const Searches searches = GetParam().make(points);
    for (const auto& q : queries) {
      for (const float limit_sq : {0.01f, 1.0f, 25.0f, kInfinity}) {
        const auto expected = allWithin(points, q, limit_sq);
        EXPECT_EQ(searches.nearest(q, limit_sq).index,
                  expected.empty() ? -1 : expected[0].index);
        expectEqual(searches.within(q, limit_sq, 0), expected);
        expectEqual(searches.within(q, limit_sq, 7), firstOf(expected, 7));
        expectEqual(searches.within(q, limit_sq, 80), firstOf(expected, 80));
      }
      const auto all = allWithin(points, q, kInfinity);
      for (const std::size_t k : {std::size_t{0},
                                  std::size_t{1},
                                  std::size_t{10},
                                  points.size(),
                                  points.size() + 5})
        expectEqual(searches.nearest_k(q, k), firstOf(all, k));
    }
  }
};
} // namespace

TEST_P(Structures, AgreeOnRandomPoints)
{
  Random random(1);
  expectAgreesWithOracle(randomCube(random, 3000, 10), randomCube(random, 60, 14));
}

TEST_P(Structures, AgreeOnEveryFewPoints)
{
  Random random(6);
  for (std::size_t count = 0; count <= 20; ++count)
    expectAgreesWithOracle(randomCube(random, count, 4), randomCube(random, 20, 6));
  for (const std::size_t count : {63u, 64u, 65u, 128u, 129u, 513u})
    expectAgreesWithOracle(randomCube(random, count, 4), randomCube(random, 10, 6));
}

/** Sides of boxes from nothing at all to beyond float. */
TEST_P(Structures, AgreeOnCoordinatesOfAllSizes)
{
  Random random(15);
  for (const float size : {1e-42f, 1e-30f, 1e-20f, 1e12f, 1e18f, 3e38f}) {
    Points points = randomCube(random, 300, 2);
    for (auto& p : points)
      p *= size;
    const Points queries = firstOf(points, 10);
    points.resize(310, {1, 2, 3});
    expectAgreesWithOracle(points, queries);
  }
}

/** Sizes about those at which the shape of a tree changes. */
TEST_P(Structures, AgreeOnSizesAboutPowersOfTwo)
{
  Random random(16);
  for (const std::size_t size : {127u, 192u, 193u, 511u, 512u, 576u, 1025u, 4097u})
    expectAgreesWithOracle(randomCube(random, size, 10), randomCube(random, 5, 12));
}

TEST_P(Structures, AgreeOnTheSmallestIndexAmongManyTies)
{
  Random random(2);
  const Points points = gridWithDuplicates(random, 1000);
  expectAgreesWithOracle(points, gridWithDuplicates(random, 60));
  expectAgreesWithOracle(points, randomCube(random, 30, 10));
}

TEST_P(Structures, AgreeOnEqualPoints)
{
  expectAgreesWithOracle(Points(1000, {1, 2, 3}), {{0, 0, 0}, {1, 2, 3}, {1, 2, 4}});
}

TEST_P(Structures, AgreeOnPointsInAPlaneAndOnALine)
{
  Random random(7);
  Points points = randomCube(random, 700, 10);
  for (auto& p : points)
    p.z() = 1;
  expectAgreesWithOracle(points, randomCube(random, 30, 12));
  for (auto& p : points)
    p.y() = -2;
  expectAgreesWithOracle(points, randomCube(random, 30, 12));
}

TEST_P(Structures, AgreeFarFromTheOrigin)
{
  Random random(
      8); // 1e6 m: floats stand 6 cm apart, so that many coordinates are equal
  Points points = randomCube(random, 1000, 10), queries = randomCube(random, 30, 12);
  for (auto* set : {&points, &queries})
    for (auto& p : *set)
      p += Eigen::Vector3f(1e6f, -1e6f, 1e6f);
  expectAgreesWithOracle(points, queries);
}

TEST_P(Structures, LeaveOutPointsThatAreNotFinite)
{
  Random random(9);
  Points points = randomCube(random, 200, 10);
  for (std::size_t i = 0; i < points.size(); i += 3)
    points[i][i % 3] = i % 2 ? kNan : (i % 4 ? kInfinity : -kInfinity);
  expectAgreesWithOracle(points, randomCube(random, 30, 12));
  expectAgreesWithOracle(Points(5, {kNan, 0, 0}), {{0, 0, 0}});
}

TEST_P(Structures, FindNothingForAQueryThatIsNotFinite)
{
  const Searches searches = GetParam().make(Points(30, {1, 0, 0}));
  for (const float bad : {kNan, kInfinity, -kInfinity}) {
    EXPECT_EQ(searches.nearest({bad, 0, 0}, kInfinity).index, -1);
    EXPECT_TRUE(searches.nearest_k({0, bad, 0}, 3).empty());
    EXPECT_TRUE(searches.within({0, 0, bad}, kInfinity, 0).empty());
  }
}

TEST_P(Structures, LeaveOutAPointExactlyAtTheLimit)
{
  const Searches searches = GetParam().make({{1, 0, 0}, {0, 1, 0}, {0, 0, 3}});
  EXPECT_EQ(searches.nearest({0, 0, 0}, 1.0f).index, -1);
  EXPECT_EQ(searches.nearest({0, 0, 0}, 1.0001f).index, 0);
  EXPECT_TRUE(searches.within({0, 0, 0}, 1.0f, 0).empty());
  EXPECT_EQ(searches.within({0, 0, 0}, 9.0f, 0).size(), 2u);
  EXPECT_EQ(searches.nearest({1, 0, 0}, 0.0f).index, -1);
  EXPECT_EQ(searches.nearest({1, 0, 0}, 1e-30f).index, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Search,
    Structures,
    testing::Values(Structure{"PointTree",
                              [](const Points& p) {
                                return searchesOf(std::make_shared<PointTree>(p));
                              }},
                    Structure{"Cached", cachedSearches},
                    Structure{"ApproximateWithEpsilonZero", approximateSearches},
                    Structure{"PointOctree",
                              [](const Points& p) {
                                return searchesOf(
                                    std::make_shared<pcl6d::PointOctree>(p));
                              }},
                    Structure{"PointList",
                              [](const Points& p) {
                                return searchesOf(
                                    std::make_shared<pcl6d::PointList>(p));
                              }}),
    [](const auto& tested) { return tested.param.name; });
