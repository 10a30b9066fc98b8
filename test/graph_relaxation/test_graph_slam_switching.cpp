// SPDX-License-Identifier: BSD-3-Clause
// A false link must not bend the map, however many pairs it has and however well these
// agree with each other.
#include "ring_graph.h"

#include <gtest/gtest.h>

using namespace pcl6d;
using namespace pcl6d::test;

namespace {
constexpr std::size_t kScans = 12;
constexpr std::size_t kPairs = 60;   // of a true link
constexpr double kNoise = 0.008;     // [m]
constexpr double kNoticeable = 0.01; // [m] that the map may be off

/** Each scan is linked with the next two. */
GraphCase
ringAt(double shift, double turn)
{
  GraphRecipe recipe;
  recipe.scans = kScans;
  recipe.pairs = kPairs;
  recipe.noise = kNoise;
  recipe.start_shift = shift;
  recipe.start_turn = turn;
  for (std::size_t i = 0; i < kScans; ++i) {
    recipe.edges.emplace_back(i, (i + 1) % kScans);
    recipe.edges.emplace_back(i, (i + 2) % kScans);
  }
  return makeGraph(recipe);
}

/** Pairs that agree with each other, but not with where the scans are. */
LinkPairs
falseLink(const Poses& truth,
          std::size_t from,
          std::size_t to,
          double off,
          std::size_t pairs,
          double noise = kNoise)
{
  Random random(77);
  Poses wrong = truth;
  wrong[to].pretranslate(off * Eigen::Vector3d(0.6, 0.8, 0));
  return makePairs(random, wrong, from, to, pairs, noise);
}

GraphSlamOptions
switchingOptions(LinkWeights weights)
{
  GraphSlamOptions options;
  options.weights = weights;
  options.switch_links = true;
  options.num_threads = 1;
  return options;
}

void
expectOnlyLastSwitchedOff(const GraphSlamResult& result)
{
  EXPECT_LT(result.links.back().switch_weight, 0.05);
  for (std::size_t l = 0; l + 1 < result.links.size(); ++l)
    EXPECT_GT(result.links[l].switch_weight, 0.9) << "link " << l;
}
} // namespace

TEST(Switching, DoesNotGoByTheNumberOfPairs)
{
  const GraphCase graph = ringAt(0, 0);
  for (const LinkWeights weights : {LinkWeights::kPairs, LinkWeights::kCovariance})
    for (const std::size_t pairs : {kPairs, 3 * kPairs, 10 * kPairs, 100 * kPairs})
      for (const double off : {0.15, 3.0})
        for (const auto& [from, to] : Edges{{0, 5}, {2, 6}, {3, 9}, {11, 8}}) {
          SCOPED_TRACE(std::string(toString(weights)) + ", " + std::to_string(pairs) +
                       " pairs say that " + std::to_string(to) + " is off by " +
                       std::to_string(off));
          auto links = graph.links;
          links.push_back(falseLink(graph.truth, from, to, off, pairs));
          const auto result =
              GraphSlam(switchingOptions(weights)).relax(graph.start, links);
          EXPECT_EQ(result.status, Status::kOk);
          EXPECT_LT(largestDistance(result.poses, graph.truth), kNoticeable);
          expectOnlyLastSwitchedOff(result);
        }
}

TEST(Switching, DoesNotGoByHowWellPairsAgreeWithinALink)
{
  const GraphCase graph = ringAt(0, 0);
  auto links = graph.links;
  links.push_back(falseLink(graph.truth, 0, 5, 3, 10 * kPairs, 0));
  const auto result =
      GraphSlam(switchingOptions(LinkWeights::kCovariance)).relax(graph.start, links);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_LT(largestDistance(result.poses, graph.truth), kNoticeable);
  expectOnlyLastSwitchedOff(result);
}

TEST(Switching, WorksFromADisturbedStart)
{
  const GraphCase graph = ringAt(0.3, 0.1);
  for (const double off : {0.15, 3.0}) {
    SCOPED_TRACE("off by " + std::to_string(off));
    auto links = graph.links;
    links.push_back(falseLink(graph.truth, 0, 5, off, 10 * kPairs));
    const auto result =
        GraphSlam(switchingOptions(LinkWeights::kCovariance)).relax(graph.start, links);
    EXPECT_EQ(result.status, Status::kOk);
    const auto clean = GraphSlam(switchingOptions(LinkWeights::kCovariance))
                           .relax(graph.start, graph.links);
    EXPECT_LT(largestDistance(result.poses, clean.poses), kNoticeable);
    expectOnlyLastSwitchedOff(result);
  }
}

TEST(Switching, EndsWithinFewRounds)
{
  // The width comes down in half of the rounds, so that the others are left to settle.
  const GraphCase graph = ringAt(0, 0);
  auto links = graph.links;
  links.push_back(falseLink(graph.truth, 0, 5, 3, 10 * kPairs));
  GraphSlamOptions options = switchingOptions(LinkWeights::kCovariance);
  options.max_iterations = 10;
  const auto result = GraphSlam(options).relax(graph.start, links);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_LT(largestDistance(result.poses, graph.truth), kNoticeable);
  expectOnlyLastSwitchedOff(result);
}

TEST(Switching, LeavesAMapWithoutFalseLinksAlone)
{
  // Links with more pairs keep their say: the optimum is that without switching.
  GraphCase graph = ringAt(0.3, 0.1);
  Random random(5);
  graph.links.push_back(makePairs(random, graph.truth, 0, 6, 10 * kPairs, kNoise));
  GraphSlamOptions options = switchingOptions(LinkWeights::kCovariance);
  options.translation_epsilon = options.rotation_epsilon = 1e-8;
  options.error_epsilon = 0;
  const auto switched = GraphSlam(options).relax(graph.start, graph.links);
  options.switch_links = false;
  const auto plain = GraphSlam(options).relax(graph.start, graph.links);
  EXPECT_EQ(switched.status, Status::kOk);
  EXPECT_LT(largestDistance(switched.poses, plain.poses), 1e-3);
  for (const LinkReport& link : switched.links)
    EXPECT_GT(link.switch_weight, 0.9);
}
