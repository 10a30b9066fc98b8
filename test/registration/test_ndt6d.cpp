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

namespace {
/** Rings about a scanner 1 m above the floor of a hall, as a spinning lidar of 16 lines sees
 * them. \param[in] T_world_scan of the scanner, which stays upright */
Points
ringsInHall(const Eigen::Isometry3d& T_world_scan, Random& random)
{
  constexpr double kDegree = 3.14159265358979 / 180, kNoise = 0.01;
  const Eigen::Array3d low(-14, -9, -1), high(11, 8, 4); // [m] the walls
  Points points;
  for (int ring = 0; ring < 16; ++ring)
    for (int step = 0; step < 1800; ++step) {
      const double elevation = (2 * ring - 15) * kDegree,
                   azimuth = 0.2 * step * kDegree;
      const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                std::cos(elevation) * std::sin(azimuth),
                                std::sin(elevation));
      const Eigen::Array3d in_world = (T_world_scan.linear() * ray).array();
      const Eigen::Array3d wall = (in_world > 0).select(high, low);
      const double range =
          ((wall - T_world_scan.translation().array()) / in_world).minCoeff();
      points.push_back(((range + kNoise * random.normal()) * ray).cast<float>());
    }
  return points;
}

/** \return the root mean square of the position errors over some motions [m] */
double
errorInHall(pcl6d::LineGrowth growth)
{
  double sum = 0;
  constexpr int kMotions = 6;
  for (int seed = 1; seed <= kMotions; ++seed) {
    Random random(seed);
    const Eigen::Isometry3d truth = pcl6d::poseFromEuler(
        {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 0.05 * seed},
        {0.02, -0.01, random.uniform(-0.1, 0.1)});
    const Points target = ringsInHall(Eigen::Isometry3d::Identity(), random);
    Ndt ndt;
    ndt.setMaximumIterations(100);
    ndt.setLineGrowth(growth);
    const Eigen::Isometry3d found = align(ndt, target, ringsInHall(truth, random));
    const double error = pcl6d::distanceBetween(found, truth).translation;
    sum += error * error / kMotions;
  }
  return std::sqrt(sum);
}
} // namespace

TEST(Ndt6D, ClaimsNoPlaneOfASingleRing)
{
  EXPECT_EQ(Ndt().getLineGrowth(), pcl6d::LineGrowth::kAuto);
  const double as_pcl = errorInHall(pcl6d::LineGrowth::kNever);
  const double grown = errorInHall(pcl6d::LineGrowth::kAuto);
  EXPECT_LT(grown, 0.05);
  EXPECT_LT(grown, as_pcl / 2) << "errors [m] " << as_pcl << ' ' << grown;
}

TEST(Ndt6D, KeepsTheCellsOfAnEvenTarget)
{
  Ndt by_itself, never;
  never.setLineGrowth(pcl6d::LineGrowth::kNever);
  EXPECT_TRUE(sameBits(align(by_itself, rooms().target, rooms().source).matrix(),
                       align(never, rooms().target, rooms().source).matrix()));
}

TEST(DistributionGrid, GivesALineTheCovarianceThatItHas)
{
  constexpr double kStep = 0.02; // [m]
  Points line;
  for (int i = 0; i < 40; ++i)
    line.push_back({static_cast<float>(0.1 + kStep * i),
                    0.5F,
                    0.5F + 0.001F * static_cast<float>(i % 2)});
  using pcl6d::LineGrowth;
  const auto thin = pcl6d::DistributionGrid(line, 1, 6, LineGrowth::kNever);
  const auto open = pcl6d::DistributionGrid(line, 1, 6, LineGrowth::kAlways);
  ASSERT_EQ(thin.distributions().size(), 1U);
  ASSERT_EQ(open.distributions().size(), 1U);
  const Eigen::Matrix3d claimed = thin.distributions()[0].information;
  const Eigen::Matrix3d known = open.distributions()[0].information;
  EXPECT_NEAR(claimed(1, 1) / claimed(0, 0), 100, 1e-3) << "a tenth of the length";
  EXPECT_NEAR(known(1, 1) / claimed(0, 0), 1, 1e-3) << "no plane";
  EXPECT_NEAR(known(2, 2) / claimed(0, 0), 1, 1e-3);
  EXPECT_LT(open.distributions()[0].form.norm(), 1e-9) << "it fixes no motion";
  Points lines; // three of 3 m, a metre apart: each cell holds a piece of one
  for (const float y : {-0.5F, 0.5F, 1.5F})
    for (int i = 0; i < 140; ++i)
      lines.push_back({static_cast<float>(0.1 + kStep * i), y, 0.5F});
  const auto grown = pcl6d::DistributionGrid(lines, 1, 6, LineGrowth::kAlways);
  ASSERT_EQ(grown.distributions().size(), 9U);
  for (const auto& cell : grown.distributions())
    EXPECT_GT(cell.form(2, 2), 0.9) << "the plane z = 0.5";
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
