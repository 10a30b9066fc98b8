// SPDX-License-Identifier: BSD-3-Clause
// What getConvergeCriteria() tells and takes, for PCL's ICP and ours.
#include "as_pcl_cases.h"

#include <cmath>

using namespace pcl6d::test;
using pcl6d::IcpStop;
using pcl6d::Status;

namespace {
using Point = pcl::PointXYZ;
using Criteria = pcl::registration::DefaultConvergenceCriteria<float>;

template <typename Icp>
Criteria::ConvergenceState
stateOf(Icp& icp)
{
  return icp.getConvergeCriteria()->getConvergenceState();
}

/** Two noisy samples of a corner. */
template <typename Icp>
void
setUpNoisy(Icp& icp)
{
  icp.setInputTarget(cornerCloud<Point>(cornerPoints(1, 1998, 0.01)));
  icp.setInputSource(
      cornerCloud<Point>(cornerPoints(2, 1998, 0.01), kCornerTruth.inverse()));
  icp.setMaxCorrespondenceDistance(0.5);
}

std::shared_ptr<pcl6d::ICP6D<Point, Point>>
noisyCorner()
{
  auto icp = std::make_shared<pcl6d::ICP6D<Point, Point>>();
  setUpNoisy(*icp);
  return icp;
}
} // namespace

template <typename Side>
class ConvergenceAsPcl : public testing::Test {
protected:
  void
  SetUp() override
  {
    setUpCorner(icp_);
  }
  typename Side::template Icp<Point> icp_;
};
TYPED_TEST_SUITE(ConvergenceAsPcl, BothSides, NameOfSide);

TYPED_TEST(ConvergenceAsPcl, TellsThatTheMotionRests)
{
  this->icp_.setMaximumIterations(200);
  this->icp_.setTransformationEpsilon(1e-9);
  this->icp_.setTransformationRotationEpsilon(0.9999999);
  this->icp_.getConvergeCriteria()->setAbsoluteMSE(0);
  alignFrom(this->icp_);
  EXPECT_TRUE(this->icp_.hasConverged());
  EXPECT_EQ(stateOf(this->icp_), Criteria::CONVERGENCE_CRITERIA_TRANSFORM);
  EXPECT_EQ(this->icp_.getConvergeCriteria()->getMaximumIterations(), 200);
  EXPECT_FLOAT_EQ(this->icp_.getConvergeCriteria()->getTranslationThreshold(), 1e-9);
  EXPECT_FLOAT_EQ(this->icp_.getConvergeCriteria()->getRotationThreshold(), 0.9999999);
}

TYPED_TEST(ConvergenceAsPcl, TellsThatTheErrorRests)
{
  setUpNoisy(this->icp_);
  this->icp_.setMaximumIterations(200);
  this->icp_.setTransformationEpsilon(1e-30);
  this->icp_.setTransformationRotationEpsilon(1);
  this->icp_.setEuclideanFitnessEpsilon(0.5);
  alignFrom(this->icp_);
  EXPECT_EQ(stateOf(this->icp_), Criteria::CONVERGENCE_CRITERIA_REL_MSE);
  this->icp_.setEuclideanFitnessEpsilon(1e-12);
  this->icp_.getConvergeCriteria()->setAbsoluteMSE(1e-4);
  alignFrom(this->icp_);
  EXPECT_EQ(stateOf(this->icp_), Criteria::CONVERGENCE_CRITERIA_ABS_MSE);
  EXPECT_TRUE(this->icp_.hasConverged());
}

TYPED_TEST(ConvergenceAsPcl, TellsTheIterationLimit)
{
  this->icp_.setMaximumIterations(2);
  this->icp_.getConvergeCriteria()->setFailureAfterMaximumIterations(
      false); // PCL's default
  alignFrom(this->icp_);
  EXPECT_TRUE(this->icp_.hasConverged());
  EXPECT_EQ(stateOf(this->icp_), Criteria::CONVERGENCE_CRITERIA_ITERATIONS);
}

TYPED_TEST(ConvergenceAsPcl, TellsThatThereAreNoPairs)
{
  this->icp_.setMaxCorrespondenceDistance(1e-6);
  alignFrom(this->icp_);
  EXPECT_FALSE(this->icp_.hasConverged());
  EXPECT_EQ(stateOf(this->icp_), Criteria::CONVERGENCE_CRITERIA_NO_CORRESPONDENCES);
}

TEST(OurConvergence, FailsAtTheIterationLimitUnlessAskedOtherwise)
{
  const auto icp = noisyCorner();
  EXPECT_TRUE(icp->getConvergeCriteria()->getFailureAfterMaximumIterations());
  icp->setMaximumIterations(2);
  alignFrom(*icp);
  EXPECT_FALSE(icp->hasConverged());
  EXPECT_EQ(stateOf(*icp), Criteria::CONVERGENCE_CRITERIA_FAILURE_AFTER_MAX_ITERATIONS);
  EXPECT_FALSE(icp->getConvergeCriteria()->hasConverged());
  icp->setIterationLimitConverges(true);
  EXPECT_FALSE(icp->getConvergeCriteria()->getFailureAfterMaximumIterations());
  alignFrom(*icp);
  EXPECT_TRUE(icp->hasConverged());
  for (int again = 0; again < 2; ++again) { // asking changes nothing, as it does in PCL
    EXPECT_TRUE(icp->getConvergeCriteria()->hasConverged());
    EXPECT_EQ(stateOf(*icp), Criteria::CONVERGENCE_CRITERIA_ITERATIONS);
  }
}

TEST(OurConvergence, SaysOfAStoppedRunThatItDidNotConverge)
{
  const auto icp = noisyCorner();
  icp->setObserver([](const pcl6d::IcpIteration& seen) { return seen.number < 2; });
  alignFrom(*icp);
  EXPECT_EQ(icp->result().stop, IcpStop::kObserver);
  EXPECT_EQ(stateOf(*icp), Criteria::CONVERGENCE_CRITERIA_NOT_CONVERGED);
}

TEST(OurConvergence, AbsoluteErrorEndsTheRunAtRest)
{
  const auto icp = noisyCorner();
  icp->setMotionEpsilon(0, 0);
  alignFrom(*icp);
  const int all = icp->result().iterations;
  icp->getConvergeCriteria()->setAbsoluteMSE(1e-5);
  alignFrom(*icp);
  EXPECT_LT(icp->result().iterations, all);
  EXPECT_EQ(icp->result().stop, IcpStop::kAtRest);
  EXPECT_EQ(icp->result().status, Status::kOk);
  EXPECT_TRUE(icp->hasConverged());
}

TEST(OurConvergence, AbsoluteErrorDoesNotMakeAPlaneFixThePose)
{
  pcl6d::Random random(1);
  pcl6d::Points floor, other;
  for (int i = 0; i < 2000; ++i)
    for (auto* points : {&floor, &other})
      points->emplace_back(
          random.uniform(0, 4), random.uniform(0, 4), 0.005 * random.normal());
  pcl6d::ICP6D<Point, Point> icp;
  icp.setInputTarget(toCloud<Point>(floor));
  icp.setInputSource(toCloud<Point>(other));
  icp.setMetric(pcl6d::Metric::kPlane);
  icp.setMotionEpsilon(0, 0);
  icp.setMaxCorrespondenceDistance(0.5);
  icp.getConvergeCriteria()->setAbsoluteMSE(1e-4);
  alignFrom(icp);
  EXPECT_EQ(icp.result().stop, IcpStop::kAtRest);
  EXPECT_EQ(icp.result().status, Status::kRankDeficient);
  EXPECT_FALSE(icp.hasConverged());
  EXPECT_FALSE(icp.result().covariance);
}

TEST(OurConvergence, AsksForSeveralStepsAtRest)
{
  const auto icp = noisyCorner();
  icp->setMotionEpsilon(1e-3, 1e-3);
  alignFrom(*icp);
  const int first = icp->result().iterations;
  icp->getConvergeCriteria()->setMaximumIterationsSimilarTransforms(4);
  alignFrom(*icp);
  EXPECT_EQ(icp->result().stop, IcpStop::kAtRest);
  EXPECT_TRUE(icp->hasConverged());
  EXPECT_EQ(icp->result().iterations, first + 4);
  EXPECT_EQ(stateOf(*icp), Criteria::CONVERGENCE_CRITERIA_TRANSFORM);
}

TEST(OurConvergence, TakesWhatIsSetInTheCriteria)
{
  const auto icp = noisyCorner();
  const auto criteria = icp->getConvergeCriteria();
  icp->setMotionEpsilon(0, 0);
  criteria->setMaximumIterations(3);
  alignFrom(*icp);
  EXPECT_EQ(icp->result().iterations, 3);
  EXPECT_EQ(icp->getMaximumIterations(), 3);
  alignFrom(*icp);
  EXPECT_EQ(icp->result().iterations, 3) << "still";
  icp->setMaximumIterations(200);
  criteria->setTranslationThreshold(1e-6);
  criteria->setRotationThreshold(std::cos(0.001));
  alignFrom(*icp);
  const int by_motion = icp->result().iterations;
  EXPECT_GT(by_motion, 1);
  EXPECT_EQ(stateOf(*icp), Criteria::CONVERGENCE_CRITERIA_TRANSFORM);
  const auto same = noisyCorner();
  same->setMotionEpsilon(1e-3, 0.001);
  alignFrom(*same);
  EXPECT_EQ(same->result().iterations, by_motion);
  criteria->setTranslationThreshold(0);
  criteria->setRotationThreshold(1);
  criteria->setRelativeMSE(0.2);
  alignFrom(*icp);
  EXPECT_EQ(stateOf(*icp), Criteria::CONVERGENCE_CRITERIA_REL_MSE);
  EXPECT_EQ(icp->getEuclideanFitnessEpsilon(), 0.2);
}
