// SPDX-License-Identifier: BSD-3-Clause
#include "ring_graph.h"

#include <gtest/gtest.h>

using namespace pcl6d;
using namespace pcl6d::test;

namespace {
GraphRecipe
bigRing(double noise = 0.02)
{
  GraphRecipe recipe;
  recipe.scans = 20;
  recipe.pairs = 100;
  recipe.noise = noise;
  recipe.edges = ringEdges(20);
  for (std::size_t i = 0; i < 20; ++i)
    recipe.edges.emplace_back(i, (i + 2) % 20);
  return recipe;
}

/** Pairs that say that two scans are where they are not. */
LinkPairs
falseLink(const GraphCase& graph, std::size_t from, std::size_t to, double off)
{
  Random random(77);
  Poses wrong = graph.truth;
  wrong[to].pretranslate(off * Eigen::Vector3d(0.6, 0.8, 0));
  wrong[to].linear() = rotationFromVector({0, 0, 0.3}) * wrong[to].linear();
  return makePairs(random, wrong, from, to, 100, 0.02);
}

/** Points in a corridor along x: walls across y, floor across z. */
LinkPairs
corridorLink(Random& random, const Poses& truth, std::size_t from, std::size_t to)
{
  LinkPairs link = makePairs(random, truth, from, to, 200, 0);
  for (std::size_t k = 0; k < 200; ++k) {
    const Eigen::Vector3d n =
        k % 2 == 0 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
    link.norms.push_back(planeToPlane(n, n));
    // Along the corridor the partner is anywhere; here always a metre ahead.
    const Eigen::Vector3d ahead =
        truth[to].linear().transpose() * Eigen::Vector3d::UnitX();
    link.points_to[k] += ahead.cast<float>();
  }
  return link;
}
} // namespace

TEST(Switching, KeepsAFalseLinkFromBendingTheMap)
{
  for (const double off : {0.5, 3.0, 30.0})
    for (const LinkWeights weights : {LinkWeights::kPairs, LinkWeights::kCovariance}) {
      SCOPED_TRACE(std::string(toString(weights)) + ", off by " + std::to_string(off));
      const GraphCase graph = makeGraph(bigRing());
      GraphSlamOptions options = exactOptions(Relaxation::kHelix, weights);
      const auto clean = GraphSlam(options).relax(graph.start, graph.links);
      auto links = graph.links;
      links.push_back(falseLink(graph, 3, 13, off));
      const auto bent = GraphSlam(options).relax(graph.start, links);
      EXPECT_GT(largestDistance(clean.poses, bent.poses), 0.05);
      options.switch_links = true;
      const auto switched = GraphSlam(options).relax(graph.start, links);
      EXPECT_EQ(switched.status, Status::kOk);
      EXPECT_LT(largestDistance(clean.poses, switched.poses), 0.01);
      EXPECT_LT(switched.links.back().switch_weight, 0.01);
      for (std::size_t l = 0; l < graph.links.size(); ++l)
        EXPECT_GT(switched.links[l].switch_weight, 0.2) << l;
    }
}

TEST(Switching, LeavesATrueLoopAlone)
{
  // A chain that drifted, closed by one link: no link is falser than another.
  GraphRecipe recipe;
  recipe.scans = 20;
  recipe.edges = chainEdges(20);
  recipe.edges.emplace_back(19, 0);
  recipe.start_shift = recipe.start_turn = 0;
  GraphCase graph = makeGraph(recipe);
  for (std::size_t i = 1; i < 20; ++i)
    for (std::size_t j = i; j < 20; ++j)
      graph.start[j].translation() += Eigen::Vector3d(0.1, 0.05, 0); // 2 m at the end
  GraphSlamOptions options = exactOptions(Relaxation::kHelix);
  options.switch_links = true;
  const auto result = GraphSlam(options).relax(graph.start, graph.links);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_LT(largestDistance(result.poses, graph.truth), 0.1);
  for (const LinkReport& link : result.links)
    EXPECT_GT(link.switch_weight, 0.2);
}

TEST(Switching, NeverTouchesTrustedLinks)
{
  const GraphCase graph = makeGraph(bigRing());
  auto links = graph.links;
  links.push_back(falseLink(graph, 3, 13, 3));
  links.back().trusted = true;
  GraphSlamOptions options = exactOptions(Relaxation::kHelix);
  options.switch_links = true;
  const auto result = GraphSlam(options).relax(graph.start, links);
  EXPECT_EQ(result.links.back().switch_weight, 1);
}

TEST(RobustKernels, TakeTheWeightFromFalsePairs)
{
  GraphCase graph = makeGraph(bigRing());
  const Poses clean =
      GraphSlam(exactOptions(Relaxation::kHelix)).relax(graph.start, graph.links).poses;
  for (LinkPairs& link : graph.links)
    for (std::size_t k = 0; k < 20; ++k) // a fifth of all pairs, all to one side
      link.points_to[k] += Eigen::Vector3f(2, 1, 0);
  GraphSlamOptions options = exactOptions(Relaxation::kHelix);
  options.translation_epsilon = options.rotation_epsilon = 1e-6;
  const double plain =
      largestDistance(GraphSlam(options).relax(graph.start, graph.links).poses, clean);
  for (const RobustKernel kernel :
       {RobustKernel::kHuber, RobustKernel::kCauchy, RobustKernel::kGemanMcClure}) {
    SCOPED_TRACE(toString(kernel));
    options.robust = kernel;
    const auto result = GraphSlam(options).relax(graph.start, graph.links);
    EXPECT_TRUE(result.converged);
    EXPECT_LT(largestDistance(result.poses, clean), 0.2 * plain);
  }
}

TEST(OpenDirections, OfACorridorCarryNoInformation)
{
  // 0 - 1 through a corridor along x, and 0 - 2 - 1 by scans that see everything.
  Random random(2);
  GraphRecipe recipe;
  recipe.scans = 3;
  recipe.noise = 0;
  recipe.edges = {{0, 2}, {2, 1}};
  recipe.headings = 1; // the axes of the world stay those of the norms
  GraphCase graph = makeGraph(recipe);
  graph.links.push_back(corridorLink(random, graph.truth, 0, 1));
  for (const LinkWeights weights : {LinkWeights::kPairs, LinkWeights::kCovariance}) {
    const auto result = GraphSlam(exactOptions(Relaxation::kHelix, weights))
                            .relax(graph.start, graph.links);
    EXPECT_EQ(result.status, Status::kOk);
    EXPECT_EQ(result.links[2].open_directions, 1);
    EXPECT_NEAR(result.links[2].correction(0), 0, 1e-9); // x is open
    EXPECT_LT(largestDistance(result.poses, graph.truth), 1e-5);
  }
}

TEST(OpenDirections, ThatNothingHoldsStayAsTheyWere)
{
  Random random(3);
  GraphRecipe recipe;
  recipe.scans = 3;
  recipe.edges = {{0, 2}};
  recipe.noise = 0;
  recipe.headings = 1;
  GraphCase graph = makeGraph(recipe);
  graph.links.push_back(corridorLink(random, graph.truth, 2, 1));
  graph.start = graph.truth;
  graph.start[1].pretranslate(Eigen::Vector3d(0.5, 0.2, -0.1));
  const auto result =
      GraphSlam(exactOptions(Relaxation::kHelix, LinkWeights::kCovariance))
          .relax(graph.start, graph.links);
  EXPECT_EQ(result.status, Status::kRankDeficient);
  EXPECT_TRUE(result.open_direction[1]);
  EXPECT_FALSE(result.open_direction[2]);
  const Eigen::Vector3d off =
      result.poses[1].translation() - graph.truth[1].translation();
  EXPECT_NEAR(off.x(), 0.5, 1e-3); // the smallest motion
  EXPECT_NEAR(off.y(), 0, 1e-3);
  EXPECT_NEAR(off.z(), 0, 1e-3);
}

TEST(OpenDirections, OfALineOfPairsAndOfAPlaneAreFound)
{
  Random random(4);
  const Poses truth = ringPoses({});
  LinkPairs line, plane;
  for (int k = 0; k < 50; ++k) {
    const Eigen::Vector3d on_line(random.uniform(-5, 5), 2, 1);
    const Eigen::Vector3d on_plane(random.uniform(-5, 5), random.uniform(-5, 5), 1);
    for (auto* link : {&line, &plane}) {
      const Eigen::Vector3d p = link == &line ? on_line : on_plane;
      link->from = 0;
      link->to = 1;
      link->points_from.push_back((truth[0].inverse() * p).cast<float>());
      link->points_to.push_back((truth[1].inverse() * p).cast<float>());
    }
    plane.norms.push_back(
        planeToPlane(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitZ()));
  }
  GraphSlamOptions options;
  options.num_threads = 1;
  const auto by_line = GraphSlam(options).relax(truth, {line});
  EXPECT_EQ(by_line.links[0].open_directions, 1);
  EXPECT_EQ(by_line.status, Status::kRankDeficient);
  const auto by_plane = GraphSlam(options).relax(truth, {plane});
  EXPECT_EQ(by_plane.links[0].open_directions, 3);
  EXPECT_EQ(by_plane.status, Status::kRankDeficient);
  EXPECT_LT(largestDistance(by_plane.poses, truth), 1e-4);
  LinkPairs both = line;
  both.points_from.insert(
      both.points_from.end(), plane.points_from.begin(), plane.points_from.end());
  both.points_to.insert(
      both.points_to.end(), plane.points_to.begin(), plane.points_to.end());
  EXPECT_EQ(GraphSlam(options).relax(truth, {both}).links[0].open_directions, 0);
}
