// SPDX-License-Identifier: BSD-3-Clause
// More than the nearest point, against looking at every point.
#include "oracle.h"
#include "support/points.h"

#include <pcl6d/search/point_tree.h>

#include <array>

using namespace pcl6d::test;
using pcl6d::distanceSq;
using pcl6d::Neighbour;
using pcl6d::Points;
using pcl6d::PointTree;
using pcl6d::Random;
using pcl6d::TwoNearest;

namespace {
TwoNearest
upTo(float limit_sq)
{
  return {{-1, limit_sq}, limit_sq};
}

/** The oracle: takes the points one by one. */
bool
improveTwoByAll(const Points& points,
                const Eigen::Vector3f& query,
                TwoNearest& best,
                int own_candidate = -1)
{
  const TwoNearest before = best;
  for (const auto& found : allWithin(points, query, kInfinity)) { // sorted
    if (found.index == own_candidate)
      continue;
    const bool own = best.nearest.index >= 0 && own_candidate >= 0;
    const bool nearer =
        own ? found < best.nearest : found.distance_sq < best.nearest.distance_sq;
    if (!nearer) {
      best.second_sq = std::min(best.second_sq, found.distance_sq);
      continue;
    }
    if (best.nearest.index >= 0)
      best.second_sq = std::min(best.second_sq, best.nearest.distance_sq);
    best.nearest = found;
    own_candidate = found.index;
  }
  return best.nearest.index != before.nearest.index ||
         best.nearest.distance_sq != before.nearest.distance_sq;
}

void
expectEqual(const TwoNearest& found, const TwoNearest& expected)
{
  EXPECT_EQ(found.nearest.index, expected.nearest.index);
  EXPECT_EQ(found.nearest.distance_sq, expected.nearest.distance_sq);
  EXPECT_EQ(found.second_sq, expected.second_sq);
}

/** Clouds of all kinds, each with queries: random, ties, pairs in one place, few. */
std::vector<std::pair<Points, Points>>
cloudsWithQueries()
{
  Random random(21);
  std::vector<std::pair<Points, Points>> all;
  all.emplace_back(randomCube(random, 3000, 10), randomCube(random, 100, 14));
  all.emplace_back(gridWithDuplicates(random, 1000), gridWithDuplicates(random, 60));
  all.emplace_back(gridWithDuplicates(random, 90), gridWithDuplicates(random, 60));
  Points pairs = randomCube(random, 300, 10);
  pairs.insert(pairs.end(), pairs.rbegin(), pairs.rend());
  all.emplace_back(pairs, pairs);
  all.emplace_back(Points(40, {1, 2, 3}), gridWithDuplicates(random, 10));
  for (std::size_t count = 0; count <= 18; ++count)
    all.emplace_back(randomCube(random, count, 4), randomCube(random, 20, 6));
  return all;
}
} // namespace

TEST(TwoNearest, AreThoseOfAllPoints)
{
  for (const auto& [points, queries] : cloudsWithQueries()) {
    const PointTree tree(points);
    for (const auto& q : queries)
      for (const float limit_sq : {0.0f, 0.3f, 1.0f, 3.0f, kInfinity}) {
        TwoNearest found = upTo(limit_sq), expected = found;
        EXPECT_EQ(tree.improveTwo(q, found), improveTwoByAll(points, q, expected));
        expectEqual(found, expected);
      }
  }
}

/** A point beyond the limit of the nearest still tells how near any point comes. */
TEST(TwoNearest, MayHaveLimitsOfTheirOwn)
{
  for (const auto& [points, queries] : cloudsWithQueries()) {
    const PointTree tree(points);
    for (const auto& q : queries) {
      TwoNearest found{{-1, 0.5f}, 4.0f}, expected = found;
      EXPECT_EQ(tree.improveTwo(q, found), improveTwoByAll(points, q, expected));
      expectEqual(found, expected);
    }
  }
}

/** Whichever of its points the tree is handed, it is not its own second. */
TEST(TwoNearest, AreTheSameFromEachOfTheTreesOwnPoints)
{
  for (const auto& [points, queries] : cloudsWithQueries()) {
    const PointTree tree(points);
    for (std::size_t i = 0; i < std::min<std::size_t>(queries.size(), 20); ++i) {
      TwoNearest expected = upTo(kInfinity);
      improveTwoByAll(points, queries[i], expected);
      const std::size_t step = points.size() / 50 + 1;
      for (std::size_t candidate = 0; candidate < points.size(); candidate += step) {
        const int index = static_cast<int>(candidate);
        TwoNearest found{{index, distanceSq(queries[i], points[candidate])}, kInfinity};
        EXPECT_EQ(tree.improveTwo(queries[i], found, index),
                  expected.nearest.index != index);
        expectEqual(found, expected);
      }
      if (expected.nearest.index >= 0) {
        TwoNearest found{expected.nearest, kInfinity};
        EXPECT_FALSE(tree.improveTwo(queries[i], found, expected.nearest.index));
        expectEqual(found, expected);
      }
    }
  }
}

TEST(TwoNearest, KeepACandidateFromElsewhereThatIsEquallyNear)
{
  const PointTree tree(Points{{1, 0, 0}, {0, 2, 0}});
  TwoNearest best{{7, 1.0f}, 9.0f};
  EXPECT_FALSE(tree.improveTwo({0, 0, 0}, best));
  expectEqual(best, {{7, 1.0f}, 1.0f});
  best = {{7, 1.5f}, 9.0f};
  EXPECT_TRUE(tree.improveTwo({0, 0, 0}, best));
  expectEqual(best, {{0, 1.0f}, 1.5f});
}

/** Distances of a chain are those of the union, wherever it starts. */
TEST(TwoNearest, OfAChainOfTreesAreThoseOfTheUnion)
{
  Random random(22);
  for (const bool ties : {false, true}) {
    std::array<Points, 4> parts; // the third is empty
    Points all;
    for (const int i : {0, 1, 3}) {
      parts[i] = ties ? gridWithDuplicates(random, 70) : randomCube(random, 800, 10);
      all.insert(all.end(), parts[i].begin(), parts[i].end());
    }
    const std::array<PointTree, 4> trees{PointTree(parts[0]),
                                         PointTree(parts[1]),
                                         PointTree(parts[2]),
                                         PointTree(parts[3])};
    for (const auto& q : randomCube(random, 200, 12))
      for (const float limit_sq : {0.5f, 2.0f, kInfinity}) {
        TwoNearest expected = upTo(limit_sq);
        improveTwoByAll(all, q, expected);
        for (std::size_t start = 0; start < 4; ++start) {
          TwoNearest best = upTo(limit_sq);
          const Points* owner = nullptr;
          for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t part = (start + i) % 4;
            if (trees[part].improveTwo(q, best))
              owner = &parts[part];
          }
          EXPECT_EQ(best.second_sq, expected.second_sq);
          EXPECT_EQ(best.nearest.distance_sq, expected.nearest.distance_sq);
          ASSERT_EQ(owner == nullptr, expected.nearest.index < 0);
          if (owner != nullptr) {
            EXPECT_EQ(distanceSq(q, (*owner)[best.nearest.index]),
                      best.nearest.distance_sq);
          }
        }
      }
  }
}

/** What they are for: a query that moved little keeps its neighbour. */
TEST(TwoNearest, TellHowFarAQueryMayMove)
{
  Random random(23);
  const Points points = randomCube(random, 2000, 10);
  const PointTree tree(points);
  int kept = 0;
  for (const auto& q : randomCube(random, 200, 10)) {
    TwoNearest best = upTo(kInfinity);
    tree.improveTwo(q, best);
    const float reach =
        (std::sqrt(best.second_sq) - std::sqrt(best.nearest.distance_sq)) / 2;
    for (const auto& direction : randomCube(random, 5, 2)) {
      const Eigen::Vector3f moved = q + 0.999f * reach * direction.normalized();
      EXPECT_EQ(tree.nearest(moved, kInfinity).index, best.nearest.index);
      const Eigen::Vector3f far = q + 30 * reach * direction.normalized();
      kept += tree.nearest(far, kInfinity).index == best.nearest.index;
    }
  }
  EXPECT_LT(kept, 500) << "far moves seldom change the neighbour: little was tested";
}

TEST(TwoNearest, OfABadQueryOrNoPointsStay)
{
  const Points points{{1, 2, 3}, {kNan, 0, 0}, {1, 2, 3}};
  for (const float bad : {kNan, kInfinity}) {
    TwoNearest best{{7, 1.0f}, 2.0f};
    EXPECT_FALSE(PointTree(points).improveTwo({0, bad, 0}, best));
    expectEqual(best, {{7, 1.0f}, 2.0f});
  }
  for (const PointTree& none : {PointTree(), PointTree(Points(3, {0, kNan, 0}))}) {
    TwoNearest best{{7, 1.0f}, 2.0f};
    EXPECT_FALSE(none.improveTwo({0, 0, 0}, best));
    expectEqual(best, {{7, 1.0f}, 2.0f});
  }
  TwoNearest best = upTo(kInfinity); // the point with NaN is not the second
  EXPECT_TRUE(PointTree(points).improveTwo({1, 2, 4}, best));
  expectEqual(best, {{0, 1.0f}, 1.0f});
}

TEST(NearestK, IntoAnArrayAreTheFirstOfAllPoints)
{
  for (const auto& [points, queries] : cloudsWithQueries()) {
    const PointTree tree(points);
    for (const auto& q : queries) {
      const auto all = allWithin(points, q, kInfinity);
      for (const std::size_t k : {0u,
                                  1u,
                                  2u,
                                  7u,
                                  8u,
                                  9u,
                                  10u,
                                  12u,
                                  13u,
                                  20u,
                                  21u,
                                  32u,
                                  33u,
                                  64u,
                                  65u,
                                  200u}) {
        const Neighbour untouched{-7, -7};
        std::vector<Neighbour> found(k + 1, untouched);
        const std::size_t count = tree.nearestK(q, k, found.data());
        EXPECT_EQ(found[k].index, untouched.index) << "wrote behind the end";
        found.resize(count);
        expectEqual(found, firstOf(all, k));
      }
    }
  }
}

TEST(NearestK, IntoAnArrayAreNoneForABadQuery)
{
  Neighbour out[3] = {};
  EXPECT_EQ(PointTree(Points(5, {0, 0, 0})).nearestK({0, kNan, 0}, 3, out), 0u);
  EXPECT_EQ(PointTree().nearestK({0, 0, 0}, 3, out), 0u);
  EXPECT_EQ(out[0].index, -1);
}
