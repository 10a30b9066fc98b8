// SPDX-License-Identifier: BSD-3-Clause
#include "support/points.h"
#include "verified_rooms.h"

#include <pcl6d/verification/surface_fit.h>

#include <cmath>

using pcl6d::fitSurfaces;
using pcl6d::IcpModel;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::SurfaceFit;
using pcl6d::SurfaceFitOptions;
using pcl6d::VerifiedScan;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kNan;
using pcl6d::test::kVoxel;
using pcl6d::test::PillarRoom;
using pcl6d::test::shifted;
using pcl6d::test::surfaceOptions;
using pcl6d::test::VerifiedScans;
using Vector = Eigen::Vector3d;

namespace {
constexpr double kReach = 1.7 * kVoxel; // [m] as links pair points

/** [m] Reduced points at an edge are means of two walls, and differ between scans. */
constexpr double kRestTol = 0.02 * kVoxel;

SurfaceFitOptions
optionsOf(double scale = 1)
{
  SurfaceFitOptions options;
  options.max_distance = scale * kReach;
  return options;
}

/** \return points of a grid on the walls of a box [m] about the origin, without noise:
 * spaced by 0.1 m, beginning at a phase [m] */
Points
box(const Vector& half, double phase, const Eigen::Isometry3d& T_scan_box)
{
  Points points;
  for (int axis = 0; axis < 3; ++axis)
    for (double u = -half[(axis + 1) % 3] + phase; u < half[(axis + 1) % 3]; u += 0.1)
      for (double v = -half[(axis + 2) % 3] + phase; v < half[(axis + 2) % 3]; v += 0.1)
        for (const double side : {-1, 1}) {
          Vector p;
          p[axis] = side * half[axis];
          p[(axis + 1) % 3] = u;
          p[(axis + 2) % 3] = v;
          points.push_back((T_scan_box * p).cast<float>());
        }
  return points;
}

/** \brief Two scans of a box, of different points, with their true pose. */
struct Boxes {
  explicit Boxes(double scale = 1)
  {
    const Vector half(2.5, 2, 1.3);
    const Points clouds[] = {box(half, 0.02, Eigen::Isometry3d::Identity()),
                             box(half, 0.07, T_first_second.inverse())};
    for (const Points& points : clouds)
      scans.add(pcl6d::test::ScannedPair::scaled(points, scale), scale * kVoxel);
    T_first_second.translation() *= scale;
  }
  Eigen::Isometry3d T_first_second =
      pcl6d::poseFromEuler({0.3, -0.2, 0.1}, {0, 0.1, 1});
  VerifiedScans scans;

  SurfaceFit
  fit(const Eigen::Isometry3d& T, const SurfaceFitOptions& options = optionsOf()) const
  {
    return fitSurfaces(scans[0], scans[1], T, options);
  }
};

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

TEST(SurfaceFit, StaysAtTheTruePose)
{
  const Boxes boxes;
  const SurfaceFit fit = boxes.fit(boxes.T_first_second);
  EXPECT_GT(fit.pairs, 1000u);
  EXPECT_GT(fit.overlap, 0.95);
  EXPECT_LT(fit.displacement(), kRestTol);
  EXPECT_EQ(fit.open_directions, 0);
}

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
      fitSurfaces(scans[0], scans[1], Eigen::Isometry3d::Identity(), optionsOf());
  EXPECT_EQ(fit.open_directions, 1);
  EXPECT_GT(fit.covariance(0, 0), 1) << "along the corridor";
  EXPECT_LT(std::sqrt(fit.covariance(3, 3)), 0.05) << "the roll [rad]";
}

TEST(SurfaceFit, StepsBackByTheWholeShift)
{
  const Boxes boxes;
  constexpr double kShare = 0.1; // at corners pairs are of two walls
  for (const double way : {0.02, 0.05, 0.1})
    for (const Vector& to : {Vector(1, 0, 0), Vector(0, -1, 0), Vector(2, 1, 2)}) {
      const Vector shift = way * to.normalized();
      const SurfaceFit fit = boxes.fit(shifted(boxes.T_first_second, shift));
      EXPECT_NEAR(fit.displacement(), way, kShare * way + kRestTol);
      EXPECT_LT((fit.step.head<3>() + shift).norm(), kShare * way + kRestTol)
          << shift.transpose();
    }
}

TEST(SurfaceFit, StepsBackByATurn)
{
  const Boxes boxes;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector turn = 0.02 * Vector::Unit(axis); // [rad]
    Eigen::Isometry3d T = boxes.T_first_second;
    const Vector centroid = boxes.fit(T).centroid;
    T = Eigen::Translation3d(centroid) * Eigen::AngleAxisd(0.02, Vector::Unit(axis)) *
        Eigen::Translation3d(-centroid) * T;
    const SurfaceFit fit = boxes.fit(T);
    EXPECT_LT((fit.step.tail<3>() + turn).norm(), 0.15 * 0.02) << axis;
    EXPECT_LT(fit.step.head<3>().norm(), 0.1 * 0.02 * fit.spread) << axis;
  }
}

TEST(SurfaceFit, DoesNotDependOnUnits)
{
  const Boxes metres;
  const SurfaceFit fit = metres.fit(shifted(metres.T_first_second, {0.05, 0.03, 0.02}));
  for (const double scale : {1.0 / 128, 128.0}) { // exact in float
    const Boxes other(scale);
    const SurfaceFit scaled =
        other.fit(shifted(other.T_first_second, scale * Vector(0.05, 0.03, 0.02)),
                  optionsOf(scale));
    EXPECT_EQ(scaled.pairs, fit.pairs);
    EXPECT_EQ(scaled.overlap, fit.overlap);
    EXPECT_EQ(scaled.open_directions, fit.open_directions);
    EXPECT_NEAR(scaled.displacement(), scale * fit.displacement(), 1e-6 * scale);
    EXPECT_NEAR(scaled.deviation(), scale * fit.deviation(), 1e-6 * scale);
    EXPECT_NEAR(scaled.mahalanobisSq() / fit.mahalanobisSq(), 1, 1e-6);
  }
}

TEST(SurfaceFit, TakesTheInverseStepTheOtherWayRound)
{
  const Boxes boxes;
  const Eigen::Isometry3d T = shifted(boxes.T_first_second, {0.05, 0.03, 0.02});
  const SurfaceFit there = boxes.fit(T);
  const SurfaceFit back =
      fitSurfaces(boxes.scans[1], boxes.scans[0], T.inverse(), optionsOf());
  EXPECT_EQ(back.pairs, there.pairs);
  EXPECT_EQ(back.overlap, there.overlap);
  EXPECT_NEAR(back.residual, there.residual, 1e-9);
  EXPECT_LT((T.linear() * back.step.head<3>() + there.step.head<3>()).norm(), 0.002);
  EXPECT_NEAR(back.deviation() / there.deviation(), 1, 0.2) << "cubes lie elsewhere";
}

TEST(SurfaceFit, LeavesOpenWhatACorridorDoesNotFix)
{
  Random random(7);
  VerifiedScans scans;
  scans.add(channel(random));
  scans.add(channel(random));
  const SurfaceFit fit = fitSurfaces(
      scans[0], scans[1], pcl6d::poseFromEuler({0.4, 0.05, 0}, {}), optionsOf());
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
  SurfaceFitOptions options = optionsOf();
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
      fitSurfaces(scans[0], scans[1], Eigen::Isometry3d::Identity(), optionsOf());
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
  EXPECT_EQ(fitSurfaces(scans[0], scans[1], Eigen::Isometry3d::Identity(), optionsOf())
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
      fitSurfaces(scans[0], scans[1], Eigen::Isometry3d::Identity(), optionsOf());
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
  SurfaceFitOptions options = optionsOf();
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
                       optionsOf())
        .deviation();
  };
  EXPECT_LT(deviation(0.005), deviation(0.03));
}

TEST(SurfaceFit, WithoutCovarianceIsTheSameStep)
{
  const Boxes boxes;
  SurfaceFitOptions options = optionsOf();
  const SurfaceFit with = boxes.fit(boxes.T_first_second, options);
  options.covariance = false;
  const SurfaceFit without = boxes.fit(boxes.T_first_second, options);
  EXPECT_EQ(without.step, with.step);
  EXPECT_TRUE(without.covariance.isZero(0));
  EXPECT_FALSE(with.covariance.isZero(0));
}

TEST(SurfaceFit, DoesNotPairTheTwoFacesOfAWall)
{
  // A wall of 6 cm, seen from the left by one scan, from the right by the other.
  Random random(9);
  VerifiedScans scans;
  for (const double side : {1, -1}) {
    Points wall;
    for (int k = 0; k < 6000; ++k)
      wall.emplace_back(static_cast<float>(side * 2),
                        static_cast<float>(random.uniform(-2, 2)),
                        static_cast<float>(random.uniform(-2, 2)));
    scans.add(wall);
  }
  const SurfaceFit fit = fitSurfaces(
      scans[0], scans[1], pcl6d::poseFromEuler({4.06, 0, 0}, {}), optionsOf());
  EXPECT_EQ(fit.pairs, 0u);
}

TEST(SurfaceFit, OfScansApartIsNothing)
{
  const Boxes boxes;
  const SurfaceFit fit = boxes.fit(shifted(boxes.T_first_second, {50, 0, 0}));
  EXPECT_EQ(fit.pairs, 0u);
  EXPECT_EQ(fit.overlap, 0);
  EXPECT_EQ(fit.displacement(), 0);
  EXPECT_EQ(fit.deviation(), 0);
  EXPECT_EQ(fit.mahalanobisSq(), 0);
}

TEST(SurfaceFit, OfEmptyAndTinyScansIsNothing)
{
  const Boxes boxes;
  VerifiedScans small;
  small.add({});
  small.add({{1, 2, 1}});
  for (std::size_t i = 0; i < 2; ++i)
    for (const VerifiedScan* other : {&boxes.scans[0], &small[0], &small[1]}) {
      const SurfaceFit fit =
          fitSurfaces(*other, small[i], Eigen::Isometry3d::Identity(), optionsOf());
      EXPECT_LT(fit.pairs, 3u);
      EXPECT_EQ(fit.displacement(), 0);
      EXPECT_TRUE(fit.covariance.isZero(0));
    }
}

TEST(SurfaceFit, NamesTheOptionThatBreaksItsRule)
{
  const Boxes boxes;
  const auto errorOf = [&](auto change) {
    SurfaceFitOptions options;
    change(options);
    return badArgumentOf([&] { boxes.fit(boxes.T_first_second, options); });
  };
  EXPECT_EQ(errorOf([](auto& o) { o.max_distance = 0; }),
            "max_distance = 0, but must be finite and > 0");
  EXPECT_EQ(errorOf([](auto& o) { o.max_distance = kNan; }),
            "max_distance = nan, but must be finite and > 0");
  EXPECT_EQ(errorOf([](auto& o) { o.points = 0; }), "points = 0, but must be > 0");
  for (const float wrong : {0.0F, -1.0F, kNan, pcl6d::test::kInfinity})
    EXPECT_EQ(
        errorOf([wrong](auto& o) { o.cube_voxels = wrong; }).find("cube_voxels = "), 0u)
        << wrong;
  EXPECT_EQ(errorOf([](auto& o) { o.shared_error = -0.5; }),
            "shared_error = -0.5, but must be finite and >= 0");
  EXPECT_EQ(errorOf([](auto& o) { o.shared_error = kNan; }),
            "shared_error = nan, but must be finite and >= 0");
}
