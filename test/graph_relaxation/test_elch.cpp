// SPDX-License-Identifier: BSD-3-Clause
#include "support/bits.h"
#include "support/clouds.h"
#include "support/points.h"
#include "support/room.h"

#include <pcl6d/graph_relaxation/pcl/elch.h>
#include <pcl6d/registration/pcl/icp6d.h>

#include <pcl/common/io.h>

namespace pcl6d::test {

namespace {
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
using Elch = ELCH<Point>;

/** Six clouds on a bent path, closed by a motion with rotation; all in a moved world. */
struct Path {
  explicit Path(const Eigen::Isometry3d& world = Eigen::Isometry3d::Identity())
  {
    Random random(11);
    for (int i = 0; i < 6; ++i) {
      const Eigen::Isometry3d place =
          world * poseFromEuler({2.0 * i, 0.3 * i * i, 0.1 * i}, {0, 0, 0.2 * i});
      clouds.push_back(toCloud<Point>(transformed(randomCube(random, 40, 3), place)));
      elch.addPointCloud(clouds.back());
    }
    elch.setLoopEnd(5);
    const Eigen::Isometry3d motion =
        world * poseFromEuler({0.3, 0.1, -0.2}, {0.05, 0.1, 0.2}) * world.inverse();
    elch.setLoopTransform(motion.matrix().cast<float>());
  }

  const Cloud&
  result(int i) const
  {
    return *(*elch.getLoopGraph())[i].cloud;
  }

  Elch elch;
  std::vector<Cloud::Ptr> clouds;
};
} // namespace

TEST(Elch, LeavesTheCloudsOfTheCallerAloneIfAsked)
{
  Path path;
  path.elch.setModifyInputClouds(false);
  std::vector<Points> before;
  for (const auto& cloud : path.clouds)
    before.push_back(toPoints(*cloud));
  path.elch.compute();
  EXPECT_EQ(path.elch.status(), Status::kOk);
  for (int i = 0; i < 6; ++i) {
    expectSamePoints(toPoints(*path.clouds[i]), before[i]);
    expectSamePoints(toPoints(path.result(i)),
                     transformed(before[i], path.elch.corrections()[i]));
    EXPECT_TRUE((*path.elch.getLoopGraph())[i].transform.matrix() ==
                path.elch.corrections()[i].matrix().cast<float>());
  }
}

TEST(Elch, MovesTheCloudsOfTheCallerAsPclDoes)
{
  Path path, untouched;
  untouched.elch.setModifyInputClouds(false);
  untouched.elch.compute();
  path.elch.compute();
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ((*path.elch.getLoopGraph())[i].cloud, path.clouds[i]);
    expectSamePoints(toPoints(*path.clouds[i]), toPoints(untouched.result(i)));
  }
}

TEST(Elch, MovesWithTheWorld)
{
  Random random(12);
  Path path;
  path.elch.compute();
  const Eigen::Isometry3d world = randomPose(random, 50, 2);
  Path moved(world);
  moved.elch.compute();
  for (int i = 0; i < 6; ++i) {
    const Points expected = transformed(toPoints(path.result(i)), world);
    const Points found = toPoints(moved.result(i));
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_LT((found[k] - expected[k]).norm(), 1e-4) << i; // float, at 50 m
  }
}

TEST(Elch, SharesTheErrorByLengthUnlessCovariancesAreKnown)
{
  const auto row = [](double at) {
    Elch elch;
    for (const double x : {0.0, at, 4.0})
      elch.addPointCloud(toCloud<Point>({{0, 0, 0}}), {x, 0, 0});
    elch.setLoopEnd(2);
    Eigen::Matrix4f motion = Eigen::Matrix4f::Identity();
    motion(1, 3) = 1;
    elch.setLoopTransform(motion);
    return elch;
  };
  Elch by_length = row(1);
  by_length.compute();
  EXPECT_NEAR(by_length.corrections()[1].translation().y(), 0.25, 1e-12);

  Elch by_covariance = row(1);
  by_covariance.setEdgeCovariance(0, 1, 3 * Elch::Covariance::Identity());
  by_covariance.setEdgeCovariance(2, 1, 1 * Elch::Covariance::Identity());
  by_covariance.compute();
  EXPECT_NEAR(by_covariance.corrections()[1].translation().y(), 0.75, 1e-12);

  Elch per_axis = row(1);
  per_axis.setWeightsPerAxis(true);
  Elch::Covariance flat = Elch::Covariance::Identity();
  flat(1, 1) = 4;
  per_axis.setEdgeCovariance(0, 1, flat);
  per_axis.setEdgeCovariance(1, 2, Elch::Covariance::Identity());
  per_axis.compute();
  EXPECT_NEAR(per_axis.corrections()[1].translation().y(), 0.8, 1e-12);

  Elch partly = row(1); // an edge that nothing is known of is as the others
  partly.setEdgeCovariance(0, 1, 3 * Elch::Covariance::Identity());
  partly.compute();
  EXPECT_NEAR(partly.corrections()[1].translation().y(), 0.5, 1e-12);
}

TEST(Elch, ClosesALoopAfterAnother)
{
  Path path;
  path.elch.setLoopEnd(3);
  path.elch.compute();
  path.elch.addPointCloud(path.clouds[0]);
  EXPECT_TRUE(edge(5, 6, *path.elch.getLoopGraph()).second);
  path.elch.setLoopEnd(6);
  path.elch.compute();
  EXPECT_EQ(path.elch.status(), Status::kOk);
  EXPECT_EQ(path.elch.corrections().size(), 7u);
  EXPECT_TRUE(edge(0, 3, *path.elch.getLoopGraph()).second);
  EXPECT_TRUE(edge(0, 6, *path.elch.getLoopGraph()).second);
}

TEST(Elch, ChangesNothingIfTheRegistrationDoesNotConverge)
{
  Elch elch;
  Random random(13);
  std::vector<Cloud::Ptr> clouds;
  for (int i = 0; i < 4; ++i) {
    clouds.push_back(toCloud<Point>(randomCube(random, 100, 1)));
    for (auto& p : *clouds.back())
      p.x += 100 * i;
    elch.addPointCloud(clouds.back());
  }
  elch.setLoopEnd(3);
  elch.getReg()->setMaxCorrespondenceDistance(0.5);
  EXPECT_EQ(elch.status(), Status::kTooFewPairs);
  elch.compute();
  EXPECT_EQ(elch.status(), Status::kDiverged);
  EXPECT_TRUE(elch.corrections().empty());
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ((*elch.getLoopGraph())[i].cloud, clouds[i]);
    EXPECT_TRUE((*elch.getLoopGraph())[i].transform.matrix() ==
                Eigen::Matrix4f::Identity());
  }
  EXPECT_EQ(num_edges(*elch.getLoopGraph()), 3u);
}

TEST(Elch, RefusesHalfATurnAndSaysWhereNothingJoinsTheLoop)
{
  Path path;
  path.elch.setLoopTransform(
      poseFromEuler({0, 0, 0}, {0, 0, M_PI}).matrix().cast<float>());
  path.elch.compute();
  EXPECT_EQ(path.elch.status(), Status::kDiverged);
  EXPECT_EQ((*path.elch.getLoopGraph())[5].cloud, path.clouds[5]);

  Path torn;
  remove_edge(2, 3, *torn.elch.getLoopGraph());
  torn.elch.compute();
  EXPECT_EQ(torn.elch.status(), Status::kRankDeficient);
  for (const auto& correction : torn.elch.corrections())
    EXPECT_TRUE(isRigid(correction));
}

TEST(Elch, SkipsPointsThatAreNotFinite)
{
  Path path, spoilt;
  spoilt.clouds[2]->push_back({kNan, 0, 0});
  spoilt.clouds[2]->is_dense = false;
  path.elch.compute();
  spoilt.elch.compute();
  for (int i = 0; i < 6; ++i)
    EXPECT_TRUE(sameBits(path.elch.corrections()[i], spoilt.elch.corrections()[i]));
}

TEST(Elch, RefusesWhatIsNoLoop)
{
  Elch empty;
  EXPECT_EQ(badArgumentOf([&] { empty.compute(); }),
            "loop start = 0, but must be less than the 0 scans");
  EXPECT_EQ(badArgumentOf([&] { empty.addPointCloud(nullptr); }),
            "cloud = null, but must be given");
  EXPECT_NE(badArgumentOf([&] { empty.setReg(nullptr); }), "");
  EXPECT_NE(badArgumentOf([&] { empty.setLoopGraph(nullptr); }), "");
  EXPECT_NE(
      badArgumentOf([&] { empty.setLoopTransform(Eigen::Matrix4f::Constant(kNan)); }),
      "");
  Path path;
  EXPECT_EQ(badArgumentOf([&] {
              path.elch.setEdgeCovariance(0, 2, Elch::Covariance::Identity());
            }),
            "edge = 0 to 2, but must be one of the loop graph");
  EXPECT_NE(badArgumentOf([&] {
              path.elch.setEdgeCovariance(0, 99, Elch::Covariance::Identity());
            }),
            "");
  path.elch.setLoopEnd(0);
  EXPECT_EQ(badArgumentOf([&] { path.elch.compute(); }),
            "loop end = 0, but must be another scan than the start");
  path.elch.setLoopEnd(6);
  EXPECT_EQ(badArgumentOf([&] { path.elch.compute(); }),
            "loop end = 6, but must be less than the 6 scans");
  path.elch.setLoopEnd(5);
  (*path.elch.getLoopGraph())[2].cloud.reset(new Cloud);
  EXPECT_EQ(badArgumentOf([&] { path.elch.compute(); }),
            "finite points of vertex 2 = 0, but must be at least 1 unless it has a "
            "position");
  (*path.elch.getLoopGraph())[2].cloud.reset();
  EXPECT_EQ(badArgumentOf([&] { path.elch.compute(); }),
            "cloud of vertex 2 = null, but must be given");
}

TEST(Elch, TurnsNormalsWithTheirPoints)
{
  ELCH<pcl::PointNormal> elch;
  for (int i = 0; i < 3; ++i) {
    const auto cloud = toCloud<pcl::PointNormal>({{1.f * i, 0, 0}, {1.f * i, 1, 0}});
    for (auto& p : *cloud)
      p.getNormalVector3fMap() = Eigen::Vector3f::UnitX();
    elch.addPointCloud(cloud);
  }
  elch.setLoopEnd(2);
  elch.setLoopTransform(poseFromEuler({0, 0, 0}, {0, 0, 0.4}).matrix().cast<float>());
  elch.compute();
  const auto& normal = (*(*elch.getLoopGraph())[1].cloud)[0].getNormalVector3fMap();
  EXPECT_LT((normal - Eigen::Vector3f(std::cos(0.2f), std::sin(0.2f), 0)).norm(), 1e-6);
}

} // namespace pcl6d::test
