// SPDX-License-Identifier: BSD-3-Clause
#include "rays.h"
#include "support/points.h"
#include "support/room.h"

#include <pcl6d/visibility/sight_evidence.h>

#include <algorithm>
#include <string>

using pcl6d::Contradiction;
using pcl6d::MotionCovariance;
using pcl6d::PlaceUncertainty;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::RayImage;
using pcl6d::RayImageOptions;
using pcl6d::selfContradiction;
using pcl6d::Sight;
using pcl6d::SightEvidence;
using pcl6d::sightEvidence;
using pcl6d::test::badArgumentOf;
using pcl6d::test::directionOf;
using pcl6d::test::kCodeTol;
using pcl6d::test::kInfinity;
using pcl6d::test::kNan;
using pcl6d::test::PillarRoom;
using pcl6d::test::scanAround;

namespace {
using Isometry = Eigen::Isometry3d;
using Vector = Eigen::Vector3d;
constexpr std::size_t kSightRays = 30000;
constexpr double kSightPatch = 0.5; // [m]
constexpr double kNoise = 0.01;     // [m]
constexpr double kWallAway = 5.0;   // [m]

RayImage
imageOf(const Points& points, const Vector& origin = Vector::Zero())
{
  RayImageOptions options;
  options.origin = origin.cast<float>();
  options.noise = kNoise;
  options.finest = 0.03;
  return RayImage(points, options);
}

/** \return a wall across the x axis, 6 x 6 m, measured every 40 mm */
Points
wallAt(double x)
{
  Points points;
  for (double y = -3; y < 3; y += 0.04)
    for (double z = -3; z < 3; z += 0.04)
      points.push_back(Vector(x, y + 0.01, z + 0.01).cast<float>());
  return points;
}

Isometry
shift(double x, double y, double z)
{
  return Isometry(Eigen::Translation3d(x, y, z));
}

void
expectSame(const SightEvidence& a, const SightEvidence& b)
{
  EXPECT_EQ(a.confirmed, b.confirmed);
  EXPECT_EQ(a.free, b.free);
  EXPECT_EQ(a.behind, b.behind);
  EXPECT_EQ(a.edge, b.edge);
  EXPECT_EQ(a.unseen, b.unseen);
  EXPECT_EQ(a.patches, b.patches);
  EXPECT_EQ(a.confirmed_patches, b.confirmed_patches);
  EXPECT_EQ(a.contradicted_patches, b.contradicted_patches);
}

/** Two scans of a room with pillars, and a wrong pose that folds it. */
struct TwoScans {
  Random random{7};
  PillarRoom room;
  Isometry T_world_b = shift(1.5, 0.7, 0.1) * Eigen::AngleAxisd(0.4, Vector::UnitZ());
  Points a = room.scan(Isometry::Identity(), random, 0.025);
  Points b = room.scan(T_world_b, random, 0.025);
  Isometry wrong = Eigen::AngleAxisd(M_PI, Vector::UnitZ()) * T_world_b;
};
} // namespace

TEST(SightEvidence, ConfirmsTheRightPoseAndContradictsWrongOnes)
{
  const TwoScans scans;
  const RayImage image = imageOf(scans.a);
  const PlaceUncertainty known{kNoise, MotionCovariance::Zero()};
  const auto evidenceAt = [&](const Isometry& pose) {
    return sightEvidence(image, scans.b, pose, known, kSightPatch);
  };
  const SightEvidence right = evidenceAt(scans.T_world_b);
  EXPECT_EQ(right.free, 0u);
  EXPECT_EQ(right.contradicted_patches, 0u);
  EXPECT_GT(right.confirmation(), 0.6);
  EXPECT_GT(evidenceAt(scans.wrong).contradiction(), 0.05);
  EXPECT_GT(evidenceAt(scans.wrong).contradicted_patches, 20u);
  EXPECT_GT(evidenceAt(shift(1, 0, 0) * scans.T_world_b).contradiction(), 0.05);
}

TEST(SightEvidence, CountsEachFinitePointOnce)
{
  const TwoScans scans;
  Points points = scans.b;
  for (std::size_t i = 0; i < points.size(); i += 10)
    points[i][i % 3] = i % 20 == 0 ? kNan : kInfinity;
  const auto finite = static_cast<std::size_t>(std::count_if(
      points.begin(), points.end(), [](const auto& p) { return p.allFinite(); }));
  ASSERT_LT(finite, points.size());
  for (const Isometry& pose : {scans.T_world_b, scans.wrong, shift(100, 0, 0)}) {
    const auto evidence =
        sightEvidence(imageOf(scans.a), points, pose, {}, kSightPatch);
    EXPECT_EQ(evidence.points(), finite);
    EXPECT_LE(evidence.confirmed_patches + evidence.contradicted_patches,
              evidence.patches);
  }
}

TEST(SightEvidence, IsNoneWithoutPointsOrRays)
{
  const Points wall = wallAt(kWallAway);
  const auto nothing =
      sightEvidence(imageOf(wall), {}, Isometry::Identity(), {}, kSightPatch);
  expectSame(nothing, SightEvidence());
  EXPECT_EQ(nothing.contradiction(), 0);
  EXPECT_EQ(nothing.confirmation(), 0);
  const auto unseen =
      sightEvidence(RayImage(), wall, Isometry::Identity(), {}, kSightPatch);
  EXPECT_EQ(unseen.unseen, wall.size());
  EXPECT_EQ(unseen.contradiction(), 0);
}

TEST(SightEvidence, AddsUp)
{
  const SightEvidence one{1, 2, 3, 4, 5, 6, 7, 8};
  SightEvidence sum{10, 20, 30, 40, 50, 60, 70, 80};
  expectSame(sum += one, {11, 22, 33, 44, 55, 66, 77, 88});
  expectSame(sum, {11, 22, 33, 44, 55, 66, 77, 88});
  EXPECT_EQ(sum.points(), 165u);
  EXPECT_DOUBLE_EQ(sum.contradiction(), 22.0 / 33);
  EXPECT_DOUBLE_EQ(sum.confirmation(), 11.0 / 165);
}

TEST(SightEvidence, DoesNotDependOnTheOrderOfThePoints)
{
  const TwoScans scans;
  Points reversed(scans.b.rbegin(), scans.b.rend());
  const RayImage image = imageOf(scans.a);
  expectSame(sightEvidence(image, reversed, scans.wrong, {}, kSightPatch),
             sightEvidence(image, scans.b, scans.wrong, {}, kSightPatch));
}

TEST(SightEvidence, ContradictsNearlyAllPatchesOfAWallInFrontOfTheMeasuredOne)
{
  const RayImage image = imageOf(wallAt(kWallAway));
  const double tolerance = 3 * kNoise + image.resolution() * kWallAway;
  std::vector<Contradiction> list;
  const double pushed = 10 * tolerance;
  const SightEvidence evidence = sightEvidence(
      image, wallAt(kWallAway), shift(-pushed, 0, 0), {}, kSightPatch, &list);
  EXPECT_EQ(evidence.confirmed, 0u);
  EXPECT_EQ(evidence.contradiction(), 1);
  EXPECT_GT(evidence.patches, 50u);
  EXPECT_GT(evidence.contradicted_patches, 0.95 * evidence.patches);
  EXPECT_EQ(evidence.confirmed_patches, 0u);
  ASSERT_EQ(list.size(), evidence.free);
  std::size_t clear = 0;
  for (const Contradiction& one : list) {
    EXPECT_EQ(one.place.x(), static_cast<float>(kWallAway)) << "in its own frame";
    clear += one.clear;
    // The ray through the place ends at the wall; rays around it a little nearer.
    const Vector place = one.place.cast<double>() - Vector(pushed, 0, 0);
    const double end = place.norm() * kWallAway / place.x();
    const double behind = end - place.norm();
    EXPECT_LE(one.beyond, behind + kCodeTol * 10);
    EXPECT_GE(one.beyond, behind - 4 * image.resolution() * end);
  }
  EXPECT_GT(clear, 0.95 * list.size());
  // The wall behind is hidden, the wall itself confirmed.
  const Points wall = wallAt(kWallAway);
  const auto behind = sightEvidence(image, wall, shift(pushed, 0, 0), {}, kSightPatch);
  EXPECT_EQ(behind.free + behind.confirmed, 0u);
  const auto right = sightEvidence(image, wall, Isometry::Identity(), {}, kSightPatch);
  EXPECT_EQ(right.free, 0u);
  EXPECT_EQ(right.confirmed_patches, right.patches);
}

TEST(SightEvidence, ContradictsNoPatchForSingleOutliers)
{
  Points points = wallAt(4.9); // with outliers 0.25 m before it: of the same patches
  const RayImage image = imageOf(points);
  for (std::size_t i = 0; i < points.size(); i += 7)
    points[i] *= 0.95F;
  for (double y = -1; y <= 1; y += 0.5)
    points.push_back({3, static_cast<float>(y), 0.3F}); // alone in its patch
  std::vector<Contradiction> list;
  const auto evidence =
      sightEvidence(image, points, Isometry::Identity(), {}, kSightPatch, &list);
  EXPECT_GT(evidence.free, 500u);
  EXPECT_EQ(evidence.contradicted_patches, 0u);
  for (const Contradiction& one : list)
    EXPECT_FALSE(one.clear);
}

TEST(SightEvidence, MarksWhichContradictionsAreClearAndKeepsTheList)
{
  const RayImage image = imageOf(wallAt(kWallAway));
  Points points = wallAt(kWallAway);
  for (int i = 0; i < 4; ++i) // of the patch from (3, 0, 0)
    points.push_back({3.1F, 0.1F + 0.01F * static_cast<float>(i), 0.2F});
  points.push_back({3.1F, 1.1F, 0.2F}); // alone
  std::vector<Contradiction> list(2);
  list[0].beyond = 42;
  const auto evidence =
      sightEvidence(image, points, Isometry::Identity(), {}, kSightPatch, &list);
  EXPECT_EQ(evidence.free, 5u);
  EXPECT_EQ(evidence.contradicted_patches, 1u);
  ASSERT_EQ(list.size(), 7u);
  EXPECT_EQ(list[0].beyond, 42);
  EXPECT_FALSE(list[1].clear);
  for (std::size_t i = 2; i < 6; ++i)
    EXPECT_TRUE(list[i].clear) << i;
  EXPECT_FALSE(list[6].clear);
  EXPECT_EQ(list[6].place, points.back());
  expectSame(sightEvidence(image, points, Isometry::Identity(), {}, kSightPatch),
             evidence);
}

TEST(SightEvidence, AsksAPatchForFourPointsAndHalfOfThem)
{
  const RayImage image = imageOf(wallAt(kWallAway));
  // Free at 4.55 m, confirmed at 4.95 m: of one patch from (4.5, 0, 0).
  const auto patchesOf = [&](int free, int confirmed) {
    Points points;
    for (int i = 0; i < free; ++i)
      points.push_back({4.55F, 0.05F * static_cast<float>(i + 1), 0.2F});
    for (int i = 0; i < confirmed; ++i)
      points.push_back({4.95F, 0.05F * static_cast<float>(i + 1), 0.2F});
    const auto e = sightEvidence(image, points, Isometry::Identity(), {}, kSightPatch);
    EXPECT_EQ(e.free, static_cast<std::size_t>(free));
    EXPECT_EQ(e.confirmed, static_cast<std::size_t>(confirmed));
    return std::to_string(e.patches) + std::to_string(e.contradicted_patches) +
           std::to_string(e.confirmed_patches);
  };
  EXPECT_EQ(patchesOf(3, 0), "000") << "too few";
  EXPECT_EQ(patchesOf(4, 0), "110");
  EXPECT_EQ(patchesOf(3, 1), "110");
  EXPECT_EQ(patchesOf(3, 3), "110");
  EXPECT_EQ(patchesOf(2, 2), "100") << "neither";
  EXPECT_EQ(patchesOf(3, 4), "101");
  EXPECT_EQ(patchesOf(0, 4), "101");
  EXPECT_EQ(patchesOf(0, 3), "000");
}

TEST(PlaceUncertainty, WidensTheToleranceAlongTheRay)
{
  constexpr double kBallRadius = 5;
  const Vector origin(0.5, -1, 0.3); // not of the frame: turns lever it, too
  const RayImage image =
      imageOf(scanAround(kSightRays, origin, [](const Vector&) { return kBallRadius; }),
              origin);
  Random random(11);
  for (int trial = 0; trial < 200; ++trial) {
    const Vector d = directionOf(static_cast<std::size_t>(trial), 200);
    const Eigen::Vector3f p = (origin + 0.85 * kBallRadius * d).cast<float>();
    const Vector place = p.cast<double>();
    // How the range answers to a small motion of the place: velocity, then rotation.
    Eigen::Matrix<double, 6, 1> slope;
    constexpr double kStep = 1e-5;
    for (int i = 0; i < 6; ++i) {
      const auto range = [&](double step) {
        Vector moved = place;
        if (i < 3)
          moved[i] += step;
        else
          moved = Eigen::AngleAxisd(step, Vector::Unit(i - 3)) * place;
        return (moved - origin).norm();
      };
      slope[i] = (range(kStep) - range(-kStep)) / (2 * kStep);
    }
    Eigen::Matrix<double, 6, 6> root;
    for (int i = 0; i < 36; ++i)
      root(i / 6, i % 6) = random.normal();
    PlaceUncertainty uncertainty;
    uncertainty.noise = 0.02;
    // The deviation from which on the place is confirmed, by the formula of tolerance.
    const double range = 0.85 * kBallRadius;
    const double needed = (kBallRadius - range - image.resolution() * range) / 3;
    const double motion =
        needed * needed - kNoise * kNoise - uncertainty.noise * uncertainty.noise;
    const MotionCovariance any = root * root.transpose();
    const auto sightOf = [&](double share) {
      uncertainty.motion = any * (share * motion / slope.dot(any * slope));
      return sightEvidence(image, {p}, Isometry::Identity(), uncertainty, kSightPatch);
    };
    EXPECT_EQ(sightOf(0.97).free, 1u) << d.transpose();
    EXPECT_EQ(sightOf(1.03).confirmed, 1u) << d.transpose();
  }
}

TEST(PlaceUncertainty, DoesNotCountAcrossTheRay)
{
  const RayImage image = imageOf(
      scanAround(kSightRays, Vector::Zero(), [](const Vector&) { return 5.0; }));
  PlaceUncertainty uncertainty;
  uncertainty.motion.diagonal() << 0, 9, 9, 1, 1, 1; // a turn moves it across, too
  const auto evidence =
      sightEvidence(image, {{3, 0, 0}}, Isometry::Identity(), uncertainty, kSightPatch);
  EXPECT_EQ(evidence.free, 1u);
}

TEST(PlaceUncertainty, IsNotLostToACovarianceNegativeByRounding)
{
  const RayImage image = imageOf(
      scanAround(kSightRays, Vector::Zero(), [](const Vector&) { return 5.0; }));
  PlaceUncertainty uncertainty;
  uncertainty.motion(0, 0) = -1e-18;
  const auto evidence =
      sightEvidence(image, {{3, 0, 0}}, Isometry::Identity(), uncertainty, kSightPatch);
  EXPECT_EQ(evidence.free, 1u);
}

TEST(SightEvidence, RefusesPatchesWithoutASizeAndPointsTooFarForThem)
{
  const RayImage image = imageOf(wallAt(kWallAway));
  std::vector<Contradiction> list(1);
  const auto messageOf = [&](double patch, const Points& points) {
    return badArgumentOf(
        [&] { sightEvidence(image, points, Isometry::Identity(), {}, patch, &list); });
  };
  const Points before{{3, 0, 0}, {4, 2, 0}};
  EXPECT_EQ(messageOf(0, before), "patch = 0, but must be finite and > 0");
  EXPECT_EQ(messageOf(-1, before), "patch = -1, but must be finite and > 0");
  EXPECT_EQ(messageOf(kNan, before), "patch = nan, but must be finite and > 0");
  EXPECT_EQ(messageOf(kInfinity, before), "patch = inf, but must be finite and > 0");
  EXPECT_NE(messageOf(3.5e-6, before), "") << "4 m are more than 2^20 patches";
  EXPECT_EQ(list.size(), 1u) << "after a throw as before the call";
  EXPECT_EQ(messageOf(kSightPatch, before), "");
  EXPECT_EQ(list.size(), 3u);
}
