// SPDX-License-Identifier: BSD-3-Clause
#include "ring_graph.h"

#include <pcl6d/common/error.h>
#include <pcl6d/graph_relaxation/pcl/lum.h>

#include <gtest/gtest.h>

using namespace pcl6d;
using namespace pcl6d::test;

namespace {
using Point = pcl::PointXYZ;
using Lum = pcl6d::LUM<Point>;

/** Fills a graph in which the first pose is zero. */
GraphCase
fillRing(Lum& lum, double noise)
{
  GraphRecipe recipe; // headings cover the full circle
  recipe.noise = noise;
  GraphCase graph = makeGraph(recipe);
  const Eigen::Isometry3d to_first = graph.truth[0].inverse();
  std::vector<Lum::PointCloudPtr> clouds;
  for (std::size_t i = 0; i < graph.start.size(); ++i) {
    graph.truth[i] = to_first * graph.truth[i];
    graph.start[i] = to_first * graph.start[i];
    clouds.push_back(pcl::make_shared<Lum::PointCloud>());
    lum.addPointCloud(clouds.back());
    if (i > 0)
      lum.setPose3d(i, graph.start[i]);
  }
  graph.start[0] = Eigen::Isometry3d::Identity();
  for (const LinkPairs& link : graph.links) {
    const auto matches = pcl::make_shared<pcl::Correspondences>();
    for (std::size_t k = 0; k < link.points_from.size(); ++k) {
      const auto &u = link.points_from[k], &v = link.points_to[k];
      matches->emplace_back(static_cast<int>(clouds[link.from]->size()),
                            static_cast<int>(clouds[link.to]->size()),
                            0);
      clouds[link.from]->push_back(Point(u.x(), u.y(), u.z()));
      clouds[link.to]->push_back(Point(v.x(), v.y(), v.z()));
    }
    lum.setCorrespondences(link.from, link.to, matches);
  }
  return graph;
}
} // namespace

TEST(Lum, ConvergesForAllHeadings)
{
  Lum lum;
  const GraphCase graph = fillRing(lum, 0.01);
  lum.setMaxIterations(20);
  lum.compute();
  EXPECT_EQ(lum.result().status, Status::kOk);
  EXPECT_LT(lum.result().rms, 0.04);
  for (std::size_t i = 0; i < graph.truth.size(); ++i)
    EXPECT_LT(distanceBetween(lum.getPose3d(i), graph.truth[i]).translation, 0.02);
}

TEST(Lum, SaysWhenFiveIterationsWereNotEnough)
{
  Lum lum;
  fillRing(lum, 0.05);
  lum.setMaxIterations(1);
  lum.compute();
  EXPECT_EQ(lum.result().status, Status::kMaxIterations);
  EXPECT_EQ(lum.result().iterations, 1);
}

TEST(Lum, KeepsPosesInDoubleUntilTheFloatOnesChange)
{
  Lum lum;
  const GraphCase graph = fillRing(lum, 0.05);
  const Eigen::Isometry3d kept = lum.getPose3d(3);
  EXPECT_EQ(kept.matrix(), graph.start[3].matrix());
  EXPECT_LT(distanceBetween(lum.getPose3d(4), graph.start[4]).translation, 1e-15);
  Lum::Vector6f pose;
  pose << 1, 2, 3, 0.1f, 0.2f, 0.3f;
  lum.setPose(3, pose);
  EXPECT_NEAR(lum.getPose3d(3).translation().z(), 3, 1e-6);
  EXPECT_EQ(lum.getPose(3), pose);
  lum.setPose3d(3, kept);
  (*lum.getLoopGraph())[3].pose_ = pose; // past our back
  EXPECT_NEAR(lum.getPose3d(3).translation().z(), 3, 1e-6);
}

TEST(Lum, FixesTheFirstPoseAtZero)
{
  Lum lum;
  Lum::Vector6f pose;
  pose << 1, 2, 3, 0, 0, 0;
  lum.addPointCloud(pcl::make_shared<Lum::PointCloud>(), pose);
  EXPECT_EQ(lum.getPose(0), Lum::Vector6f::Zero());
  lum.setPose(0, pose);
  EXPECT_EQ(lum.getPose(0), Lum::Vector6f::Zero());
}

TEST(Lum, HasNoAnswerWithoutPairs)
{
  Lum lum;
  lum.compute();
  EXPECT_EQ(lum.result().status, Status::kTooFewPairs);
  Lum::Vector6f pose;
  pose << 1, 2, 3, 0.1f, 0.2f, 0.3f;
  lum.addPointCloud(pcl::make_shared<Lum::PointCloud>());
  lum.addPointCloud(pcl::make_shared<Lum::PointCloud>(3, 1), pose);
  lum.compute();
  EXPECT_EQ(lum.result().status, Status::kTooFewPairs);
  EXPECT_EQ(lum.getPose(1), pose);
}

TEST(Lum, LeavesOutEdgesWithoutPairs)
{
  Lum lum;
  const GraphCase graph = fillRing(lum, 0.01);
  (*lum.getLoopGraph())[boost::edge(0, 5, *lum.getLoopGraph()).first].corrs_.reset();
  lum.setMaxIterations(20);
  lum.compute();
  EXPECT_EQ(lum.result().status, Status::kOk);
  EXPECT_LT(distanceBetween(lum.getPose3d(5), graph.truth[5]).translation, 0.02);
  const auto edge = boost::edge(0, 5, *lum.getLoopGraph()).first;
  EXPECT_EQ((*lum.getLoopGraph())[edge].cinv_.norm(), 0);
}

TEST(Lum, ThrowsWherePclLeavesUndefinedWhatHappens)
{
  Lum lum;
  fillRing(lum, 0.01);
  const auto matches = pcl::make_shared<pcl::Correspondences>();
  EXPECT_THROW(lum.setLoopGraph(nullptr), BadArgument);
  EXPECT_THROW(lum.getTransformedCloud(10), BadArgument);
  matches->emplace_back(100000, 0, 0);
  lum.setCorrespondences(0, 5, matches);
  EXPECT_THROW(lum.compute(), BadArgument);
  lum.setCorrespondences(0, 5, pcl::make_shared<pcl::Correspondences>());
  EXPECT_NO_THROW(lum.compute());
  lum.setCorrespondences(0, 5, nullptr);
  EXPECT_NO_THROW(lum.compute());
  (*lum.getLoopGraph())[3].cloud_.reset();
  EXPECT_THROW(lum.compute(), BadArgument);
  EXPECT_THROW(lum.getConcatenatedCloud(), BadArgument);
}

TEST(Lum, LeavesPosesThatAreNotFiniteAlone)
{
  Lum lum;
  fillRing(lum, 0.01);
  Lum::Vector6f broken = Lum::Vector6f::Zero();
  broken(1) = NAN;
  const Lum::Vector6f before = lum.getPose(3);
  lum.setPose(4, broken);
  lum.compute();
  EXPECT_EQ(lum.result().status, Status::kDiverged);
  EXPECT_EQ(lum.getPose(3), before);
  EXPECT_TRUE(std::isnan(lum.getPose(4)(1)));
  EXPECT_EQ(lum.getPose(4)(0), 0);
}

TEST(Lum, ReportsWhatDoesNotExistAndGoesOn)
{
  Lum lum;
  fillRing(lum, 0.01);
  EXPECT_EQ(lum.getPose3d(10).matrix(), Eigen::Matrix4d::Identity());
  lum.setPose3d(10, Eigen::Isometry3d::Identity());
  EXPECT_EQ(lum.getNumVertices(), 10u);
  lum.setMaxIterations(0);
  lum.compute();
  EXPECT_EQ(lum.result().status, Status::kMaxIterations);
  EXPECT_EQ(lum.result().iterations, 0);
}
