// SPDX-License-Identifier: BSD-3-Clause
#include "support/bits.h"
#include "support/points.h"
#include "support/room.h"

#include <pcl6d/registration/icp6d.h>

#include <pcl/registration/correspondence_estimation.h>
#include <pcl/registration/correspondence_rejection_distance.h>
#include <pcl/registration/transformation_estimation_svd.h>

using pcl6d::IcpIteration;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::Status;
using pcl6d::test::kNan;
using pcl6d::test::sameBits;
using pcl6d::test::toCloud;

namespace {
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
using Icp = pcl6d::ICP6D<Point, Point>;
const Eigen::Isometry3d kTruth =
    pcl6d::poseFromEuler({0.1, -0.06, 0.05}, {0.02, -0.01, 0.03});
constexpr double kExactTol = 2e-6; // [m], [rad] copies, rounded to float once or twice

Cloud::Ptr
model(std::uint64_t seed = 1)
{
  Random random(seed);
  return toCloud<Point>(pcl6d::test::roomCorner(random, 2000, 4, 0.002));
}

Cloud::Ptr
data(std::uint64_t seed = 1)
{
  return toCloud<Point>(
      pcl6d::transformed(pcl6d::toPoints(*model(seed)), kTruth.inverse()));
}

void
setUp(Icp& icp)
{
  icp.setInputSource(data());
  icp.setInputTarget(model());
  icp.setMaxCorrespondenceDistance(0.5);
}

void
align(Icp& icp)
{
  Cloud aligned;
  icp.align(aligned);
}

void
expectTruth(Icp& icp)
{
  align(icp);
  EXPECT_TRUE(icp.hasConverged());
  const auto error = pcl6d::distanceBetween(kTruth, icp.result().T_target_source);
  EXPECT_LT(error.translation, kExactTol);
  EXPECT_LT(error.rotation, kExactTol);
}

/** Counts how often it is built. */
struct CountingTree : pcl6d::KdTree<Point> {
  int built = 0;
  [[gnu::noinline]] void // GCC 12 warns of a guess of its own when it inlines
  setInputCloud(const PointCloudConstPtr& cloud,
                const pcl::IndicesConstPtr& indices = nullptr) override
  {
    ++built;
    KdTree<Point>::setInputCloud(cloud, indices);
  }
};
} // namespace

TEST(Icp6DSetters, BuildTheTreeOncePerTarget)
{
  const auto tree = pcl::make_shared<CountingTree>();
  Icp icp;
  icp.setSearchMethodTarget(tree);
  setUp(icp);
  expectTruth(icp);
  expectTruth(icp);
  icp.setInputSource(data());
  expectTruth(icp);
  EXPECT_EQ(tree->built, 1);
  icp.setInputTarget(model(2));
  icp.setInputSource(data(2));
  expectTruth(icp);
  EXPECT_EQ(tree->built, 2);
}

TEST(Icp6DSetters, TakeATreeThatIsAlreadyBuilt)
{
  const auto tree = pcl::make_shared<CountingTree>();
  const auto target = model();
  tree->setInputCloud(target);
  Icp icp;
  setUp(icp);
  icp.setInputTarget(target);
  icp.setSearchMethodTarget(tree, true); // PCL: do not build again
  expectTruth(icp);
  EXPECT_EQ(tree->built, 1);
}

TEST(Icp6DSetters, TakeAnEmptyTreeThatMustNotBeBuiltByPcl)
{
  Icp icp;
  setUp(icp);
  icp.setSearchMethodTarget(pcl::make_shared<pcl6d::KdTree<Point>>(), true);
  expectTruth(icp);
}

TEST(Icp6DSetters, TakeATreeOverSomePointsOfTheTarget)
{
  // Target indices, as a caller of PCL can give them: the tree knows only every other
  // point; the wrong partners stand in between.
  auto target = pcl::make_shared<Cloud>();
  auto indices = pcl::make_shared<pcl::Indices>();
  const auto chosen = model();
  for (const auto& p : *chosen) {
    target->push_back(Point(p.x + 0.1f, p.y - 0.05f, p.z));
    indices->push_back(static_cast<int>(target->size()));
    target->push_back(p);
  }
  const auto tree = pcl::make_shared<pcl6d::KdTree<Point>>();
  tree->setInputCloud(target, indices);
  Icp icp;
  setUp(icp);
  icp.setInputTarget(target);
  icp.setSearchMethodTarget(tree, true);
  expectTruth(icp);
}

TEST(Icp6DSetters, RefuseATreeOfAnotherCloud)
{
  const auto tree = pcl::make_shared<pcl6d::KdTree<Point>>();
  tree->setInputCloud(model(5));
  Icp icp;
  setUp(icp);
  icp.setInputTarget(toCloud<Point>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  icp.setSearchMethodTarget(tree, true);
  EXPECT_THROW(align(icp), pcl6d::BadArgument); // its indices lie outside the target
}

TEST(Icp6DSetters, RefuseForeignParts)
{
  {
    Icp icp;
    setUp(icp);
    icp.setSearchMethodTarget(pcl::make_shared<pcl::search::KdTree<Point>>());
    EXPECT_THROW(align(icp), pcl6d::BadArgument);
  }
  {
    pcl6d::ICP6D<Point, Point, double> icp;
    icp.setInputSource(data());
    icp.setInputTarget(model());
    icp.setTransformationEstimation(
        pcl::make_shared<
            pcl::registration::TransformationEstimationSVD<Point, Point, double>>());
    Cloud aligned;
    EXPECT_THROW(icp.align(aligned), pcl6d::BadArgument);
  }
  {
    Icp icp;
    setUp(icp);
    icp.addCorrespondenceRejector(
        pcl::make_shared<pcl::registration::CorrespondenceRejectorDistance>());
    EXPECT_THROW(align(icp), pcl6d::BadArgument);
    icp.clearCorrespondenceRejectors();
    expectTruth(icp);
  }
  {
    Icp icp;
    setUp(icp);
    icp.setCorrespondenceEstimation(
        pcl::make_shared<pcl::registration::CorrespondenceEstimation<Point, Point>>());
    EXPECT_THROW(align(icp), pcl6d::BadArgument);
  }
}

TEST(Icp6DSetters, RefuseValuesThatBreakTheirRule)
{
  const auto refused = [](auto change) {
    Icp icp;
    setUp(icp);
    change(icp);
    EXPECT_THROW(align(icp), pcl6d::BadArgument);
  };
  refused([](Icp& icp) { icp.setMaximumIterations(0); });
  refused([](Icp& icp) { icp.setMaxCorrespondenceDistance(-1); });
  refused([](Icp& icp) { icp.setMaxCorrespondenceDistance(kNan); });
  refused([](Icp& icp) { icp.setMaxCorrespondenceDistanceStart(-1); });
  refused([](Icp& icp) { icp.setMotionEpsilon(-1, 1e-5); });
  refused([](Icp& icp) { icp.setMotionEpsilon(1e-4, kNan); });
}

TEST(Icp6DSetters, LimitTheDistanceOfPairs)
{
  // Two copies of the same points, the nearer one out of reach of a small limit.
  Icp icp;
  icp.setInputSource(toCloud<Point>({{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}}));
  icp.setInputTarget(toCloud<Point>({{1, 0, 0}, {10, 0, 0}, {1, 9, 0}, {1, 0, 9}}));
  align(icp);
  EXPECT_TRUE(icp.hasConverged()) << "no limit unless set";
  EXPECT_NEAR(icp.getFinalTransformation()(0, 3), 1, 1e-6);
  icp.setMaxCorrespondenceDistance(0.99);
  align(icp);
  EXPECT_EQ(icp.result().status, Status::kTooFewPairs);
  icp.setMaxCorrespondenceDistanceStart(1.01);
  align(icp);
  EXPECT_TRUE(icp.hasConverged());
}

TEST(Icp6DSetters, StopAtTheEpsilonsInPclsUnits)
{
  const auto lastStep = [](auto change) {
    Icp icp;
    setUp(icp);
    change(icp);
    IcpIteration last;
    icp.setObserver([&](const IcpIteration& i) {
      last = i;
      return true;
    });
    align(icp);
    EXPECT_TRUE(icp.hasConverged());
    return last;
  };
  const auto loose = lastStep([](Icp& icp) {
    icp.setTransformationEpsilon(0.02 * 0.02); // [m^2]
    icp.setTransformationRotationEpsilon(std::cos(0.02));
  });
  const auto tight = lastStep([](Icp& icp) {
    icp.setTransformationEpsilon(1e-6 * 1e-6);
    icp.setMotionEpsilon(1e-6, 1e-6); // the last setter wins
  });
  EXPECT_LT(loose.translation, 0.02);
  EXPECT_LT(loose.rotation, 0.02);
  EXPECT_LT(tight.translation, 1e-6);
  EXPECT_LT(loose.number, tight.number);
}

TEST(Icp6DSetters, LetAnObserverStopTheRun)
{
  Icp icp;
  setUp(icp);
  int calls = 0;
  icp.setObserver([&](const IcpIteration& i) {
    EXPECT_EQ(i.number, ++calls);
    return i.number < 2;
  });
  align(icp);
  EXPECT_EQ(calls, 2);
  EXPECT_FALSE(icp.hasConverged());
  EXPECT_EQ(icp.result().status, Status::kMaxIterations);
  icp.setObserver({});
  expectTruth(icp);
}
