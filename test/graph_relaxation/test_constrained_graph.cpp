// SPDX-License-Identifier: BSD-3-Clause
// Landmarks, priors and switches, with Ceres as an independent oracle.
#include "graph_cases.h"
#include "support/ceres_constraints.h"

#include <pcl6d/common/error.h>
#include <pcl6d/graph_relaxation/constrained_graph.h>

#include <gtest/gtest.h>

using pcl6d::GraphConstraints;
using pcl6d::PoseGraph;
using pcl6d::PoseGraphOptions;
using pcl6d::Random;
using pcl6d::Status;
using pcl6d::test::disturbed;
using pcl6d::test::largestDifference;

namespace {
// Near a minimum, chi2 within 1e-12 leaves the poses its root times their noise.
constexpr double kOptimumTol = 1e-5; // [m], [rad]

PoseGraphOptions
fineOptions()
{
  PoseGraphOptions options;
  options.chi2_epsilon = 1e-13;
  options.max_iterations = 500;
  return options;
}

/** A ring of 20 noisy poses and its true poses. */
struct Ring {
  Ring()
  {
    graph = pcl6d::test::ringGraph(20, 0.02, 5);
    truth = graph.poses;
    for (std::size_t i = 1; i < graph.poses.size(); ++i)
      graph.poses[i] = disturbed(graph.poses[i], random, 0.1);
  }

  void
  addPriors()
  {
    for (const std::size_t i : {3U, 9U, 15U}) {
      pcl6d::PosePrior prior;
      prior.pose = i;
      prior.T_world_pose = disturbed(truth[i], random, 0.02);
      prior.information = pcl6d::test::randomInformation(random);
      if (i == 9) // a position alone
        prior.information.bottomRows<3>().setZero(),
            prior.information.rightCols<3>().setZero();
      constraints.priors.push_back(prior);
    }
  }

  void
  addLandmarks()
  {
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector3d place(4.0 * static_cast<double>(k) - 6, 2, 1);
      for (std::size_t i = k; i < 20; i += 5) {
        pcl6d::LandmarkSighting sighting;
        sighting.pose = i;
        sighting.landmark = k;
        sighting.position =
            truth[i].inverse() * place +
            0.02 * Eigen::Vector3d::NullaryExpr([&] { return random.normal(); });
        sighting.information =
            pcl6d::test::randomInformation(random).topLeftCorner<3, 3>();
        constraints.sightings.push_back(sighting);
      }
      constraints.landmarks.push_back(place + Eigen::Vector3d(0.3, -0.2, 0.1));
      constraints.landmark_ids.push_back(100 + k);
    }
  }

  /** Switches on all links but those of the chain, and one wrong link. */
  void
  addSwitches()
  {
    graph.links.push_back(graph.links.back());
    graph.links.back().from = 2;
    graph.links.back().to = 13;
    for (std::size_t k = 20; k < graph.links.size(); ++k) {
      pcl6d::LinkSwitch one;
      one.link = k;
      one.id = 200 + k;
      one.information = 20;
      constraints.switches.push_back(one);
    }
  }

  Random random{7};
  PoseGraph graph;
  std::vector<Eigen::Isometry3d> truth;
  GraphConstraints constraints;
};

/** Both ends, compared. */
void
expectAsCeres(const Ring& ring)
{
  const auto ours = optimizeConstrained(ring.graph, ring.constraints, fineOptions());
  const auto theirs = pcl6d::test::constrainedByCeres(ring.graph, ring.constraints);
  EXPECT_EQ(ours.status, Status::kOk);
  EXPECT_NEAR(ours.chi2_after, theirs.chi2, 1e-8 * theirs.chi2);
  EXPECT_LT(largestDifference(ours.poses, theirs.poses), kOptimumTol);
  for (std::size_t k = 0; k < ring.constraints.landmarks.size(); ++k)
    EXPECT_LT((ours.constraints.landmarks[k] - theirs.landmarks[k]).norm(),
              kOptimumTol);
  for (std::size_t k = 0; k < ring.constraints.switches.size(); ++k)
    EXPECT_NEAR(ours.constraints.switches[k].value, theirs.switches[k], kOptimumTol);
  // chi2 is what it is said to be.
  PoseGraph there = ring.graph;
  there.poses = ours.poses;
  EXPECT_NEAR(chi2Of(there, ours.constraints), ours.chi2_after, 1e-9 * ours.chi2_after);
}
} // namespace

TEST(ConstrainedGraph, WithPriorsEndsWhereCeresEnds)
{
  Ring ring;
  ring.addPriors();
  expectAsCeres(ring);
}

TEST(ConstrainedGraph, WithLandmarksEndsWhereCeresEnds)
{
  Ring ring;
  ring.addLandmarks();
  expectAsCeres(ring);
}

TEST(ConstrainedGraph, WithSwitchesEndsWhereCeresEnds)
{
  Ring ring;
  ring.addSwitches();
  expectAsCeres(ring);
}

TEST(ConstrainedGraph, WithAllOfThemEndsWhereCeresEnds)
{
  Ring ring;
  ring.addPriors();
  ring.addLandmarks();
  ring.addSwitches();
  expectAsCeres(ring);
}

TEST(ConstrainedGraph, SwitchesOffTheWrongLinkOnly)
{
  Ring ring;
  ring.addSwitches();
  const auto result = optimizeConstrained(ring.graph, ring.constraints, fineOptions());
  const auto& switches = result.constraints.switches;
  for (std::size_t k = 0; k + 1 < switches.size(); ++k)
    EXPECT_GT(switches[k].value, 0.5) << k;
  EXPECT_LT(switches.back().value, 0.01);
  // The result is that without the wrong link.
  Ring without = ring;
  without.graph.links.pop_back();
  without.constraints.switches.pop_back();
  const auto right =
      optimizeConstrained(without.graph, without.constraints, fineOptions());
  EXPECT_LT(largestDifference(result.poses, right.poses), 1e-3);
}

TEST(ConstrainedGraph, WithoutConstraintsIsThatOfTheOptimizer)
{
  const Ring ring;
  const auto plain = pcl6d::PoseGraphOptimizer(ring.graph, fineOptions()).optimize();
  const auto result = optimizeConstrained(ring.graph, {}, fineOptions());
  EXPECT_EQ(result.chi2_after, plain.chi2_after);
  for (std::size_t i = 0; i < plain.poses.size(); ++i)
    EXPECT_TRUE(result.poses[i].matrix() == plain.poses[i].matrix());
}

TEST(ConstrainedGraph, MovesWithItsPriors)
{
  // Law: a motion of the world moves the result, and changes no residual.
  Ring ring;
  ring.addPriors();
  const Eigen::Isometry3d motion = pcl6d::test::randomPose(ring.random, 50, 2);
  Ring moved = ring;
  for (auto& prior : moved.constraints.priors)
    prior.T_world_pose = motion * prior.T_world_pose;
  for (auto& pose : moved.graph.poses)
    pose = motion * pose;
  const auto a = optimizeConstrained(ring.graph, ring.constraints, fineOptions());
  const auto b = optimizeConstrained(moved.graph, moved.constraints, fineOptions());
  EXPECT_NEAR(a.chi2_after, b.chi2_after, 1e-8 * a.chi2_after);
  for (std::size_t i = 0; i < a.poses.size(); ++i)
    EXPECT_TRUE(b.poses[i].isApprox(motion * a.poses[i], kOptimumTol));
}

TEST(ConstrainedGraph, KeepsFixedPosesToTheLastBit)
{
  for (const bool has_priors : {false, true}) {
    Ring ring;
    if (has_priors)
      ring.addPriors();
    ring.constraints.fixed = {4, 11};
    const auto result =
        optimizeConstrained(ring.graph, ring.constraints, fineOptions());
    for (const std::size_t i : ring.constraints.fixed)
      EXPECT_TRUE(result.poses[i].matrix() == ring.graph.poses[i].matrix());
    EXPECT_LT(result.chi2_after, result.chi2_before);
  }
}

TEST(ConstrainedGraph, NamesWhatIsWrong)
{
  const auto faultOf = [](auto change) {
    Ring ring;
    ring.addPriors();
    ring.addLandmarks();
    ring.addSwitches();
    change(ring.constraints);
    try {
      optimizeConstrained(ring.graph, ring.constraints);
    } catch (const pcl6d::BadArgument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(faultOf([](auto&) {}), "");
  EXPECT_EQ(faultOf([](auto& c) { c.fixed = {20}; }),
            "fixed pose 20: the graph has no pose with this index");
  EXPECT_EQ(faultOf([](auto& c) { c.priors[1].pose = 20; }),
            "prior 1: the graph has no pose with this index");
  EXPECT_EQ(faultOf([](auto& c) { c.priors[0].information *= -1; }),
            "prior 0: its information is not positive semidefinite");
  EXPECT_EQ(faultOf([](auto& c) { c.landmarks.emplace_back(1, 2, 3); }),
            "landmark 4: no pose sees it");
  EXPECT_EQ(faultOf([](auto& c) { c.sightings[0].landmark = 9; }),
            "sighting 0: the graph has no landmark with this index");
  EXPECT_EQ(faultOf([](auto& c) { c.switches[0].information = 0; }),
            "switch 220: its information must be > 0");
  EXPECT_EQ(faultOf([](auto& c) { c.switches[1].link = c.switches[0].link; }),
            "switch 221: the link has another switch");
}
