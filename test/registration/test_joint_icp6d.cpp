// SPDX-License-Identifier: BSD-3-Clause
// Several pairs of clouds with one motion: PCL's class and ours.
#include "as_pcl_cases.h"

#include <cmath>
#include <limits>

using namespace pcl6d::test;
using pcl6d::Metric;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::Status;

namespace {
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
using Joint = pcl6d::JointICP6D<Point, Point>;

/** \return a wall of 2 m, across an axis, in a frame of its own */
Points
wall(int axis, std::uint64_t seed, double sigma = 0.002)
{
  Random random(seed);
  Points points;
  for (int i = 0; i < 900; ++i) {
    Eigen::Vector3d p(
        random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    p[axis] = 1 + sigma * random.normal();
    points.push_back(p.cast<float>());
  }
  return points;
}

Cloud::Ptr
moved(const Points& points)
{
  return toCloud<Point>(pcl6d::transformed(points, kCornerTruth.inverse()));
}

/** Adds three pairs of copies of a wall each, which only together fix the motion. */
template <typename Icp>
void
addWalls(Icp& icp)
{
  for (int axis = 0; axis < 3; ++axis) {
    icp.addInputSource(moved(wall(axis, axis + 1u)));
    icp.addInputTarget(toCloud<Point>(wall(axis, axis + 1u)));
  }
  icp.setMaxCorrespondenceDistance(0.3);
}
} // namespace

template <typename Side>
class JointAsPcl : public testing::Test {
protected:
  typename Side::template Joint<Point> icp_;
};
TYPED_TEST_SUITE(JointAsPcl, BothSides, NameOfSide);

TYPED_TEST(JointAsPcl, FindsTheMotionOfAllPairs)
{
  addWalls(this->icp_);
  this->icp_.setMaximumIterations(200);
  for (const bool reciprocal : {false, true}) {
    this->icp_.setUseReciprocalCorrespondences(reciprocal);
    alignFrom(this->icp_);
    EXPECT_TRUE(this->icp_.hasConverged());
    EXPECT_LT(errorOf(this->icp_).translation, 1e-4);
    EXPECT_LT(errorOf(this->icp_).rotation, 1e-4);
  }
}

TYPED_TEST(JointAsPcl, IsIcpForOnePair)
{
  this->icp_.addInputSource(cornerData<Point>());
  this->icp_.addInputTarget(cornerModel<Point>());
  this->icp_.setMaxCorrespondenceDistance(0.5);
  typename TypeParam::template Icp<Point> icp;
  setUpCorner(icp);
  alignFrom(this->icp_);
  alignFrom(icp);
  EXPECT_LT((icp.getFinalTransformation() - this->icp_.getFinalTransformation()).norm(),
            1e-4);
}

TYPED_TEST(JointAsPcl, TakesAnEstimationForEachPairAndRejectors)
{
  addWalls(this->icp_);
  for (int i = 0; i < 3; ++i)
    this->icp_.addCorrespondenceEstimation(
        pcl::make_shared<pcl::registration::CorrespondenceEstimation<Point, Point>>());
  const auto trimmed = pcl::make_shared<typename TypeParam::Trimmed>();
  trimmed->setOverlapRatio(0.9f);
  this->icp_.addCorrespondenceRejector(trimmed);
  this->icp_.setMaximumIterations(200);
  alignFrom(this->icp_);
  EXPECT_LT(errorOf(this->icp_).translation, 1e-3);
  EXPECT_EQ(trimmed->getInputCorrespondences()->size(), 2700u)
      << "of all pairs at once";
}

TYPED_TEST(JointAsPcl, StartsAnew)
{
  addWalls(this->icp_);
  this->icp_.clearInputSources();
  this->icp_.clearInputTargets();
  this->icp_.clearCorrespondenceEstimations();
  this->icp_.addInputSource(cornerData<Point>());
  this->icp_.addInputTarget(cornerModel<Point>());
  this->icp_.setMaxCorrespondenceDistance(0.5);
  alignFrom(this->icp_);
  EXPECT_LT(errorOf(this->icp_).translation, 1e-4);
}

TEST(OurJoint, DoesNotMixThePairs)
{
  // Two pairs in one place: the target of each is where the source of the other is.
  const Points first = cornerPoints(1);
  Points second;
  for (const auto& p : first)
    second.push_back(p + Eigen::Vector3f(0.04f, 0.04f, 0.04f));
  Joint icp;
  icp.addInputSource(moved(first));
  icp.addInputTarget(toCloud<Point>(first));
  icp.addInputSource(moved(second));
  icp.addInputTarget(toCloud<Point>(second));
  icp.setMaxCorrespondenceDistance(0.5);
  alignFrom(icp);
  EXPECT_TRUE(icp.hasConverged());
  EXPECT_LT(errorOf(icp).translation, kExactTol);
  EXPECT_EQ(icp.result().pairs, 2 * 1998u);
  EXPECT_EQ(icp.result().overlap, 1);
  EXPECT_LT(icp.getFitnessScore(), 1e-10);
}

TEST(OurJoint, SaysOfEachPairAloneThatItIsNotEnough)
{
  Joint all;
  all.setMetric(Metric::kPlane);
  addWalls(all);
  alignFrom(all);
  EXPECT_TRUE(all.hasConverged());
  EXPECT_LT(errorOf(all).translation, 1e-3);
  Joint one;
  one.setMetric(Metric::kPlane);
  one.addInputSource(moved(wall(0, 1)));
  one.addInputTarget(toCloud<Point>(wall(0, 2)));
  one.setMaxCorrespondenceDistance(0.3);
  alignFrom(one);
  EXPECT_FALSE(one.hasConverged());
  EXPECT_EQ(one.result().status, Status::kRankDeficient);
}

TEST(OurJoint, TakesNormalsFromTheirOwnCloud)
{
  // Walls across z and x that stand in one place: normals of the union would be wrong.
  for (const Metric metric : {Metric::kPlane, Metric::kGicp}) {
    Joint icp;
    icp.setMetric(metric);
    for (int axis = 0; axis < 3; ++axis)
      for (const std::uint64_t seed : {1u, 5u}) {
        Points source = wall(axis, seed), target = wall(axis, seed + 9);
        for (auto* points : {&source, &target})
          for (auto& p : *points)
            p[axis] -= 1; // all through the origin
        icp.addInputSource(moved(source));
        icp.addInputTarget(toCloud<Point>(target));
      }
    icp.setMaxCorrespondenceDistance(0.3);
    alignFrom(icp);
    EXPECT_TRUE(icp.hasConverged()) << toString(icp.result().status);
    EXPECT_LT(errorOf(icp).translation, 5e-4); // of 2 mm of noise on 1800 points a wall
    ASSERT_TRUE(icp.result().localizability);
    EXPECT_GT(icp.result().localizability->eigenvalues[0], 0.1);
  }
}

TEST(OurJoint, GivesTheSameBitsForAnyNumberOfThreads)
{
  Eigen::Matrix4f first = Eigen::Matrix4f::Zero();
  for (const unsigned int threads : {1u, 2u, 3u}) {
    Joint icp;
    icp.setNumberOfThreads(threads);
    icp.setUseReciprocalCorrespondences(true);
    addWalls(icp);
    alignFrom(icp);
    const Eigen::Matrix4f found = icp.getFinalTransformation();
    if (threads == 1)
      first = found;
    EXPECT_TRUE(sameBits(found, first));
  }
}

TEST(OurJoint, KeepsItsDigitsInUtmCoordinates)
{
  const Eigen::Vector3d far(512000, 5400064, 320);
  Eigen::Isometry3d at_place = kCornerTruth;
  at_place.pretranslate(far);
  pcl6d::JointICP6D<Point, Point, double> icp;
  // The targets have float coordinates of half a metre: planes of few digits, but exact.
  for (int axis = 0; axis < 3; ++axis) {
    Points target;
    for (int i = -8; i <= 8; ++i)
      for (int j = -8; j <= 8; ++j) {
        Eigen::Vector3d p(0, 0, 0);
        p[(axis + 1) % 3] = i;
        p[(axis + 2) % 3] = j;
        target.push_back((far + p).cast<float>());
      }
    Points source;
    for (const auto& p : target)
      source.push_back(
          (kCornerTruth.inverse() * (p.cast<double>() - far)).cast<float>());
    icp.addInputSource(toCloud<Point>(source));
    icp.addInputTarget(toCloud<Point>(target));
  }
  icp.setMaxCorrespondenceDistance(0.4);
  Eigen::Isometry3d guess = Eigen::Isometry3d::Identity();
  guess.pretranslate(far);
  alignFrom(icp, guess);
  EXPECT_TRUE(icp.hasConverged());
  EXPECT_LT(pcl6d::distanceBetween(icp.result().T_target_source, at_place).translation,
            1e-5);
}

TEST(OurJoint, OutputIsAllSourcesMoved)
{
  Joint icp;
  addWalls(icp);
  Cloud aligned;
  icp.align(aligned);
  ASSERT_EQ(aligned.size(), 2700u);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_LT((aligned[static_cast<std::size_t>(900 * axis + 7)].getVector3fMap() -
               wall(axis, axis + 1u)[7])
                  .norm(),
              1e-4);
}

TEST(OurJoint, ShowsEachIterationAndKeepsTheState)
{
  Joint icp;
  addWalls(icp);
  int calls = 0;
  std::function<void(
      const Cloud&, const pcl::Indices&, const Cloud&, const pcl::Indices&)>
      callback = [&](const Cloud& source,
                     const pcl::Indices& of_source,
                     const Cloud& target,
                     const pcl::Indices& of_target) {
        if (++calls == 1)
          return; // when it is set
        EXPECT_EQ(source.size(), 2700u);
        EXPECT_EQ(target.size(), 2700u);
        EXPECT_EQ(of_source.size(), of_target.size());
      };
  icp.registerVisualizationCallback(callback);
  alignFrom(icp);
  EXPECT_EQ(calls, 1 + icp.result().iterations);
  EXPECT_TRUE(icp.getConvergeCriteria()->hasConverged());
}

TEST(OurJoint, SaysWhatIsWrong)
{
  Joint icp;
  const auto align = [&] { alignFrom(icp); };
  EXPECT_FALSE(badArgumentOf([&] { icp.setInputSource(cornerData<Point>()); }).empty());
  EXPECT_FALSE(badArgumentOf([&] { icp.setInputTarget(cornerData<Point>()); }).empty());
  EXPECT_FALSE(badArgumentOf([&] { icp.addInputSource(nullptr); }).empty());
  EXPECT_FALSE(badArgumentOf([&] { icp.addInputTarget(nullptr); }).empty());
  EXPECT_FALSE(
      badArgumentOf([&] { icp.addCorrespondenceEstimation(nullptr); }).empty());
  addWalls(icp);
  icp.addInputSource(cornerData<Point>());
  EXPECT_NE(badArgumentOf(align).find("4 sources and 3 targets"), std::string::npos);
  icp.addInputTarget(pcl::make_shared<Cloud>()); // an empty one has no pairs
  alignFrom(icp);
  EXPECT_TRUE(icp.hasConverged());
  icp.addCorrespondenceEstimation(
      pcl::make_shared<pcl6d::CorrespondenceEstimation<Point, Point>>());
  EXPECT_NE(badArgumentOf(align).find("1 correspondence estimations"),
            std::string::npos);
  icp.clearCorrespondenceEstimations();
  icp.setEstimateScale(true);
  EXPECT_NE(badArgumentOf(align).find("scale"), std::string::npos);
  icp.setEstimateScale(false);
  icp.setIndices(pcl::make_shared<pcl::Indices>(5, 0));
  EXPECT_NE(badArgumentOf(align).find("indices"), std::string::npos);
}

TEST(OurJoint, FindsNothingInCloudsWithoutPoints)
{
  const auto nan = toCloud<Point>({{kNan, 0, 0}, {kNan, 0, 0}});
  for (const auto& cloud : {pcl::make_shared<Cloud>(), nan}) {
    Joint icp;
    icp.addInputSource(cloud);
    icp.addInputTarget(cloud);
    alignFrom(icp);
    EXPECT_FALSE(icp.hasConverged());
    EXPECT_EQ(icp.result().status, Status::kTooFewPairs);
    EXPECT_EQ(icp.getFitnessScore(), std::numeric_limits<double>::max());
  }
}
