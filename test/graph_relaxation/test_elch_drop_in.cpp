// SPDX-License-Identifier: BSD-3-Clause
// Compiled twice: what holds for pcl::registration::ELCH holds for ours. Headings are near
// zero, and results are read from the graph, where both put them.
#include "support/clouds.h"
#include "support/pcl_peers.h"
#include "support/points.h"
#include "support/room.h"

#ifdef PCL6D_TEST_PEER
#include <pcl/registration/elch.h>
namespace under_test = pcl::registration;
// PCL's class leaks its weights.
extern "C" const char*
__asan_default_options();
const char*
__asan_default_options()
{
  return "detect_leaks=0";
}
#else
#include <pcl6d/graph_relaxation/pcl/elch.h>
namespace under_test = pcl6d;
#endif

namespace pcl6d::test {

namespace {
using Point = pcl::PointXYZ;
using ElchUnderTest = under_test::ELCH<Point>;
constexpr float kTol = 1e-6f; // [m], float, a few metres

pcl::PointCloud<Point>::Ptr
cubeAt(const Eigen::Vector3d& centre)
{
  Random random(9);
  Points points = randomCube(random, 50, 1);
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for (const auto& p : points)
    mean += p / 50;
  for (auto& p : points)
    p += centre.cast<float>() - mean;
  return toCloud<Point>(points);
}

/** Five clouds a metre apart. */
ElchUnderTest
makeRow()
{
  ElchUnderTest elch;
  for (int i = 0; i < 5; ++i)
    elch.addPointCloud(cubeAt({1.0 * i, 0, 0}));
  elch.setLoopStart(0);
  elch.setLoopEnd(4);
  return elch;
}
} // namespace

TEST(ElchDropIn, SharesATranslationEvenly)
{
  ElchUnderTest elch = makeRow();
  Eigen::Matrix4f motion = Eigen::Matrix4f::Identity();
  motion.topRightCorner<3, 1>() = Eigen::Vector3f(0.4f, -0.2f, 0.1f);
  elch.setLoopTransform(motion);
  elch.compute();
  for (int i = 0; i < 5; ++i) {
    const auto& vertex = (*elch.getLoopGraph())[i];
    const Eigen::Vector3f shift = 0.25f * i * motion.topRightCorner<3, 1>();
    EXPECT_LT((vertex.transform.translation() - shift).norm(), kTol);
    EXPECT_LT((vertex.transform.linear() - Eigen::Matrix3f::Identity()).norm(), kTol);
    const auto before = cubeAt({1.0 * i, 0, 0});
    for (std::size_t k = 0; k < before->size(); ++k)
      EXPECT_LT(
          ((*vertex.cloud)[k].getVector3fMap() - shift - (*before)[k].getVector3fMap())
              .norm(),
          2 * kTol);
  }
}

TEST(ElchDropIn, MovesTheEndByTheLoopTransformAndTheStartNotAtAll)
{
  ElchUnderTest elch = makeRow();
  const Eigen::Matrix4f motion =
      poseFromEuler({0.1, 0.2, -0.1}, {0.02, -0.01, 0.03}).matrix().cast<float>();
  elch.setLoopTransform(motion);
  elch.compute();
  auto& graph = *elch.getLoopGraph();
  EXPECT_LT((graph[0].transform.matrix() - Eigen::Matrix4f::Identity()).norm(), kTol);
  EXPECT_LT((graph[4].transform.matrix() - motion).norm(), kTol);
  EXPECT_TRUE(edge(0, 4, graph).second); // the loop is in the graph now
  EXPECT_EQ(num_edges(graph), 5u);
}

TEST(ElchDropIn, GivesABranchTheWeightOfItsRoot)
{
  ElchUnderTest elch = makeRow();
  const auto graph = elch.getLoopGraph();
  const auto branch = add_vertex(*graph);
  (*graph)[branch].cloud = cubeAt({1, 1, 0});
  add_edge(1, branch, *graph);
  Eigen::Matrix4f motion = Eigen::Matrix4f::Identity();
  motion(2, 3) = 0.8f;
  elch.setLoopGraph(graph);
  elch.setLoopTransform(motion);
  elch.compute();
  EXPECT_NEAR((*graph)[1].transform(2, 3), 0.2f, kTol);
  EXPECT_NEAR((*graph)[branch].transform(2, 3), 0.2f, kTol);
}

TEST(ElchDropIn, RegistersTheLoopAndSpreadsItsError)
{
  // Scans of a corner that drift by 2 cm and 2 mrad each; the last sees the first again.
  ElchUnderTest elch;
  Random random(10);
  std::vector<Eigen::Isometry3d> drift;
  for (int i = 0; i < 6; ++i) {
    drift.push_back(poseFromEuler({0.02 * i, -0.01 * i, 0.01 * i}, {0, 0, 0.002 * i}));
    elch.addPointCloud(
        toCloud<Point>(transformed(roomCorner(random, 1500, 4, 0.003), drift.back())));
  }
  elch.setLoopStart(0);
  elch.setLoopEnd(5);
  elch.compute();
  const auto& graph = *elch.getLoopGraph();
  const auto errorOf = [&](int i) {
    const Eigen::Isometry3d moved(graph[i].transform.cast<double>().matrix());
    return distanceBetween(Eigen::Isometry3d::Identity(), moved * drift[i]).translation;
  };
  // Not to zero: each end is a pair of scans that drift, by 2.5 cm.
  EXPECT_LT(errorOf(5), 0.5 * drift[5].translation().norm());
  EXPECT_LT(errorOf(3), 0.7 * drift[3].translation().norm());
  EXPECT_LT(
      (Eigen::Isometry3d(elch.getLoopTransform().template cast<double>()).matrix() -
       graph[5].transform.cast<double>().matrix())
          .norm(),
      2 * kTol); // PCL moves by the product of two motions, rounded to float
}

TEST(ElchDropIn, ClosesTheLoopAtTheIterationLimitAndSaysSo)
{
  ElchUnderTest elch;
  Random random(10);
  std::vector<pcl::PointCloud<Point>::Ptr> clouds;
  for (int i = 0; i < 4; ++i) {
    clouds.push_back(toCloud<Point>(transformed(
        roomCorner(random, 1500, 4, 0.003),
        poseFromEuler({0.03 * i, -0.02 * i, 0.01 * i}, {0, 0, 0.004 * i}))));
    elch.addPointCloud(clouds.back());
  }
  const Eigen::Vector3f before = clouds[3]->front().getVector3fMap();
  elch.setLoopEnd(3);
  elch.getReg()->setMaximumIterations(3);
  elch.compute();
#ifndef PCL6D_TEST_PEER
  EXPECT_EQ(elch.status(), Status::kMaxIterations);
#endif
  EXPECT_GT((clouds[3]->front().getVector3fMap() - before).norm(), 0.01f);
}

TEST(ElchDropIn, GivesBackWhatWasSet)
{
  ElchUnderTest elch = makeRow();
  EXPECT_EQ(elch.getLoopStart(), 0u);
  EXPECT_EQ(elch.getLoopEnd(), 4u);
  const ElchUnderTest::RegistrationPtr reg(
      new pcl::IterativeClosestPoint<Point, Point>);
  elch.setReg(reg);
  EXPECT_EQ(elch.getReg(), reg);
  const ElchUnderTest::LoopGraphPtr graph(new ElchUnderTest::LoopGraph);
  elch.setLoopGraph(graph);
  EXPECT_EQ(elch.getLoopGraph(), graph);
  const Eigen::Matrix4f motion =
      poseFromEuler({1, 2, 3}, {0, 0, 0.1}).matrix().cast<float>();
  elch.setLoopTransform(motion);
  EXPECT_EQ(elch.getLoopTransform(), motion);
}

} // namespace pcl6d::test
