// SPDX-License-Identifier: BSD-3-Clause
#include "support/bits.h"
#include "support/clouds.h"
#include "support/points.h"
#include "support/room.h"

#include <pcl6d/registration/pcl/icp6d.h>

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
const Eigen::Isometry3d kCopyTruth =
    pcl6d::poseFromEuler({0.1, -0.06, 0.05}, {0.02, -0.01, 0.03});
constexpr double kCopiedTol = 2e-6; // [m], [rad] copies, rounded to float once or twice

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
      pcl6d::transformed(pcl6d::toPoints(*model(seed)), kCopyTruth.inverse()));
}

void
setUpCopies(Icp& icp)
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
  const auto error = pcl6d::distanceBetween(kCopyTruth, icp.result().T_target_source);
  EXPECT_LT(error.translation, kCopiedTol);
  EXPECT_LT(error.rotation, kCopiedTol);
}
} // namespace

TEST(Icp6DSetters, RefuseValuesThatBreakTheirRule)
{
  const auto refused = [](auto change) {
    Icp icp;
    setUpCopies(icp);
    change(icp);
    EXPECT_THROW(align(icp), pcl6d::BadArgument);
  };
  refused([](Icp& icp) { icp.setMaxCorrespondenceDistance(kNan); });
  refused([](Icp& icp) { icp.setMaxCorrespondenceDistanceStart(-1); });
  refused([](Icp& icp) { icp.setMotionEpsilon(-1, 1e-5); });
  refused([](Icp& icp) { icp.setMotionEpsilon(1e-4, kNan); });
}

TEST(Icp6DSetters, LimitTheDistanceOfPairs)
{
  // Walls of points 9 m apart, moved by 1 m, out of reach of a small limit.
  Points walls;
  for (int i = 0; i < 48; ++i) {
    Eigen::Vector3f p = Eigen::Vector3f::Zero();
    p[i % 3] = static_cast<float>(9 * (i / 3 / 4));
    p[(i + 1) % 3] = static_cast<float>(9 * (i / 3 % 4));
    walls.push_back(p);
  }
  Icp icp;
  icp.setInputSource(toCloud<Point>(walls));
  for (auto& p : walls)
    p.x() += 1;
  icp.setInputTarget(toCloud<Point>(walls));
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
    setUpCopies(icp);
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
  setUpCopies(icp);
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
