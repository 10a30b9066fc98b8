// SPDX-License-Identifier: BSD-3-Clause
#include "ceres_oracle.h"
#include "graph_cases.h"

#include <pcl6d/common/error.h>

#include <gtest/gtest.h>

using namespace pcl6d;
using namespace pcl6d::test;

namespace {
// Float points at 16 m are rounded by 1e-6; 60 of them average.
constexpr double kFloatTol = 1e-6; // [m], [rad]

const Relaxation kAll[] = {Relaxation::kHelix,
                           Relaxation::kEuler,
                           Relaxation::kQuaternion,
                           Relaxation::kQuaternionPublished,
                           Relaxation::kSmallAngle};

class JointMethods : public testing::TestWithParam<Relaxation> {};

std::string
nameOf(const testing::TestParamInfo<Relaxation>& info)
{
  std::string name = toString(info.param);
  name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
  return name;
}
} // namespace

TEST(RelaxationNames, AreThoseOfTheCommandLine)
{
  const std::vector<std::string> names{
      "helix", "euler", "quaternion", "quaternion-published", "small-angle"};
  EXPECT_EQ(relaxationNames(), names);
  for (const std::string& name : names)
    EXPECT_EQ(toString(relaxationFromName(name)), name);
  EXPECT_THROW(relaxationFromName("lum"), BadArgument);
  EXPECT_EQ(linkWeightsNames(),
            (std::vector<std::string>{"unit", "pairs", "covariance"}));
  for (const std::string& name : linkWeightsNames())
    EXPECT_EQ(toString(linkWeightsFromName(name)), name);
  EXPECT_THROW(linkWeightsFromName("none"), BadArgument);
}

TEST_P(JointMethods, ReachTheOptimumOfCeres)
{
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    GraphRecipe recipe;
    recipe.seed = seed;
    const GraphCase graph = makeGraph(recipe);
    const auto result =
        GraphSlam(exactOptions(GetParam())).relax(graph.start, graph.links);
    EXPECT_EQ(result.status, Status::kOk);
    EXPECT_LE(result.iterations, 20);
    expectSame(result.poses, ceresOptimum(graph.start, graph.links), kOptimumTol);
  }
}

TEST_P(JointMethods, ReachTheOptimumOfTheConvergedVariances)
{
  GraphRecipe recipe;
  GraphCase graph = makeGraph(recipe);
  Random random(5);
  for (std::size_t l = 0; l < 4; ++l) // some links are noisier
    graph.links[l] =
        makePairs(random, graph.truth, graph.links[l].from, graph.links[l].to, 60, 0.3);
  const auto result = GraphSlam(exactOptions(GetParam(), LinkWeights::kCovariance))
                          .relax(graph.start, graph.links);
  ASSERT_EQ(result.status, Status::kOk);
  std::vector<double> factors;
  for (const LinkReport& link : result.links)
    factors.push_back(1 / link.variance);
  expectSame(
      result.poses, ceresOptimum(graph.start, graph.links, factors), kOptimumTol);
}

TEST_P(JointMethods, ReachTheOptimumWithLinksThatCountAlike)
{
  GraphRecipe recipe;
  GraphCase graph = makeGraph(recipe);
  Random random(6);
  for (std::size_t l = 0; l < 4; ++l) // some links have many more pairs, and noisy ones
    graph.links[l] = makePairs(
        random, graph.truth, graph.links[l].from, graph.links[l].to, 300, 0.3);
  const GraphSlam slam(exactOptions(GetParam(), LinkWeights::kUnit));
  const auto result = slam.relax(graph.start, graph.links);
  ASSERT_EQ(result.status, Status::kOk);
  std::vector<double> factors;
  for (const LinkReport& link : result.links)
    factors.push_back(1 / static_cast<double>(link.pairs));
  expectSame(
      result.poses, ceresOptimum(graph.start, graph.links, factors), kOptimumTol);
}

TEST_P(JointMethods, PairsThatComeTwiceCountOnceWhereLinksAreAlike)
{
  const GraphCase graph = makeGraph(GraphRecipe());
  std::vector<LinkPairs> doubled = graph.links;
  LinkPairs& link = doubled.front();
  const Points from = link.points_from, to = link.points_to;
  link.points_from.insert(link.points_from.end(), from.begin(), from.end());
  link.points_to.insert(link.points_to.end(), to.begin(), to.end());
  const auto poses = [&](LinkWeights weights, const std::vector<LinkPairs>& links) {
    return GraphSlam(exactOptions(GetParam(), weights)).relax(graph.start, links).poses;
  };
  expectSame(poses(LinkWeights::kUnit, doubled),
             poses(LinkWeights::kUnit, graph.links),
             kOptimumTol);
  EXPECT_GT(largestDistance(poses(LinkWeights::kPairs, doubled),
                            poses(LinkWeights::kPairs, graph.links)),
            1e-4);
}

// Norms turn with the scans, those of the oracle do not: the torque Z x N Z of a pair, against
// its range of 5 m, makes a difference of the order of the noise squared over the range.
TEST_P(JointMethods, ReachTheOptimumWithNormsAndWeights)
{
  for (const double noise : {0.05, 0.005}) {
    GraphRecipe recipe;
    recipe.noise = noise;
    GraphCase graph = makeGraph(recipe);
    Random random(9);
    for (LinkPairs& link : graph.links)
      for (std::size_t k = 0; k < link.points_from.size(); ++k) {
        const Eigen::Vector3d n = randomVector(random, 1).normalized();
        link.norms.push_back(planeToPlane(n, n, 0.01));
        link.weights.push_back(random.uniform(0.5, 1));
      }
    const auto result =
        GraphSlam(exactOptions(GetParam())).relax(graph.start, graph.links);
    ASSERT_EQ(result.status, Status::kOk);
    EXPECT_EQ(result.links[0].open_directions, 0);
    expectSame(
        result.poses, ceresOptimum(graph.start, graph.links), 4 * noise * noise / 5);
  }
}

TEST_P(JointMethods, GiveBackTheTruthWithoutNoise)
{
  GraphRecipe recipe;
  recipe.noise = 0;
  const GraphCase graph = makeGraph(recipe);
  const auto result =
      GraphSlam(exactOptions(GetParam())).relax(graph.start, graph.links);
  EXPECT_EQ(result.status, Status::kOk);
  expectSame(result.poses, graph.truth, kFloatTol);
  EXPECT_LT(result.rms, kFloatTol);
}

TEST_P(JointMethods, WorkNearAPitchOfARightAngle)
{
  for (const double off : {0.0, 1e-9, 0.05, 0.2}) {
    SCOPED_TRACE("pitch [rad] is off a right angle by " + std::to_string(off));
    GraphRecipe recipe;
    recipe.pitch = M_PI / 2 - off;
    const GraphCase graph = makeGraph(recipe);
    const auto result =
        GraphSlam(exactOptions(GetParam())).relax(graph.start, graph.links);
    EXPECT_EQ(result.status, Status::kOk);
    expectSame(result.poses, ceresOptimum(graph.start, graph.links), kOptimumTol);
  }
}

TEST_P(JointMethods, DoNotDependOnTheOrigin)
{
  for (const Eigen::Vector3d& origin :
       {Eigen::Vector3d(500, -300, 20), Eigen::Vector3d(691234.5, 5336789.25, 250)}) {
    GraphRecipe recipe;
    recipe.origin = origin;
    const GraphCase graph = makeGraph(recipe);
    const auto result =
        GraphSlam(exactOptions(GetParam())).relax(graph.start, graph.links);
    EXPECT_LE(result.iterations, 20);
    EXPECT_TRUE(result.converged);
    expectSame(result.poses, ceresOptimum(graph.start, graph.links), kOptimumTol);
  }
}

TEST_P(JointMethods, DoNotDependOnThePoseThatIsFixed)
{
  const GraphCase graph = makeGraph({});
  const GraphSlam slam(exactOptions(GetParam(), LinkWeights::kCovariance));
  const auto forth = slam.relax(graph.start, graph.links);
  const std::size_t last = graph.start.size() - 1;
  GraphCase mirrored = graph; // numbered from the other end
  std::reverse(mirrored.start.begin(), mirrored.start.end());
  for (LinkPairs& link : mirrored.links) {
    link.from = last - link.from;
    link.to = last - link.to;
  }
  auto back = slam.relax(mirrored.start, mirrored.links).poses;
  std::reverse(back.begin(), back.end());
  const Eigen::Isometry3d gauge = forth.poses[0] * back[0].inverse();
  for (Eigen::Isometry3d& pose : back)
    pose = gauge * pose;
  expectSame(forth.poses, back, kOptimumTol);
}

TEST_P(JointMethods, ReachTheOptimumFromFarAway)
{
  GraphRecipe recipe;
  recipe.start_shift = 4;
  recipe.start_turn =
      1; // each component: half of the scans are off by more than 88 deg
  for (recipe.seed = 1; recipe.seed <= 8; ++recipe.seed) {
    SCOPED_TRACE("seed " + std::to_string(recipe.seed));
    const GraphCase graph = makeGraph(recipe);
    const GraphSlam slam(exactOptions(GetParam(), LinkWeights::kCovariance));
    const auto result = slam.relax(graph.start, graph.links);
    EXPECT_EQ(result.status, Status::kOk);
    expectSame(result.poses, slam.relax(graph.truth, graph.links).poses, kOptimumTol);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, JointMethods, testing::ValuesIn(kJoint), nameOf);

TEST(AllMethods, ReachTheOptimumOnATree)
{
  GraphRecipe recipe;
  recipe.edges = {
      {0, 1}, {1, 2}, {2, 3}, {1, 4}, {5, 4}, {5, 6}, {6, 7}, {7, 8}, {8, 9}};
  const GraphCase graph = makeGraph(recipe);
  const Poses optimum = ceresOptimum(graph.start, graph.links);
  for (const Relaxation relaxation : kAll) {
    if (relaxation == Relaxation::kQuaternionPublished)
      continue; // biased on trees, too: see below
    SCOPED_TRACE(toString(relaxation));
    const auto result =
        GraphSlam(exactOptions(relaxation)).relax(graph.start, graph.links);
    EXPECT_EQ(result.status, Status::kOk);
    expectSame(result.poses, optimum, kOptimumTol);
  }
}

TEST(PublishedMethods, AreOffTheOptimumAsDocumented)
{
  GraphRecipe recipe;
  const GraphCase graph = makeGraph(recipe);
  const Poses optimum = ceresOptimum(graph.start, graph.links);
  for (const Relaxation relaxation :
       {Relaxation::kQuaternionPublished, Relaxation::kSmallAngle}) {
    SCOPED_TRACE(toString(relaxation));
    const auto result =
        GraphSlam(exactOptions(relaxation)).relax(graph.start, graph.links);
    EXPECT_EQ(result.status, Status::kOk);
    const double off = largestDistance(result.poses, optimum);
    EXPECT_GT(off, 1e-3); // [m] they do not minimise the sum of squares
    EXPECT_LT(off, 0.15); // [m] a few times the noise of 5 cm
  }
}

TEST(PublishedMethods, GiveBackTheTruthWithoutNoise)
{
  GraphRecipe recipe;
  recipe.noise = 0;
  const GraphCase graph = makeGraph(recipe);
  for (const Relaxation relaxation :
       {Relaxation::kQuaternionPublished, Relaxation::kSmallAngle})
    for (const LinkWeights weights : {LinkWeights::kPairs, LinkWeights::kCovariance}) {
      const auto result =
          GraphSlam(exactOptions(relaxation, weights)).relax(graph.start, graph.links);
      EXPECT_EQ(result.status, Status::kOk);
      expectSame(result.poses, graph.truth, kFloatTol);
    }
}
