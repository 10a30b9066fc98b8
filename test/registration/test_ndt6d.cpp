// SPDX-License-Identifier: BSD-3-Clause
// The normal distributions transform, with PCL's class beside it on the same scans.
#include "icp6d_cases.h"

#include <pcl6d/registration/pcl/ndt6d.h>

#include <pcl/registration/ndt.h>

#include <cmath>

using namespace pcl6d::test;
using pcl6d::BadArgument;
using pcl6d::IcpStop;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::Status;

namespace {
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
using Ndt = pcl6d::NDT6D<Point, Point>;
using PclNdt = pcl::NormalDistributionsTransform<Point, Point>;

const Eigen::Isometry3d kRoomTruth =
    pcl6d::poseFromEuler({0.3, -0.2, 0.05}, {0.01, -0.02, 0.08});

/** Two scans of a room with pillars from places kRoomTruth apart. */
struct RoomPair {
  Points target, source;
  RoomPair()
  {
    Random random(1);
    const PillarRoom room;
    target = room.scan(Eigen::Isometry3d::Identity(), random);
    source = room.scan(kRoomTruth, random);
  }
};

const RoomPair&
rooms()
{
  static const RoomPair pair;
  return pair;
}

template <typename Registration>
Eigen::Isometry3d
align(Registration& registration,
      const Points& target,
      const Points& source,
      const Eigen::Isometry3d& guess = Eigen::Isometry3d::Identity())
{
  registration.setInputTarget(toCloud<Point>(target));
  registration.setInputSource(toCloud<Point>(source));
  Cloud aligned;
  registration.align(aligned, guess.matrix().cast<float>());
  return Eigen::Isometry3d(
      registration.getFinalTransformation().template cast<double>());
}

double
errorOf(const Eigen::Isometry3d& found)
{
  return pcl6d::distanceBetween(found, kRoomTruth).translation;
}
} // namespace

TEST(Ndt6D, IsAtLeastAsAccurateAsPcl)
{
  double error = 0, error_of_pcl = 0;
  for (int seed = 1; seed <= 6; ++seed) {
    Random random(seed);
    const PillarRoom room;
    const Points target = room.scan(Eigen::Isometry3d::Identity(), random);
    const Points source = room.scan(kRoomTruth, random);
    Ndt ours;
    error += errorOf(align(ours, target, source));
    EXPECT_TRUE(ours.hasConverged()) << toString(ours.result().status);
    EXPECT_EQ(ours.getFinalNumIteration(), ours.result().iterations);
    PclNdt of_pcl;
    of_pcl.setTransformationEpsilon(1e-6); // squared: as far as its line search comes
    of_pcl.setMaximumIterations(100);
    error_of_pcl += errorOf(align(of_pcl, target, source));
    EXPECT_NEAR(ours.getTransformationLikelihood(),
                of_pcl.getTransformationLikelihood(),
                1e-3 * of_pcl.getTransformationLikelihood());
  }
  EXPECT_LT(error / 6, 0.02);
  EXPECT_LE(error / 6, error_of_pcl / 6 + 1e-4);
}

TEST(Ndt6D, IsADropInRegistration)
{
  const pcl::Registration<Point, Point>::Ptr registration(new Ndt);
  EXPECT_LT(errorOf(align(*registration, rooms().target, rooms().source)), 0.02);
  EXPECT_TRUE(registration->hasConverged());
  EXPECT_LT(registration->getFitnessScore(), 0.1);
  EXPECT_EQ(registration->getClassName(), "NDT6D");
}

TEST(Ndt6D, HoldsPclsSettings)
{
  Ndt ours;
  PclNdt of_pcl;
  EXPECT_EQ(ours.getResolution(), of_pcl.getResolution());
  EXPECT_EQ(ours.getStepSize(), of_pcl.getStepSize());
  EXPECT_EQ(ours.getOulierRatio(), of_pcl.getOulierRatio());
  EXPECT_EQ(ours.getMaximumIterations(), of_pcl.getMaximumIterations());
  ours.setResolution(2);
  ours.setStepSize(0.5);
  ours.setOulierRatio(0.3);
  EXPECT_EQ(ours.getResolution(), 2);
  EXPECT_EQ(ours.getStepSize(), 0.5);
  EXPECT_EQ(ours.getOutlierRatio(), 0.3);
}

TEST(Ndt6D, TakesNoStepLongerThanAllowed)
{
  Ndt ndt;
  ndt.setStepSize(0.05);
  ndt.setMaximumIterations(1);
  const Eigen::Isometry3d found = align(ndt, rooms().target, rooms().source);
  EXPECT_LE(pcl6d::rotationAngle(found.linear()), 0.05 + 1e-6);
  EXPECT_GT(found.translation().norm(), 0.001);
  EXPECT_FALSE(ndt.hasConverged());
  EXPECT_EQ(ndt.result().stop, IcpStop::kIterationLimit);
  ndt.setIterationLimitConverges(true);
  align(ndt, rooms().target, rooms().source);
  EXPECT_TRUE(ndt.hasConverged());
}

TEST(Ndt6D, GivesTheSameBitsForAnyNumberOfThreads)
{
  Ndt one, two;
  one.setNumberOfThreads(1);
  two.setNumberOfThreads(2);
  EXPECT_TRUE(sameBits(align(one, rooms().target, rooms().source).matrix(),
                       align(two, rooms().target, rooms().source).matrix()));
}

TEST(Ndt6D, MovesWithTheWorld)
{
  const Eigen::Isometry3d far(Eigen::Translation3d(691200, 5334016, 512));
  pcl6d::NDT6D<Point, Point, double> ndt;
  ndt.setInputTarget(toCloud<Point>(pcl6d::transformed(rooms().target, far)));
  ndt.setInputSource(toCloud<Point>(rooms().source));
  Cloud aligned;
  ndt.align(aligned, far.matrix());
  const Eigen::Isometry3d found = far.inverse() * ndt.result().T_target_source;
  EXPECT_LT(pcl6d::distanceBetween(found, kRoomTruth).translation, 0.4)
      << "float holds half a metre there";
}

TEST(Ndt6D, SaysThatACorridorLeavesAMotionOpen)
{
  Random random(3);
  const auto corridor = [&] {
    Points points;
    for (int i = 0; i < 20000; ++i) {
      const double along = random.uniform(-15, 15), across = random.uniform(-1.5, 1.5);
      const double side = i % 4 < 2 ? -1.5 : 1.5;
      points.push_back(
          Eigen::Vector3d(along, i % 2 == 0 ? side : across, i % 2 == 0 ? across : side)
              .cast<float>() +
          0.005f * Eigen::Vector3f(0, random.normal(), random.normal()));
    }
    return points;
  };
  Ndt ndt;
  align(ndt, corridor(), corridor(), pcl6d::poseFromEuler({0, 0.1, 0}, {0, 0, 0.01}));
  EXPECT_FALSE(ndt.hasConverged())
      << ndt.result().localizability.eigenvalues.transpose();
  EXPECT_EQ(ndt.result().status, Status::kRankDeficient);
}

TEST(Ndt6D, SaysWhenThereIsTooLittle)
{
  Ndt ndt;
  const Eigen::Isometry3d guess = pcl6d::poseFromEuler({500, 0, 0}, {0, 0, 0});
  EXPECT_LT((align(ndt, rooms().target, rooms().source, guess).translation() -
             guess.translation())
                .norm(),
            1e-6);
  EXPECT_EQ(ndt.result().status, Status::kTooFewPairs);
  align(ndt, Points(50, {kNan, kNan, kNan}), rooms().source);
  EXPECT_FALSE(ndt.hasConverged());
  align(ndt, rooms().target, Points(50, {kNan, kNan, kNan}));
  EXPECT_FALSE(ndt.hasConverged());
  align(ndt, Points{{0, 0, 0}, {1, 0, 0}}, rooms().source);
  EXPECT_EQ(ndt.result().status, Status::kTooFewPairs);
}

TEST(Ndt6D, RefusesWhatBreaksARule)
{
  const auto refused = [](auto change) {
    Ndt ndt;
    change(ndt);
    EXPECT_THROW(align(ndt, rooms().target, rooms().source), BadArgument);
  };
  refused([](Ndt& ndt) { ndt.setResolution(0); });
  refused([](Ndt& ndt) { ndt.setResolution(kNan); });
  refused([](Ndt& ndt) { ndt.setStepSize(0); });
  refused([](Ndt& ndt) { ndt.setOulierRatio(1); });
  Ndt ndt;
  EXPECT_THROW(ndt.setInputSource(nullptr), BadArgument);
  EXPECT_THROW(ndt.setInputTarget(nullptr), BadArgument);
}
