// SPDX-License-Identifier: BSD-3-Clause
#include "graph_cases.h"

#include <pcl6d/common/error.h>
#include <pcl6d/graph_relaxation/link_error.h>

#include <gtest/gtest.h>

using pcl6d::linearizeLink;
using pcl6d::LinkError;
using pcl6d::linkError;
using pcl6d::PoseGraph;
using pcl6d::PoseLink;
using pcl6d::Random;
using pcl6d::Vector6;
using pcl6d::test::randomPose;

namespace {
constexpr double kStep = 1e-5;
// Central differences: kStep^2 of curvature and 1e-16 / kStep of rounding, for errors
// of some metres.
constexpr double kDerivativeTolerance = 1e-8;

/** T [R(dr), dt] */
Eigen::Isometry3d
moved(const Eigen::Isometry3d& T, const Vector6& motion)
{
  Eigen::Isometry3d small = Eigen::Isometry3d::Identity();
  small.linear() = pcl6d::rotationFromVector(motion.tail<3>());
  small.translation() = motion.head<3>();
  return T * small;
}
} // namespace

TEST(LinkError, IsTranslationAndTwiceTheQuaternionsVector)
{
  PoseLink link;
  link.T_from_to = pcl6d::poseFromEuler({1, 0, 0}, {0, 0, M_PI / 2});
  const auto a = pcl6d::poseFromEuler({5, 6, 7}, {});
  const auto b = pcl6d::poseFromEuler({6, 8, 7}, {0, 0, M_PI / 2 + 0.2});
  Vector6 expected;
  expected << 2, 0, 0, 0, 0, 2 * std::sin(0.1);
  EXPECT_LT((linkError(link, a, b) - expected).norm(), 1e-14);
  EXPECT_LT((linearizeLink(link, a, b).error - expected).norm(), 1e-14);
}

TEST(LinkError, KeepsTheRealPartPositive)
{
  PoseLink link;
  const auto a = Eigen::Isometry3d::Identity();
  const auto b =
      pcl6d::poseFromEuler({0, 0, 0}, {0, 0, 1.5 * M_PI}); // that is -90 degrees
  EXPECT_NEAR(linkError(link, a, b)(5), -2 * std::sin(M_PI / 4), 1e-14);
}

TEST(LinkError, HasTheDerivativesOfFiniteDifferences)
{
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    PoseLink link;
    const auto a = randomPose(random, 5, random.uniform(0, 3));
    const auto b = randomPose(random, 5, random.uniform(0, 3));
    link.T_from_to = pcl6d::test::disturbed(a.inverse() * b, random, 0.5);
    const LinkError linear = linearizeLink(link, a, b);
    EXPECT_LT((linear.error - linkError(link, a, b)).norm(), 1e-13);
    for (int i = 0; i < 6; ++i) {
      const Vector6 step = kStep * Vector6::Unit(i);
      const Vector6 by_a =
          (linkError(link, moved(a, step), b) - linkError(link, moved(a, -step), b)) /
          (2 * kStep);
      const Vector6 by_b =
          (linkError(link, a, moved(b, step)) - linkError(link, a, moved(b, -step))) /
          (2 * kStep);
      EXPECT_LT((linear.J_from.col(i) - by_a).norm(), kDerivativeTolerance);
      EXPECT_LT((linear.J_to.col(i) - by_b).norm(), kDerivativeTolerance);
    }
  }
}

TEST(LinkError, AdjointCarriesSmallMotionsAcrossAPose)
{
  Random random(2);
  const auto X = randomPose(random, 5, 2);
  const Vector6 motion = 1e-7 * Vector6::NullaryExpr([&] { return random.normal(); });
  const Vector6 carried = pcl6d::adjointOf(X) * motion;
  const auto identity = Eigen::Isometry3d::Identity();
  // Second order of 1e-7, and rounding of some metres.
  EXPECT_LT(
      (moved(X, motion).matrix() - (moved(identity, carried) * X).matrix()).norm(),
      1e-12);
}

TEST(Chi2, SumsOverTheLinks)
{
  PoseGraph graph;
  graph.poses.assign(2, Eigen::Isometry3d::Identity());
  PoseLink link{0, 1, Eigen::Isometry3d::Identity(), {}};
  link.information.setIdentity();
  link.information(0, 0) = 5;
  link.information(0, 1) = link.information(1, 0) = 1;
  link.T_from_to.translation() = Eigen::Vector3d(-2, -3, 0);
  graph.links = {link, link};
  EXPECT_NEAR(chi2Of(graph), 2 * (5 * 4 + 2 * 6 + 9), 1e-12);
  EXPECT_EQ(chi2Of(PoseGraph()), 0);
}

TEST(PoseGraphCheck, NamesWhatBreaksARule)
{
  const auto messageOf = [](const auto& spoil) -> std::string {
    PoseGraph graph = pcl6d::test::ringGraph(6, 0.1, 1);
    spoil(graph);
    try {
      pcl6d::checkPoseGraph(graph);
    } catch (const pcl6d::BadArgument& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(messageOf([](PoseGraph&) {}), "no error");
  EXPECT_EQ(messageOf([](PoseGraph& g) { g.poses[2].translation().x() = NAN; }),
            "pose 2 is no rigid motion");
  EXPECT_EQ(messageOf([](PoseGraph& g) { g.links[1].to = 6; }),
            "link 1 joins poses 1 and 6, but there are only 6");
  EXPECT_EQ(messageOf([](PoseGraph& g) { g.links[1].to = 1; }),
            "link 1 joins pose 1 with itself");
  EXPECT_EQ(messageOf([](PoseGraph& g) { g.links[3].T_from_to.linear() *= 2; }),
            "link 3 measures no rigid motion");
  EXPECT_EQ(messageOf([](PoseGraph& g) { g.links[3].information(0, 1) += 1; }),
            "link 3 has information that is not symmetric");
  EXPECT_EQ(messageOf([](PoseGraph& g) { g.links[3].information(2, 2) = INFINITY; }),
            "link 3 has information that is not finite");
  EXPECT_EQ(messageOf([](PoseGraph& g) { g.links[3].information(2, 2) = -1; }),
            "link 3 has information that is not positive semidefinite");
  const auto couple = [](PoseGraph& g) { // the diagonal alone would do
    g.links[3].information.setIdentity();
    g.links[3].information(0, 1) = g.links[3].information(1, 0) = 5;
  };
  EXPECT_EQ(messageOf(couple),
            "link 3 has information that is not positive semidefinite");
}
