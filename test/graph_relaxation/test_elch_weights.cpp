// SPDX-License-Identifier: BSD-3-Clause
#include "graph_relaxation/elch_oracle.h"
#include "support/points.h"

#include <pcl6d/common/random.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::test {

namespace {
constexpr double kTol = 1e-12; // of a weight: rounding along the path

void
expectWeights(const std::vector<double>& found, const std::vector<double>& expected)
{
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], kTol) << "vertex " << i;
}

/** A chain with more edges between any two of its vertices. */
std::vector<WeightedEdge>
randomGraph(Random& random, std::size_t n, std::size_t more)
{
  const auto any = [&] { return static_cast<std::size_t>(random.uniform() * n); };
  std::vector<WeightedEdge> edges;
  for (std::size_t i = 1; i < n; ++i)
    edges.push_back({i - 1, i, random.uniform(0.1, 3)});
  while (edges.size() < n - 1 + more) {
    const std::size_t a = any(), b = any();
    if (a != b)
      edges.push_back({a, b, random.uniform(0.1, 3)});
  }
  return edges;
}
} // namespace

TEST(ElchWeights, AreThoseOfThePaperOnAChainWithABranch)
{
  // 0 - 1 - 2 - 3 - 4 with costs 1, 3, 2, 1; 5 hangs on 1.
  expectWeights(
      elchWeights(6, {{0, 1, 1}, {1, 2, 3}, {2, 3, 2}, {3, 4, 1}, {1, 5, 2.5}}, 0, 4),
      {0, 1. / 7, 4. / 7, 6. / 7, 1, 1. / 7});
}

TEST(ElchWeights, AreThoseOfThePaperOnTwoAlternativePaths)
{
  std::vector<WeightedEdge> edges;
  for (std::size_t i = 1; i < 8; ++i)
    edges.push_back({i - 1, i, 1});
  edges.push_back({2, 6, 1});
  expectWeights(elchWeights(8, edges, 0, 7),
                {0, 1. / 4, 1. / 2, 9. / 16, 10. / 16, 11. / 16, 3. / 4, 1});
}

TEST(ElchWeights, AgreeWithThePlainAlgorithmOnRandomGraphs)
{
  Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(trial);
    const std::size_t n = 4 + trial % 20;
    auto edges = randomGraph(random, n, trial % 25);
    for (int cut = 0; cut < trial % 3; ++cut) // parts that hang by nothing
      edges.erase(edges.begin() + trial % edges.size());
    const std::size_t first = trial % n, last = (first + 1 + trial % (n - 1)) % n;
    const auto found = elchWeights(n, edges, first, last);
    if (!found.empty())
      expectWeights(found, ElchOracle(n, edges).weights(first, last));
  }
}

TEST(ElchWeights, DoNotDependOnTheOrderOfEdgesOrTheUnitOfCosts)
{
  Random random(2);
  auto edges = randomGraph(random, 30, 20);
  const auto expected = elchWeights(30, edges, 3, 27);
  std::reverse(edges.begin(), edges.end());
  for (auto& edge : edges) {
    std::swap(edge.a, edge.b);
    edge.cost *= 1e-9;
  }
  expectWeights(elchWeights(30, edges, 3, 27), expected);
}

TEST(ElchWeights, ComplementEachOtherWhenTheLoopIsTurnedAround)
{
  Random random(3);
  const auto edges = randomGraph(random, 40, 25);
  const auto forth = elchWeights(40, edges, 0, 39);
  auto back = elchWeights(40, edges, 39, 0);
  for (double& w : back)
    w = 1 - w;
  expectWeights(back, forth);
}

TEST(ElchWeights, OfACycleThatHangsOnOneVertexAreThatVertex)
{
  // 3, 4, 5 are a cycle with 1; 6 hangs on 4; 7 and 8 on nothing.
  const auto weights = elchWeights(
      9, {{0, 1}, {1, 2}, {1, 3}, {3, 4}, {4, 5}, {5, 1}, {4, 6}, {7, 8}}, 0, 2);
  expectWeights(weights, {0, 0.5, 1, 0.5, 0.5, 0.5, 0.5, 0, 0});
}

TEST(ElchWeights, GiveNothingToEdgesWithoutCost)
{
  expectWeights(elchWeights(4, {{0, 1, 2}, {1, 2, 0}, {2, 3, 2}}, 0, 3),
                {0, 0.5, 0.5, 1});
  // All without cost: the same for each.
  expectWeights(elchWeights(3, {{0, 1, 0}, {1, 2, 0}}, 0, 2), {0, 0.5, 1});
}

TEST(ElchWeights, StayFiniteForCostsOfAnySize)
{
  for (const double cost : {1e-308, 1e-30, 1e30, 1.7e308}) {
    expectWeights(elchWeights(4, {{0, 1, cost}, {1, 2, 0}, {2, 3, cost}}, 0, 3),
                  {0, 0.5, 0.5, 1});
    const auto mixed = elchWeights(
        5, {{0, 1, cost}, {1, 2, 1}, {2, 3, 0}, {3, 4, 1}, {1, 4, 1}}, 0, 4);
    for (const double w : mixed)
      EXPECT_TRUE(w >= 0 && w <= 1) << w;
  }
}

TEST(ElchWeights, StayInRangeWhereRoundingSwallowsCosts)
{
  Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    auto edges = randomGraph(random, 25, 30);
    for (auto& edge : edges)
      edge.cost = random.uniform() < 0.4   ? 0
                  : random.uniform() < 0.3 ? 1e12
                                           : edge.cost;
    const auto weights = elchWeights(25, edges, 0, 24);
    ASSERT_EQ(weights.size(), 25u);
    for (const double w : weights)
      ASSERT_TRUE(w >= 0 && w <= 1) << w;
  }
}

TEST(ElchWeights, OfABranchAreThoseOfItsRootEvenIfRoundingSwallowsTheWayThere)
{
  // 2 lies between 0 and 1, all without cost; 3 hangs on 2 by a cost of 1e12.
  expectWeights(elchWeights(5, {{0, 2, 0}, {2, 1, 0}, {2, 3, 1e12}, {3, 4, 1}}, 0, 1),
                {0, 1, 0.5, 0.5, 0.5});
}

TEST(ElchWeights, CountTheCheapestOfSeveralEdgesBetweenTwoVertices)
{
  expectWeights(elchWeights(3, {{0, 1, 9}, {0, 1, 1}, {1, 2, 3}, {2, 1, 7}}, 0, 2),
                {0, 0.25, 1});
}

TEST(ElchWeights, AreNoneWhereNothingJoinsFirstAndLast)
{
  EXPECT_TRUE(elchWeights(4, {{0, 1}, {2, 3}}, 0, 3).empty());
  EXPECT_TRUE(elchWeights(2, {}, 0, 1).empty());
  EXPECT_EQ(elchWeights(2, {{0, 1}}, 0, 1), (std::vector<double>{0, 1}));
}

TEST(ElchWeights, RefuseWhatIsNoGraph)
{
  const auto message =
      [](std::size_t n, std::vector<WeightedEdge> edges, std::size_t last) {
        return badArgumentOf([&] { elchWeights(n, edges, 0, last); });
      };
  EXPECT_EQ(message(0, {}, 0), "first = 0, but must be less than the 0 poses");
  EXPECT_EQ(message(1, {}, 0),
            "last = 0, but must be another scan than the first of the loop");
  EXPECT_EQ(message(2, {}, 2), "last = 2, but must be less than the 2 poses");
  EXPECT_EQ(message(2, {{0, 7}}, 1),
            "end of an edge = 7, but must be less than the 2 poses");
  EXPECT_EQ(message(2, {{1, 1}}, 1),
            "end of an edge = 1, but must be another scan than the other end");
  EXPECT_EQ(message(2, {{0, 1, -1}}, 1),
            "cost of an edge = -1, but must be finite and >= 0");
  EXPECT_EQ(message(2, {{0, 1, kNan}}, 1),
            "cost of an edge = nan, but must be finite and >= 0");
}

} // namespace pcl6d::test
