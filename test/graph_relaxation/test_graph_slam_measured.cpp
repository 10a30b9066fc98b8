// SPDX-License-Identifier: BSD-3-Clause
#include "ceres_oracle.h"
#include "graph_cases.h"

#include <gtest/gtest.h>

using namespace pcl6d;
using namespace pcl6d::test;

namespace {

/** A ring in which 3 and 4 are joined by a measurement instead of pairs. */
GraphCase
ringWithGap()
{
  GraphCase graph = makeGraph({});
  graph.links.erase(graph.links.begin() + 3);
  return graph;
}

PoseLink
measurement(const GraphCase& graph)
{
  PoseLink measured;
  measured.from = 3;
  measured.to = 4;
  measured.T_from_to = graph.truth[3].inverse() * graph.truth[4];
  measured.T_from_to.translation() += Eigen::Vector3d(0.1, -0.05, 0.02);
  measured.T_from_to.linear() *= rotationFromVector({0.02, 0.01, -0.03});
  measured.information.diagonal() << 100, 200, 300, 1000, 2000, 3000;
  measured.information(0, 5) = measured.information(5, 0) = 50;
  return measured;
}
} // namespace

TEST(MeasuredLinks, CountBesidePairsByVariance)
{
  const GraphCase graph = ringWithGap();
  const PoseLink measured = measurement(graph);
  for (const Relaxation relaxation : kJoint) {
    SCOPED_TRACE(toString(relaxation));
    GraphSlam slam(exactOptions(relaxation, LinkWeights::kCovariance));
    slam.setMeasuredLinks({measured});
    const auto result = slam.relax(graph.start, graph.links);
    ASSERT_EQ(result.status, Status::kOk);
    std::vector<double> factors;
    for (const LinkReport& link : result.links)
      factors.push_back(1 / link.variance);
    expectSame(result.poses,
               ceresOptimum(graph.start, graph.links, factors, {measured}),
               kOptimumTol);
  }
}

TEST(MeasuredLinks, AreWeighedAgainstTheCommonVarianceOfUnitPairs)
{
  const GraphCase graph = ringWithGap();
  const PoseLink measured = measurement(graph);
  GraphSlam slam(exactOptions(Relaxation::kHelix, LinkWeights::kPairs));
  slam.setMeasuredLinks({measured});
  const auto result = slam.relax(graph.start, graph.links);
  ASSERT_EQ(result.status, Status::kOk);
  const double pairs = 60.0 * static_cast<double>(graph.links.size());
  const double variance = result.rms * result.rms * pairs / (3 * pairs - 6 * 9);
  const std::vector<double> factors(graph.links.size(), 1 / variance);
  expectSame(result.poses,
             ceresOptimum(graph.start, graph.links, factors, {measured}),
             kOptimumTol);
}

TEST(MeasuredLinks, AloneAreAPoseGraph)
{
  const GraphCase graph = makeGraph({});
  Random random(3);
  std::vector<PoseLink> measured;
  for (const auto& [a, b] : ringEdges(graph.truth.size())) {
    PoseLink link;
    link.from = a;
    link.to = b;
    link.T_from_to = graph.truth[a].inverse() * graph.truth[b];
    link.T_from_to.translation() += normalVector(random, 0.1);
    link.T_from_to.linear() *= rotationFromVector(normalVector(random, 0.05));
    link.information.diagonal() << 100, 100, 100, 400, 400, 400;
    measured.push_back(link);
  }
  const Poses optimum = ceresOptimum(graph.start, {}, {}, measured);
  for (const Relaxation relaxation : kJoint) {
    SCOPED_TRACE(toString(relaxation));
    GraphSlam slam(exactOptions(relaxation, LinkWeights::kCovariance));
    slam.setMeasuredLinks(measured);
    const auto result = slam.relax(graph.start, std::vector<LinkPairs>{});
    EXPECT_EQ(result.status, Status::kOk);
    expectSame(result.poses, optimum, kOptimumTol);
  }
}

TEST(MeasuredLinks, ThatAreExactGiveTheTruthByAllMethods)
{
  const GraphCase graph = makeGraph({});
  std::vector<PoseLink> measured;
  for (const auto& [a, b] : ringEdges(graph.truth.size())) {
    PoseLink link;
    link.from = a;
    link.to = b;
    link.T_from_to = graph.truth[a].inverse() * graph.truth[b];
    measured.push_back(link);
  }
  for (const std::string& name : relaxationNames()) {
    SCOPED_TRACE(name);
    const Relaxation relaxation = relaxationFromName(name);
    GraphSlam slam(exactOptions(relaxation, LinkWeights::kCovariance));
    slam.setMeasuredLinks(measured);
    const auto result = slam.relax(graph.start, std::vector<LinkPairs>{});
    EXPECT_EQ(result.status, Status::kOk);
    expectSame(result.poses, graph.truth, kOptimumTol);
  }
}
