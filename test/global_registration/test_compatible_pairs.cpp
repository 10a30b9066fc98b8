// SPDX-License-Identifier: BSD-3-Clause
// Pairs of which most are wrong: exact truth, an exhaustive oracle, laws, and bad input.
#include "features/compatibility_graph.h"
#include "support/points.h"
#include "support/poses.h"

#include <pcl6d/global_registration/compatible_pairs.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <bitset>
#include <numeric>

using pcl6d::CompatibilityOptions;
using pcl6d::compatiblePairs;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::global_registration::CompatibilityGraph;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kNan;
using pcl6d::test::randomCube;
using pcl6d::test::randomPose;
using Places = std::vector<std::size_t>;

namespace {
constexpr double kNoise = 0.05; // [m] of right pairs, in a cube of 20 m

/** Pairs in a drawn order, of which the right ones lie within the noise after a motion. */
struct DrawnPairs {
  DrawnPairs(std::size_t count, std::size_t right, std::uint64_t seed)
  {
    Random random(seed);
    source = randomCube(random, count, 20);
    target = randomCube(random, count, 20);
    T_target_source = randomPose(random, 50, 2);
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < count; ++i)
      order.emplace_back(random.uniform(), i);
    std::sort(order.begin(), order.end());
    for (std::size_t k = 0; k < right; ++k)
      are_right.push_back(order[k].second);
    std::sort(are_right.begin(), are_right.end());
    for (const std::size_t i : are_right) {
      const Points off = randomCube(random, 1, kNoise); // half its diagonal is below it
      target[i] = (T_target_source * source[i].cast<double>()).cast<float>() + off[0];
    }
  }

  Places
  found(CompatibilityOptions options = {}) const
  {
    options.noise = kNoise;
    return compatiblePairs(source, target, options);
  }

  Points source, target;
  Eigen::Isometry3d T_target_source;
  Places are_right;
};

bool
allAgree(const DrawnPairs& pairs, const Places& kept)
{
  for (const std::size_t a : kept)
    for (const std::size_t b : kept)
      if (std::abs((pairs.source[a] - pairs.source[b]).cast<double>().norm() -
                   (pairs.target[a] - pairs.target[b]).cast<double>().norm()) >
          2 * kNoise + 1e-5) // floats of 50 m
        return false;
  return true;
}

bool
holds(const Places& all, const Places& some)
{
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

/** A graph of few things, each two compatible with a probability, or drawn to be. */
CompatibilityGraph
drawnGraph(std::size_t size, double share, Random& random)
{
  std::vector<bool> edges(size * size);
  for (std::size_t i = 0; i < size * size; ++i)
    edges[i] = random.uniform() < share;
  return CompatibilityGraph(
      size, [&](std::size_t a, std::size_t b) { return edges[a * size + b]; }, 1);
}

/** The size of the largest clique of a small graph, by looking at all sets. */
std::size_t
largestByAllSets(const CompatibilityGraph& graph)
{
  std::size_t best = 0;
  for (unsigned set = 1; set < 1u << graph.size(); ++set) {
    const std::size_t count = std::bitset<32>(set).count();
    if (count <= best)
      continue;
    bool all = true;
    for (std::size_t a = 0; a < graph.size() && all; ++a)
      for (std::size_t b = 0; b < a && all; ++b)
        all = !(set >> a & set >> b & 1u) || graph.areCompatible(a, b);
    if (all)
      best = count;
  }
  return best;
}

/** Core numbers by their definition: what is left after all with fewer neighbours than k
 * have gone, again and again. */
std::vector<std::size_t>
coresByPeeling(const CompatibilityGraph& graph)
{
  std::vector<std::size_t> cores(graph.size(), 0);
  for (std::size_t k = 1; k < graph.size(); ++k) {
    std::vector<bool> is_left(graph.size(), true);
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < graph.size(); ++i) {
        std::size_t degree = 0;
        for (std::size_t j = 0; j < graph.size(); ++j)
          degree += j != i && is_left[j] && graph.areCompatible(i, j);
        if (is_left[i] && degree < k) {
          is_left[i] = false;
          changed = true;
        }
      }
    }
    for (std::size_t i = 0; i < graph.size(); ++i)
      if (is_left[i])
        cores[i] = k;
  }
  return cores;
}
} // namespace

TEST(CompatiblePairs, OfTwentyOneIsRight)
{
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    const DrawnPairs pairs(2000, 100, seed);
    const Places kept = pairs.found();
    EXPECT_TRUE(holds(kept, pairs.are_right));
    // A wrong pair agrees with one of 100 by 2 % or so: with all of them never.
    EXPECT_EQ(kept.size(), pairs.are_right.size());
    EXPECT_TRUE(allAgree(pairs, kept));
  }
}

TEST(CompatiblePairs, OfAHundredOneIsRight)
{
  const DrawnPairs pairs(3000, 30, 4);
  EXPECT_EQ(pairs.found(), pairs.are_right);
}

TEST(CompatiblePairs, OfThreeTwoAreRight)
{
  const DrawnPairs pairs(1500, 1000, 5);
  EXPECT_TRUE(holds(pairs.found(), pairs.are_right));
}

TEST(CompatiblePairs, WhatIsNotLookedAtJoinsWhatIsLeft)
{
  const DrawnPairs pairs(6000, 600, 6);
  CompatibilityOptions options;
  options.max_pairs = 1000;
  const Places kept = pairs.found(options);
  EXPECT_EQ(kept, pairs.are_right);
}

TEST(CompatiblePairs, DoNotDependOnWhereTheSourceLies)
{
  DrawnPairs pairs(1000, 80, 7);
  const Places kept = pairs.found();
  Random random(8);
  pairs.source = pcl6d::transformed(pairs.source, randomPose(random, 30, 1.5));
  EXPECT_EQ(pairs.found(), kept);
  std::swap(pairs.source, pairs.target); // and not on which is which
  EXPECT_EQ(pairs.found(), kept);
}

TEST(CompatiblePairs, AreTheSameForAnyNumberOfThreads)
{
  const DrawnPairs pairs(1500, 60, 9);
  CompatibilityOptions options;
  options.num_threads = 1;
  const Places kept = pairs.found(options);
  for (const unsigned int threads : {2u, 8u}) {
    options.num_threads = threads;
    EXPECT_EQ(pairs.found(options), kept);
  }
}

TEST(CompatiblePairs, WithoutAnyRightOneAreFew)
{
  const DrawnPairs pairs(2000, 0, 10);
  const Places kept = pairs.found();
  EXPECT_LT(kept.size(), 12u);
  EXPECT_TRUE(allAgree(pairs, kept));
}

TEST(CompatiblePairs, LeaveOutWhatIsNotFinite)
{
  DrawnPairs pairs(1000, 100, 11);
  const std::size_t a = pairs.are_right[3], b = pairs.are_right[8];
  pairs.source[a].x() = kNan;
  pairs.target[b].y() = pcl6d::test::kInfinity;
  Places expected = pairs.are_right;
  expected.erase(expected.begin() + 8);
  expected.erase(expected.begin() + 3);
  EXPECT_EQ(pairs.found(), expected);
  EXPECT_TRUE(compatiblePairs({}, {}).empty());
  EXPECT_EQ(compatiblePairs({{1, 2, 3}}, {{4, 5, 6}}), Places{0});
}

TEST(CompatiblePairs, RefuseWhatBreaksARule)
{
  CompatibilityOptions options;
  options.noise = 0;
  EXPECT_EQ(badArgumentOf([&] { options.validate(); }),
            "noise = 0, but must be finite and > 0");
  options = {};
  options.max_pairs = 2;
  EXPECT_EQ(badArgumentOf([&] { options.validate(); }),
            "max_pairs = 2, but must be in [3, 30000]");
  EXPECT_NE(badArgumentOf([] {
              compatiblePairs({{0, 0, 0}}, {});
            }).find("target"),
            std::string::npos);
}

TEST(CompatibilityGraph, HasTheCoresOfTheirDefinition)
{
  Random random(12);
  for (const std::size_t size : {1u, 2u, 7u, 20u, 70u})
    for (const double share : {0.0, 0.1, 0.4, 0.9, 1.0}) {
      const CompatibilityGraph graph = drawnGraph(size, share, random);
      EXPECT_EQ(graph.coreNumbers(), coresByPeeling(graph)) << size << ' ' << share;
    }
}

TEST(CompatibilityGraph, FindsTheLargestSetOfSmallGraphs)
{
  Random random(13);
  int smaller = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const CompatibilityGraph graph = drawnGraph(14, 0.5, random);
    const auto clique = graph.largestClique();
    for (const auto a : clique)
      for (const auto b : clique)
        EXPECT_TRUE(a == b || graph.areCompatible(a, b));
    const std::size_t largest = largestByAllSets(graph);
    EXPECT_LE(clique.size(), largest);
    smaller += clique.size() < largest;
  }
  EXPECT_LE(smaller, 6); // it is greedy: not promised, but seldom missed
}
