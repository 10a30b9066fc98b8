// SPDX-License-Identifier: BSD-3-Clause
#include "ring_graph.h"
#include "support/bits.h"

#include <gtest/gtest.h>

using namespace pcl6d;
using namespace pcl6d::test;

TEST(GraphSlam, SearchesPairsAnewEachRound)
{
  const GraphCase graph = makeGraph({});
  int searches = 0, rounds = 0;
  GraphSlamOptions options;
  options.num_threads = 1;
  GraphSlam slam(options);
  slam.setObserver([&](const GraphSlamRound& round) {
    EXPECT_EQ(round.iteration, ++rounds);
    return true;
  });
  const auto result = slam.relax(graph.start, [&](const Poses& current) {
    EXPECT_EQ(sameBits(current[3], graph.start[3]), searches == 0);
    ++searches;
    return graph.links;
  });
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_EQ(searches, result.iterations);
  EXPECT_EQ(rounds, result.iterations);
  EXPECT_LT(result.rms, result.rms_before);
}

TEST(GraphSlam, EndsWithARoundOfOtherPairs)
{
  GraphRecipe recipe;
  const GraphCase graph = makeGraph(recipe);
  recipe.seed += 1; // other noise
  const GraphCase other = makeGraph(recipe);
  GraphSlamOptions options;
  for (const int most : {50, 3, 1}) {
    options.max_iterations = most;
    int searches = 0, last_searches = 0;
    const auto result = GraphSlam(options).relax(
        graph.start,
        [&](const Poses&) {
          EXPECT_EQ(last_searches, 0) << "the other pairs come last";
          ++searches;
          return graph.links;
        },
        [&](const Poses&) {
          ++last_searches;
          return other.links;
        });
    EXPECT_EQ(last_searches, most > 1 ? 1 : 0);
    EXPECT_EQ(searches + last_searches, result.iterations);
    EXPECT_LE(result.iterations, most);
    EXPECT_EQ(result.status, most == 50 ? Status::kOk : Status::kMaxIterations);
    if (most == 50) {
      const auto alone = GraphSlam(options).relax(graph.start, other.links);
      for (std::size_t i = 0; i < alone.poses.size(); ++i)
        EXPECT_LT(distanceBetween(alone.poses[i], result.poses[i]).translation, 1e-3);
      EXPECT_NEAR(result.rms, alone.rms, 0.01 * alone.rms);
    }
  }
}

TEST(GraphSlam, StopsWhenItsObserverSaysSo)
{
  const GraphCase graph = makeGraph({});
  GraphSlam slam(exactOptions(Relaxation::kHelix));
  slam.setObserver([](const GraphSlamRound& round) { return round.iteration < 2; });
  const auto result = slam.relax(graph.start, graph.links);
  EXPECT_EQ(result.iterations, 2);
  EXPECT_EQ(result.status, Status::kMaxIterations);
}

TEST(GraphSlam, HasTheSameBitsForAnyNumberOfThreads)
{
  GraphRecipe recipe;
  recipe.scans = 40;
  recipe.pairs = 5000; // more than a block
  const GraphCase graph = makeGraph(recipe);
  for (const std::string& name : relaxationNames()) {
    SCOPED_TRACE(name);
    GraphSlamOptions options;
    options.relaxation = relaxationFromName(name);
    options.robust = RobustKernel::kHuber;
    options.switch_links = true;
    options.max_iterations = 4;
    options.num_threads = 1;
    const auto one = GraphSlam(options).relax(graph.start, graph.links);
    for (const unsigned int threads : {2u, 8u}) {
      options.num_threads = threads;
      const auto many = GraphSlam(options).relax(graph.start, graph.links);
      for (std::size_t j = 0; j < one.poses.size(); ++j) {
        EXPECT_TRUE(sameBits(one.poses[j], many.poses[j]));
        EXPECT_TRUE(sameBits(one.covariances[j], many.covariances[j]));
      }
    }
  }
}

TEST(GraphSlam, AddsUpLinksOfTheSameScansInEitherDirection)
{
  GraphCase graph = makeGraph({});
  GraphCase split = graph;
  split.links.clear();
  for (const LinkPairs& link : graph.links) {
    LinkPairs first = link, second;
    second.from = link.to;
    second.to = link.from;
    for (std::size_t k = 30; k < link.points_from.size(); ++k) {
      second.points_from.push_back(link.points_to[k]);
      second.points_to.push_back(link.points_from[k]);
    }
    first.points_from.resize(30);
    first.points_to.resize(30);
    split.links.push_back(first);
    split.links.push_back(second);
  }
  const GraphSlam slam(exactOptions(Relaxation::kHelix));
  EXPECT_LT(largestDistance(slam.relax(graph.start, graph.links).poses,
                            slam.relax(split.start, split.links).poses),
            1e-9);
}
