// SPDX-License-Identifier: BSD-3-Clause
#include "ring_graph.h"
#include "support/bits.h"

#include <pcl6d/common/error.h>

#include <gtest/gtest.h>

using namespace pcl6d;
using namespace pcl6d::test;

namespace {
GraphSlam
slamOf(Relaxation relaxation = Relaxation::kHelix)
{
  return GraphSlam(exactOptions(relaxation));
}

void
expectAsGiven(const GraphSlamResult& result, const Poses& start)
{
  ASSERT_EQ(result.poses.size(), start.size());
  for (std::size_t j = 0; j < start.size(); ++j)
    EXPECT_TRUE(sameBits(result.poses[j], start[j]));
}
} // namespace

TEST(GraphSlamOptions, NameTheFieldThatBreaksItsRule)
{
  const auto broken = [](auto change) {
    GraphSlamOptions options;
    change(options);
    EXPECT_THROW(GraphSlam{options}, BadArgument);
  };
  broken([](auto& o) { o.max_iterations = 0; });
  broken([](auto& o) { o.min_pairs = 2; });
  broken([](auto& o) { o.least_deviation = 0; });
  broken([](auto& o) { o.switch_scale = -1; });
  broken([](auto& o) { o.translation_epsilon = -1; });
  broken([](auto& o) { o.rotation_epsilon = std::nan(""); });
  broken([](auto& o) { o.error_epsilon = -1; });
  EXPECT_NO_THROW(GraphSlam{GraphSlamOptions{}});
}

TEST(GraphSlamInput, RefusesLinksThatCannotBe)
{
  const GraphCase graph = makeGraph({});
  const auto refused = [&](auto change) {
    auto links = graph.links;
    change(links[2]);
    EXPECT_THROW(slamOf().relax(graph.start, links), BadArgument);
    EXPECT_THROW(slamOf().relax(graph.start, [&](const Poses&) { return links; }),
                 BadArgument);
  };
  refused([](LinkPairs& link) { link.from = 10; });
  refused([](LinkPairs& link) { link.to = 1000; });
  refused([](LinkPairs& link) { link.to = link.from; });
  refused([](LinkPairs& link) { link.points_to.pop_back(); });
  refused([](LinkPairs& link) { link.weights.resize(1); });
  refused([](LinkPairs& link) { link.norms.resize(1); });
}

TEST(GraphSlamInput, RefusesPosesAndMeasurementsThatAreNone)
{
  const GraphCase graph = makeGraph({});
  Poses start = graph.start;
  start[4].translation().y() = std::nan("");
  EXPECT_THROW(slamOf().relax(start, graph.links), BadArgument);
  start = graph.start;
  start[4].linear() *= 2;
  EXPECT_THROW(slamOf().relax(start, graph.links), BadArgument);
  EXPECT_THROW(slamOf().relax(graph.start, GraphSlam::PairSearch()), BadArgument);
  PoseLink measured;
  measured.from = 3;
  const auto refused = [&](const PoseLink& link) {
    GraphSlam slam = slamOf();
    slam.setMeasuredLinks({link});
    EXPECT_THROW(slam.relax(graph.start, graph.links), BadArgument);
  };
  PoseLink link = measured;
  link.to = 3;
  refused(link);
  link = measured;
  link.to = 10;
  refused(link);
  link = measured;
  link.information(2, 2) = std::nan("");
  refused(link);
  link = measured;
  link.information(0, 1) = 0.9; // not symmetric
  refused(link);
  link.information(0, 1) = link.information(1, 0) = 5; // indefinite
  refused(link);
  link.information = -measured.information;
  refused(link);
  link = measured;
  link.T_from_to.translation().x() = std::nan("");
  refused(link);
}

TEST(GraphSlamInput, WithoutLinksIsTooLittle)
{
  const GraphCase graph = makeGraph({});
  const std::vector<LinkPairs> none;
  const auto unlinked = slamOf().relax(graph.start, none);
  EXPECT_EQ(unlinked.status, Status::kTooFewPairs);
  expectAsGiven(unlinked, graph.start);
  EXPECT_EQ(slamOf().relax({}, none).status, Status::kTooFewPairs);
  const auto single = slamOf().relax({graph.start[0]}, none);
  EXPECT_EQ(single.status, Status::kTooFewPairs);
  expectAsGiven(single, {graph.start[0]});
}

TEST(GraphSlamInput, DropsAndNamesLinksWithFewPairs)
{
  GraphCase graph = makeGraph({});
  graph.links[11].points_from.resize(19);
  graph.links[11].points_to.resize(19);
  // Not finite, so that 19 of 60 are left.
  for (std::size_t k = 19; k < 60; ++k)
    graph.links[10].points_to[k].x() = std::numeric_limits<float>::infinity();
  const auto result = slamOf().relax(graph.start, graph.links);
  EXPECT_EQ(result.status, Status::kOk);
  for (std::size_t l = 0; l < graph.links.size(); ++l)
    EXPECT_EQ(result.links[l].used, l < 10);
  EXPECT_EQ(result.links[10].pairs, 19u);
  auto alike = graph.links; // 60 pairs that are worth 15
  alike[9].redundancy = 4;
  EXPECT_FALSE(slamOf().relax(graph.start, alike).links[9].used);
  auto without = graph.links;
  without.resize(10);
  EXPECT_LT(largestDistance(result.poses, slamOf().relax(graph.start, without).poses),
            1e-12);
  for (LinkPairs& link : graph.links) {
    link.points_from.resize(5);
    link.points_to.resize(5);
  }
  const auto none = slamOf().relax(graph.start, graph.links);
  EXPECT_EQ(none.status, Status::kTooFewPairs);
  expectAsGiven(none, graph.start);
}

TEST(GraphSlamInput, FixesThePoseOfEachGroup)
{
  GraphRecipe recipe; // 0 to 4, 5 to 8, and 9 alone
  recipe.edges = {
      {0, 1}, {1, 2}, {2, 3}, {3, 4}, {0, 4}, {5, 6}, {6, 7}, {7, 8}, {8, 5}};
  const GraphCase graph = makeGraph(recipe);
  for (const Relaxation relaxation : {Relaxation::kHelix, Relaxation::kSmallAngle}) {
    const auto result = slamOf(relaxation).relax(graph.start, graph.links);
    EXPECT_EQ(result.status, Status::kRankDeficient);
    EXPECT_TRUE(result.converged);
    EXPECT_EQ(result.component,
              (std::vector<std::size_t>{0, 0, 0, 0, 0, 5, 5, 5, 5, 9}));
    EXPECT_EQ(result.floating(), (std::vector<std::size_t>{5, 6, 7, 8, 9}));
    for (const std::size_t fixed : {0, 5, 9})
      EXPECT_TRUE(sameBits(result.poses[fixed], graph.start[fixed]));
    for (std::size_t j = 0; j < 10; ++j) { // beyond pose 4 nothing is known
      EXPECT_EQ(result.open_direction[j], j >= 5) << j;
      EXPECT_EQ(result.covariances[j].isZero(0), j == 0 || j >= 5) << j;
    }
    const Eigen::Isometry3d found = result.poses[5].inverse() * result.poses[7];
    const Eigen::Isometry3d truth = graph.truth[5].inverse() * graph.truth[7];
    EXPECT_LT(distanceBetween(found, truth).translation, 0.1);
  }
}

TEST(GraphSlamInput, ThatMovesAwaySaysSo)
{
  const GraphCase graph = makeGraph({});
  Random random(1);
  int searches = 0;
  const auto result = slamOf().relax(graph.start, [&](const Poses&) {
    auto links = graph.links;
    for (LinkPairs& link : links) // pairs that become worse and worse
      for (Eigen::Vector3f& v : link.points_to)
        v += std::pow(10.0f, static_cast<float>(searches)) *
             randomVector(random, 1).cast<float>();
    ++searches;
    return links;
  });
  EXPECT_EQ(result.status, Status::kDiverged);
  EXPECT_FALSE(result.converged);
  expectAsGiven(result, graph.start);
}

TEST(GraphSlamInput, ThatIsWorseInALastRoundIsLeftOut)
{
  const GraphCase graph = makeGraph({});
  Random random(1);
  const auto search = [&](const Poses&) { return graph.links; };
  const auto result = slamOf().relax(graph.start, search, [&](const Poses&) {
    auto links = graph.links;
    for (LinkPairs& link : links)
      for (Eigen::Vector3f& v : link.points_to)
        v += 1000 * randomVector(random, 1).cast<float>();
    return links;
  });
  const auto without = slamOf().relax(graph.start, search);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_TRUE(result.converged);
  EXPECT_LT(largestDistance(result.poses, without.poses), 1e-12);
  EXPECT_NEAR(result.rms, without.rms, 1e-12);
}

TEST(GraphSlamInput, StopsAtTheLimit)
{
  const GraphCase graph = makeGraph({});
  GraphSlamOptions options = exactOptions(Relaxation::kHelix);
  options.max_iterations = 2;
  const auto result = GraphSlam(options).relax(graph.start, graph.links);
  EXPECT_EQ(result.status, Status::kMaxIterations);
  EXPECT_EQ(result.iterations, 2);
  EXPECT_LT(result.rms, result.rms_before);
}

TEST(GraphSlamInput, SaysTheLimitBeforeWhatFloats)
{
  GraphRecipe recipe;
  recipe.edges = chainEdges(9); // pose 9 floats
  const GraphCase graph = makeGraph(recipe);
  GraphSlamOptions options = exactOptions(Relaxation::kHelix);
  options.max_iterations = 1;
  const auto result = GraphSlam(options).relax(graph.start, graph.links);
  EXPECT_EQ(result.status, Status::kMaxIterations);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.floating(), std::vector<std::size_t>{9});
}
