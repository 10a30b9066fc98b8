// SPDX-License-Identifier: BSD-3-Clause
// How well common surfaces fix a pose: open motions and covariances.
#include "fit_options.h"
#include "support/points.h"

#include <cmath>

using pcl6d::fitSurfaces;
using pcl6d::IcpModel;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::SurfaceFit;
using pcl6d::SurfaceFitOptions;
using pcl6d::VerifiedScan;
using pcl6d::test::fitOptions;
using pcl6d::test::kVoxel;
using pcl6d::test::PillarRoom;
using pcl6d::test::surfaceOptions;
using pcl6d::test::VerifiedScans;
using Vector = Eigen::Vector3d;

namespace {
/** \return points of planes at right angles to y and z, 16 m long in x */
Points
channel(Random& random)
{
  Points points;
  for (int i = 0; i < 12000; ++i) {
    Vector p(random.uniform(-8, 8), random.uniform(-1.5, 1.5), -1);
    if (i % 3 > 0)
      p = {p.x(), i % 3 == 1 ? -1.5 : 1.5, random.uniform(-1, 1.5)};
    points.push_back(
        (p + 0.005 * Vector(0, random.normal(), random.normal())).cast<float>());
  }
  return points;
}
} // namespace

TEST(SurfaceFit, HoldsARollAboutTheLongAxis)
{
  // A corridor that is ten times as long as wide: no point is far from the axis of a roll,
  // and yet floor and walls hold it; only the motion along the corridor is open.
  Random random(5);
  VerifiedScans scans;
  for (int i = 0; i < 2; ++i) {
    Points points = channel(random);
    for (auto& p : points)
      p.x() *= 2;
    scans.add(points, kVoxel);
  }
  const SurfaceFit fit =
      fitSurfaces(scans[0], scans[1], Eigen::Isometry3d::Identity(), fitOptions());
  EXPECT_EQ(fit.open_directions, 1);
  EXPECT_GT(fit.covariance(0, 0), 1) << "along the corridor";
  EXPECT_LT(std::sqrt(fit.covariance(3, 3)), 0.05) << "the roll [rad]";
}

TEST(SurfaceFit, LeavesOpenWhatACorridorDoesNotFix)
{
  Random random(7);
  VerifiedScans scans;
  scans.add(channel(random));
  scans.add(channel(random));
  const SurfaceFit fit = fitSurfaces(
      scans[0], scans[1], pcl6d::poseFromEuler({0.4, 0.05, 0}, {}), fitOptions());
  EXPECT_EQ(fit.open_directions, 1);
  EXPECT_TRUE(fit.covariance.allFinite());
  EXPECT_GT(std::sqrt(fit.covariance(0, 0)), 0.9 * fit.spread);
  EXPECT_LT(std::sqrt(fit.covariance(1, 1)), 0.1 * kVoxel);
  EXPECT_LT(std::sqrt(fit.covariance(2, 2)), 0.1 * kVoxel);
  EXPECT_LT(std::abs(fit.step(0)), 0.005) << "along the corridor";
  EXPECT_NEAR(fit.step(1), -0.05, 0.005);
  EXPECT_GT(fit.deviation(), 0.9 * fit.spread);
  EXPECT_TRUE(std::isfinite(fit.mahalanobisSq()));
}

TEST(SurfaceFit, CovarianceOfPosesLeavesOutWhatErrorsOfNormalsFeign)
{
  // Noisy normals of a corridor with one end wall: one scan's normals overstate how well the
  // few pairs of the end fix the motion along the corridor.
  Random random(7);
  const auto withEnd = [&random] {
    Points points = channel(random);
    for (int i = 0; i < 450; ++i)
      points.push_back(Vector(8 + 0.005 * random.normal(),
                              random.uniform(-1.5, 1.5),
                              random.uniform(-1, 1.5))
                           .cast<float>());
    return points;
  };
  VerifiedScans scans;
  scans.add(withEnd());
  scans.add(withEnd());
  SurfaceFitOptions options = fitOptions();
  options.shared_error = 0;
  const SurfaceFit fit =
      fitSurfaces(scans[0], scans[1], Eigen::Isometry3d::Identity(), options);
  EXPECT_EQ(fit.open_directions, 0);
  EXPECT_GE(fit.pose_covariance(0, 0), fit.covariance(0, 0));
  EXPECT_LT(std::sqrt(fit.pose_covariance(0, 0)), 0.05);
  EXPECT_GT(fit.pose_covariance(0, 0), fit.pose_covariance(1, 1));
}

TEST(SurfaceFit, FewPatchesOfAFloorFixTheHeight)
{
  // Walls of a hall, and floor measured in 16 places only, 0.5 % of the points, like by a spinning
  // lidar that looks down with its two lowest lines. The second scan is 5 cm too high.
  Random random(11);
  const auto hall = [&random](double height) {
    Points points;
    for (int i = 0; i < 60000; ++i) {
      const double along = random.uniform(-10, 10), side = i % 2 == 0 ? -10 : 10;
      const Vector p = i % 4 < 2 ? Vector(along, side, random.uniform(-1, 3))
                                 : Vector(side, along, random.uniform(-1, 3));
      points.push_back(
          (p + 0.005 * Vector(random.normal(), random.normal(), random.normal()))
              .cast<float>());
    }
    for (int i = 0; i < 640; ++i)
      points.push_back(Vector(4 * (i % 4) - 6 + random.uniform(0, 0.3),
                              4 * (i / 4 % 4) - 6 + random.uniform(0, 0.3),
                              height + 0.005 * random.normal())
                           .cast<float>());
    return points;
  };
  VerifiedScans scans;
  scans.add(hall(-1.2));
  scans.add(hall(-1.15));
  const SurfaceFit fit =
      fitSurfaces(scans[0], scans[1], Eigen::Isometry3d::Identity(), fitOptions());
  EXPECT_EQ(fit.open_directions, 0);
  EXPECT_NEAR(fit.step(2), -0.05, 0.01);
  EXPECT_LT(std::sqrt(fit.pose_covariance(2, 2)), 0.02);
  EXPECT_GT(fit.pose_covariance(2, 2), fit.pose_covariance(0, 0));
  EXPECT_LE(fit.overlap, 1);
}

TEST(SurfaceFit, OnePatchOfAFloorLeavesTheHeightOpen)
{
  // All floor points lie in one place: their errors are one error.
  Random random(12);
  VerifiedScans scans;
  for (int k = 0; k < 2; ++k) {
    Points points;
    for (int i = 0; i < 60000; ++i) {
      const double along = random.uniform(-10, 10), side = i % 2 == 0 ? -10 : 10;
      points.push_back((i % 4 < 2 ? Vector(along, side, random.uniform(-1, 3))
                                  : Vector(side, along, random.uniform(-1, 3)))
                           .cast<float>());
    }
    for (int i = 0; i < 640; ++i)
      points.push_back(
          Vector(random.uniform(0, 1.2), random.uniform(0, 1.2), -1.2).cast<float>());
    scans.add(points);
  }
  EXPECT_EQ(fitSurfaces(scans[0], scans[1], Eigen::Isometry3d::Identity(), fitOptions())
                .open_directions,
            1);
}

TEST(SurfaceFit, LeavesThreeMotionsOpenOnOnePlane)
{
  Random random(8);
  VerifiedScans scans;
  for (int i = 0; i < 2; ++i) {
    Points plane;
    for (int k = 0; k < 6000; ++k)
      plane.emplace_back(static_cast<float>(random.uniform(-4, 4)),
                         static_cast<float>(random.uniform(-4, 4)),
                         static_cast<float>(-1 + 0.005 * random.normal()));
    scans.add(plane);
  }
  const SurfaceFit fit =
      fitSurfaces(scans[0], scans[1], Eigen::Isometry3d::Identity(), fitOptions());
  EXPECT_EQ(fit.open_directions, 3);
  EXPECT_TRUE(fit.covariance.allFinite());
  EXPECT_NEAR(std::sqrt(fit.covariance(5, 5)), 1, 0.1)
      << "[rad]: pairs by their spread";
}

TEST(SurfaceFit, CovariancesAreThatOfSimulatedNoise)
{
  // Squared steps at the truth, in the stated deviations: 6 on average over the six
  // directions if these are right. Normals and voxels have errors of their own, of which
  // cubes see only a part: so twice is allowed.
  constexpr int kTrials = 120;
  constexpr double kSide = 0.3; // [m] voxel
  const pcl6d::test::ScannedPair pair;
  const PillarRoom room;
  SurfaceFitOptions options;
  options.max_distance = 1.7 * kSide;
  options.shared_error = 0; // its sign is the same in all trials
  double sum = 0, sum_of_poses = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Random random(100 + static_cast<std::uint64_t>(trial));
    pcl6d::ReductionOptions reduction;
    reduction.voxel = kSide;
    const Points at_first = room.scan(pair.T_world_first, random, 0.07, 0.02);
    const Points at_second =
        room.scan(pair.T_world_first * pair.T_first_second, random, 0.07, 0.02);
    const IcpModel first(pcl6d::reducePoints(at_first, reduction),
                         surfaceOptions(kSide));
    const IcpModel second(pcl6d::reducePoints(at_second, reduction),
                          surfaceOptions(kSide));
    const SurfaceFit fit = fitSurfaces(VerifiedScan(at_first, first, kSide),
                                       VerifiedScan(at_second, second, kSide),
                                       pair.T_first_second,
                                       options);
    sum += fit.mahalanobisSq() / 6;
    sum_of_poses += fit.step.dot(fit.pose_covariance.inverse() * fit.step) / 6;
  }
  RecordProperty("nees", std::to_string(sum / kTrials));
  RecordProperty("nees_of_poses", std::to_string(sum_of_poses / kTrials));
  for (const double nees : {sum / kTrials, sum_of_poses / kTrials}) {
    EXPECT_GT(nees, 0.5);
    EXPECT_LT(nees, 2);
  }
}

TEST(SurfaceFit, CovarianceHoldsWhatAllPairsShare)
{
  const pcl6d::test::ScannedPair pair;
  const VerifiedScans scans = pair.verified();
  SurfaceFitOptions options = fitOptions();
  const auto variancesWith = [&](double shared_error) {
    options.shared_error = shared_error;
    return Eigen::VectorXd(fitSurfaces(scans[0], scans[1], pair.T_first_second, options)
                               .covariance.diagonal());
  };
  const Eigen::VectorXd none = variancesWith(0), some = variancesWith(0.5),
                        twice = variancesWith(1);
  EXPECT_GT((some - none).minCoeff(), 0);
  EXPECT_TRUE((twice - none).isApprox(4 * (some - none), 1e-9)) << "a deviation";
}

TEST(SurfaceFit, CovarianceShrinksWithNoise)
{
  const auto deviation = [](double sigma) {
    const VerifiedScans scans = pcl6d::test::ScannedPair({}, sigma).verified();
    return fitSurfaces(scans[0],
                       scans[1],
                       pcl6d::test::ScannedPair().T_first_second,
                       fitOptions())
        .deviation();
  };
  EXPECT_LT(deviation(0.005), deviation(0.03));
}
