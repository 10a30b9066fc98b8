// SPDX-License-Identifier: BSD-3-Clause
#include "graph_cases.h"

#include <pcl6d/common/error.h>
#include <pcl6d/graph_relaxation/link_error.h>
#include <pcl6d/graph_relaxation/merge_links.h>

#include <gtest/gtest.h>

using pcl6d::Matrix6;
using pcl6d::mergeLinks;
using pcl6d::PoseGraph;
using pcl6d::PoseLink;

namespace {
double
chi2Of(const PoseLink& link, const Eigen::Isometry3d& T_from_to)
{
  const auto error = pcl6d::linkError(link, Eigen::Isometry3d::Identity(), T_from_to);
  return error.dot(link.information * error);
}

Eigen::Isometry3d
near(const PoseLink& link, double size, std::uint64_t seed)
{
  pcl6d::Random random(seed);
  return pcl6d::test::disturbed(link.T_from_to, random, size);
}
} // namespace

TEST(ReversedLink, HasTheSameErrorToFirstOrder)
{
  const PoseLink link = pcl6d::test::ringGraph(6, 0.1, 1).links[2];
  const PoseLink back = reversed(link);
  EXPECT_EQ(back.from, link.to);
  EXPECT_EQ(back.to, link.from);
  for (const double size : {1e-2, 1e-3, 1e-4}) {
    const auto pose = near(link, size, 7);
    const double forward = chi2Of(link, pose);
    // The square differs by a share that goes to zero with the error.
    EXPECT_NEAR(chi2Of(back, pose.inverse()), forward, 20 * size * forward);
  }
}

TEST(ReversedLink, TwiceIsTheLink)
{
  const PoseLink link = pcl6d::test::ringGraph(6, 0.1, 1).links[2];
  const PoseLink twice = reversed(reversed(link));
  EXPECT_TRUE(twice.T_from_to.isApprox(link.T_from_to, 1e-14));
  EXPECT_TRUE(twice.information.isApprox(link.information, 1e-12));
}

TEST(MergeLinks, LeavesSingleLinksAlone)
{
  const PoseGraph graph = pcl6d::test::ringGraph(8, 0.1, 1);
  const auto links = mergeLinks(graph);
  ASSERT_EQ(links.size(), graph.links.size());
  for (std::size_t k = 0; k < links.size(); ++k) {
    EXPECT_EQ(links[k].from, graph.links[k].from);
    EXPECT_EQ(links[k].information, graph.links[k].information);
    EXPECT_EQ(links[k].T_from_to.matrix(), graph.links[k].T_from_to.matrix());
  }
}

TEST(MergeLinks, AddsInformationAndWeighsMeasurements)
{
  PoseGraph graph;
  graph.poses.assign(2, Eigen::Isometry3d::Identity());
  PoseLink a, b;
  a.to = b.to = 1;
  a.T_from_to.translation().x() = 1;
  b.T_from_to.translation().x() = 2;
  a.information = 3 * Matrix6::Identity();
  graph.links = {a, b};
  const auto links = mergeLinks(graph);
  ASSERT_EQ(links.size(), 1u);
  EXPECT_TRUE(links[0].information.isApprox(4 * Matrix6::Identity(), 1e-14));
  EXPECT_NEAR(links[0].T_from_to.translation().x(), 1.25, 1e-14);
}

TEST(MergeLinks, KeepsTheSumOfErrorsUpToAConstant)
{
  PoseGraph graph = pcl6d::test::ringGraph(6, 0, 1);
  const PoseLink first = graph.links[2];
  PoseLink second = first, third = reversed(first);
  pcl6d::Random random(4);
  constexpr double kNoise = 1e-4;
  second.T_from_to = pcl6d::test::disturbed(second.T_from_to, random, kNoise);
  third.T_from_to = pcl6d::test::disturbed(third.T_from_to, random, kNoise);
  second.information = pcl6d::test::randomInformation(random);
  graph.links = {first, second, third};
  const auto links = mergeLinks(graph);
  ASSERT_EQ(links.size(), 1u);
  EXPECT_EQ(links[0].from, first.from);
  const auto difference = [&](const Eigen::Isometry3d& pose) {
    return chi2Of(first, pose) + chi2Of(second, pose) + chi2Of(third, pose.inverse()) -
           chi2Of(links[0], pose);
  };
  const double constant = difference(first.T_from_to);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const auto pose = near(first, 1e-3, seed);
    EXPECT_NEAR(difference(pose), constant, 2e-2 * chi2Of(links[0], pose));
  }
}

TEST(MergeLinks, RefusesSelfLinks)
{
  PoseGraph graph = pcl6d::test::ringGraph(6, 0.1, 1);
  graph.links[1].to = graph.links[1].from;
  EXPECT_THROW(mergeLinks(graph), pcl6d::BadArgument);
}
