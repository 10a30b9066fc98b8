// SPDX-License-Identifier: BSD-3-Clause
// One program of a user, compiled for PCL's class and for ours. Headings are near zero, as
// PCL's class diverges otherwise.
#include "ring_graph.h"

#include <pcl6d/graph_relaxation/pcl/lum.h>

#include <gtest/gtest.h>

using namespace pcl6d::test;

namespace {
using Point = pcl::PointXYZ;

template <typename Lum>
class LumProgram : public testing::Test {
protected:
  using Cloud = typename Lum::PointCloud;

  GraphCase graph = [] {
    GraphRecipe recipe;
    recipe.headings = 0;
    recipe.noise = 0.01;
    recipe.start_shift = 0.1;
    recipe.start_turn = 0.01;
    GraphCase made = makeGraph(recipe);
    const Eigen::Isometry3d to_first =
        made.truth[0].inverse(); // PCL's first pose is zero
    for (auto* poses : {&made.truth, &made.start})
      for (Eigen::Isometry3d& pose : *poses)
        pose = to_first * pose;
    return made;
  }();

  /** One cloud per scan holds the points of all its links, one after the other. */
  void
  fill(Lum& lum)
  {
    fill(lum, graph);
  }

  template <typename AnyLum>
  static void
  fill(AnyLum& lum, const GraphCase& graph)
  {
    std::vector<typename Cloud::Ptr> clouds;
    for (std::size_t i = 0; i < graph.start.size(); ++i) {
      clouds.push_back(typename Cloud::Ptr(new Cloud));
      const pcl6d::EulerAngles a = pcl6d::eulerFromRotation(graph.start[i].linear());
      Eigen::Matrix<float, 6, 1> pose;
      pose << graph.start[i].translation().cast<float>(), static_cast<float>(a.roll),
          static_cast<float>(a.pitch), static_cast<float>(a.yaw);
      lum.addPointCloud(clouds.back(), i == 0 ? pose * 0 : pose);
    }
    for (const auto& link : graph.links) {
      const pcl::CorrespondencesPtr matches(new pcl::Correspondences);
      for (std::size_t k = 0; k < link.points_from.size(); ++k) {
        const auto &u = link.points_from[k], &v = link.points_to[k];
        const int query = static_cast<int>(clouds[link.from]->size());
        const int match = static_cast<int>(clouds[link.to]->size());
        clouds[link.from]->push_back(Point(u.x(), u.y(), u.z()));
        clouds[link.to]->push_back(Point(v.x(), v.y(), v.z()));
        matches->push_back(pcl::Correspondence(query, match, 0));
      }
      lum.setCorrespondences(link.from, link.to, matches);
    }
  }

  static Poses
  posesOf(const Lum& lum)
  {
    Poses poses;
    for (int i = 0; i < static_cast<int>(lum.getNumVertices()); ++i) {
      const auto& pose = (*lum.getLoopGraph())[i].pose_;
      poses.push_back(
          pcl6d::poseFromEuler(pose.template head<3>().template cast<double>(),
                               {pose(3), pose(4), pose(5)}));
    }
    return poses;
  }
};

using Classes = testing::Types<pcl::registration::LUM<Point>, pcl6d::LUM<Point>>;
TYPED_TEST_SUITE(LumProgram, Classes);
} // namespace

TYPED_TEST(LumProgram, BringsTheScansTogether)
{
  TypeParam lum;
  EXPECT_EQ(lum.getMaxIterations(), 5);
  EXPECT_EQ(lum.getConvergenceThreshold(), 0);
  this->fill(lum);
  ASSERT_EQ(lum.getNumVertices(), 10u);
  EXPECT_GT(largestDistance(this->posesOf(lum), this->graph.truth), 0.1);
  lum.setMaxIterations(20);
  lum.setConvergenceThreshold(1e-6f);
  lum.compute();
  // 60 pairs with 1 cm: millimetres.
  EXPECT_LT(largestDistance(this->posesOf(lum), this->graph.truth), 0.01);
  EXPECT_LT(largestTurn(this->posesOf(lum), this->graph.truth), 2e-3);
  EXPECT_EQ(lum.getPose(0), Eigen::Vector6f::Zero());
}

TYPED_TEST(LumProgram, HandsOutItsCloudsAndPairs)
{
  TypeParam lum;
  this->fill(lum);
  lum.compute();
  const auto matches = lum.getCorrespondences(2, 3);
  ASSERT_TRUE(matches);
  EXPECT_EQ(matches->size(), 60u);
  const auto moved = lum.getTransformedCloud(3);
  const auto cloud = lum.getPointCloud(3);
  ASSERT_EQ(moved->size(), cloud->size());
  const Eigen::Vector3f expected =
      lum.getTransformation(3) * (*cloud)[5].getVector3fMap();
  EXPECT_LT((expected - (*moved)[5].getVector3fMap()).norm(), 1e-5f);
  EXPECT_EQ(lum.getConcatenatedCloud()->size(), 2 * 60 * this->graph.links.size());
}

TYPED_TEST(LumProgram, ReportsCallsWithoutAnAnswerAndReturns)
{
  using Points = typename TypeParam::PointCloud;
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); // they are many
  TypeParam lum;
  lum.compute(); // of nothing
  const auto first = lum.addPointCloud(nullptr);
  EXPECT_EQ(lum.getPointCloud(first), nullptr);
  const typename Points::Ptr cloud(new Points);
  lum.setPointCloud(first, cloud);
  EXPECT_EQ(lum.getPointCloud(first), cloud);
  lum.addPointCloud(cloud);
  EXPECT_EQ(lum.getPose(7), Eigen::Vector6f::Zero());
  EXPECT_EQ(lum.getPointCloud(7), nullptr);
  EXPECT_EQ(lum.getTransformation(7).matrix(), Eigen::Matrix4f::Identity());
  lum.setPose(7, Eigen::Vector6f::Ones());
  lum.setPointCloud(7, cloud);
  EXPECT_EQ(lum.getCorrespondences(0, 1), nullptr);
  EXPECT_EQ(lum.getCorrespondences(0, 7), nullptr);
  const pcl::CorrespondencesPtr matches(new pcl::Correspondences);
  lum.setCorrespondences(0, 0, matches);
  lum.setCorrespondences(0, 7, matches);
  EXPECT_EQ(num_edges(*lum.getLoopGraph()), 0u);
  lum.setMaxIterations(0);
  lum.compute();
  EXPECT_EQ(lum.getNumVertices(), 2u);
  EXPECT_EQ(lum.getPose(1), Eigen::Vector6f::Zero());
  pcl::console::setVerbosityLevel(pcl::console::L_INFO);
}

TYPED_TEST(LumProgram, KeepsTheWeightOfEachEdge)
{
  // Both at the same poses, which the pairs hardly change any more.
  this->graph.start = this->graph.truth;
  TypeParam lum;
  pcl::registration::LUM<Point> peer;
  LumProgram<TypeParam>::fill(lum, this->graph);
  LumProgram<TypeParam>::fill(peer, this->graph);
  lum.setMaxIterations(20);
  peer.setMaxIterations(20);
  lum.compute();
  peer.compute();
  const auto edges = lum.getLoopGraph(), peer_edges = peer.getLoopGraph();
  const auto [first, last] = boost::edges(*edges);
  for (auto e = first; e != last; ++e) {
    const auto& ours = (*edges)[*e];
    const auto& theirs =
        (*peer_edges)[boost::edge(source(*e, *edges), target(*e, *edges), *peer_edges)
                          .first];
    const float factor = ours.cinv_(0, 0) / theirs.cinv_(0, 0);
    EXPECT_GT(factor, 0);
    const Eigen::Matrix<float, 6, 6> information = factor * theirs.cinv_;
    const Eigen::Matrix<float, 6, 1> moment = factor * theirs.cinvd_;
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) {
        const float size = std::sqrt(information(i, i) * information(j, j));
        EXPECT_NEAR(ours.cinv_(i, j), information(i, j), 1e-3 * size)
            << "entry " << i << ' ' << j;
      }
      // A moment is the information times about a millimetre.
      EXPECT_NEAR(ours.cinvd_(i),
                  moment(i),
                  1e-3 * std::sqrt(information(i, i) * information(0, 0)) * 0.1)
          << "entry " << i;
    }
  }
}

TYPED_TEST(LumProgram, TakesOverAGraph)
{
  TypeParam lum, other;
  this->fill(lum);
  other.setLoopGraph(lum.getLoopGraph());
  EXPECT_EQ(other.getNumVertices(), 10u);
  other.setMaxIterations(10);
  other.compute();
  EXPECT_EQ(lum.getPose(4), other.getPose(4));
  EXPECT_LT(largestDistance(this->posesOf(lum), this->graph.truth), 0.01);
}
