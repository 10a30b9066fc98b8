// SPDX-License-Identifier: BSD-3-Clause
// The vertical from normals: exact rooms, tilted ones, narrow views, and what has none.
#include "support/points.h"
#include "support/poses.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/random.h>
#include <pcl6d/global_registration/vertical.h>

#include <gtest/gtest.h>

#include <cmath>

using pcl6d::estimateVertical;
using pcl6d::kDegree;
using pcl6d::Normals;
using pcl6d::Random;
using pcl6d::uprightRotation;
using pcl6d::VerticalEstimate;
using pcl6d::test::badArgumentOf;
using Vector = Eigen::Vector3d;

namespace {
// Normals are floats, and their sums are of thousands.
constexpr double kExactTol = 1e-5; // [rad]

/** Adds a normal so many times, each scattered by sigma [rad]. */
void
add(Normals& normals, const Vector& n, int count, Random& random, double sigma = 0)
{
  for (int i = 0; i < count; ++i) {
    const Vector noise(random.normal(), random.normal(), random.normal());
    normals.push_back((n + sigma * noise).normalized().cast<float>());
  }
}

/** Floor, and walls of four directions, two of them askew. */
Normals
roomNormals(double sigma = 0)
{
  Random random(3);
  Normals normals;
  add(normals, Vector::UnitZ(), 300, random, sigma);
  for (const double yaw : {0.3, 0.3 + M_PI / 2, 1.0, 2.4})
    add(normals, {std::cos(yaw), std::sin(yaw), 0}, 200, random, sigma);
  return normals;
}

Normals
turned(const Normals& normals, const Eigen::Matrix3d& R)
{
  Normals result;
  for (const auto& n : normals)
    result.push_back((R * n.cast<double>()).cast<float>());
  return result;
}

double
angleBetween(const Vector& a, const Vector& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Eigen::Matrix3d
tilt(double roll, double pitch)
{
  return pcl6d::poseFromEuler(Vector::Zero(), {roll, pitch, 0}).linear();
}
} // namespace

TEST(Vertical, OfExactSurfacesIsExact)
{
  for (const double angle : {0.0, 0.05, 0.3, 0.55}) {
    SCOPED_TRACE(angle);
    const Eigen::Matrix3d R = tilt(angle, -0.3 * angle);
    const VerticalEstimate found = estimateVertical(turned(roomNormals(), R));
    EXPECT_LT(angleBetween(found.up, R * Vector::UnitZ()), kExactTol);
    EXPECT_NEAR(found.share, 1, 1e-12);
    EXPECT_TRUE(found.is_sure);
  }
}

TEST(Vertical, OfRoughSurfacesIsTheirMean)
{
  // 5 deg of scatter on 300 normals of the floor and 800 of walls, times four.
  constexpr double kRough = 5 * kDegree, kTol = 4 * kRough / 17;
  const Eigen::Matrix3d R = tilt(0.2, 0.1);
  const VerticalEstimate found = estimateVertical(turned(roomNormals(kRough), R));
  EXPECT_LT(angleBetween(found.up, R * Vector::UnitZ()), kTol);
  EXPECT_TRUE(found.is_sure);
}

TEST(Vertical, TurnsWithTheSurfacesAndWithWhatIsExpected)
{
  const Eigen::Matrix3d R = tilt(1.9, -0.7);
  const Normals rough = roomNormals(0.03);
  const VerticalEstimate before = estimateVertical(rough);
  const VerticalEstimate after =
      estimateVertical(turned(rough, R), R * Vector::UnitZ());
  EXPECT_LT(angleBetween(after.up, R * before.up), kExactTol);
}

TEST(Vertical, WhatIsExpectedTellsUpFromDown)
{
  const VerticalEstimate found = estimateVertical(roomNormals(), -Vector::UnitZ());
  EXPECT_LT(angleBetween(found.up, -Vector::UnitZ()), kExactTol);
}

TEST(Vertical, OfASensorThatLooksDownIsStillFound)
{
  // Walls askew tell the vertical, though the sensor's own z lies level.
  Random random(4);
  Normals normals;
  add(normals, Vector::UnitX(), 200, random);
  for (const double yaw : {0.2, 0.6, 1.0, 2.1, 2.6})
    add(normals, {0, std::cos(yaw), std::sin(yaw)}, 200, random);
  const VerticalEstimate found = estimateVertical(normals);
  EXPECT_LT(angleBetween(found.up, Vector::UnitX()), kExactTol);
  EXPECT_TRUE(found.is_sure);
}

TEST(Vertical, ABareRoomHasOtherAxes)
{
  Random random(5);
  Normals normals;
  for (const Vector& n :
       {Vector(Vector::UnitX()), Vector(Vector::UnitY()), Vector(Vector::UnitZ())})
    add(normals, n, 200, random);
  const VerticalEstimate found = estimateVertical(normals);
  EXPECT_LT(angleBetween(found.up, Vector::UnitZ()), kExactTol);
  ASSERT_EQ(found.others.size(), 2u);
  for (const auto& other : found.others)
    EXPECT_LT(std::abs(other.dot(found.up)), kExactTol);
}

TEST(Vertical, OneWallInViewDoesNotTurnItOver)
{
  // Normals of a wall and of rubble before it: across many directions along the wall.
  Random random(6);
  Normals normals;
  add(normals, -Vector::UnitX(), 600, random, 0.05);
  add(normals, Vector::UnitZ(), 100, random, 0.02);
  for (int i = 0; i < 300; ++i) {
    const double angle = random.uniform(-1, 1);
    add(normals, {-std::cos(angle), 0, std::sin(angle)}, 1, random, 0.02);
  }
  const VerticalEstimate found = estimateVertical(normals);
  EXPECT_LT(angleBetween(found.up, Vector::UnitZ()), 5 * kDegree);
}

TEST(Vertical, OfLeavesIsTheExpectedOneAndUnsure)
{
  Random random(7);
  Normals normals;
  add(normals, Vector::Zero(), 2000, random, 1);
  const Vector expected = Vector(0.1, 0.2, 0.9).normalized();
  const VerticalEstimate found = estimateVertical(normals, expected);
  EXPECT_EQ(found.up, expected);
  EXPECT_FALSE(found.is_sure);
}

TEST(Vertical, WithoutNormalsIsTheExpectedOne)
{
  for (const Normals& normals :
       {Normals(),
        Normals(10, Eigen::Vector3f::Zero()),
        Normals(10, Eigen::Vector3f::Constant(pcl6d::test::kNan))}) {
    const VerticalEstimate found = estimateVertical(normals);
    EXPECT_EQ(found.up, Vector(Vector::UnitZ()));
    EXPECT_EQ(found.share, 0);
    EXPECT_FALSE(found.is_sure);
  }
}

TEST(Vertical, RefusesWhatIsNoUnitVector)
{
  const auto words = badArgumentOf([] { estimateVertical({}, {0, 0, 2}); });
  EXPECT_NE(words.find("expected"), std::string::npos) << words;
  EXPECT_NE(badArgumentOf([] { uprightRotation(Vector::Zero()); }).find("up"),
            std::string::npos);
}

TEST(UprightRotation, TurnsUpToZ)
{
  for (const Vector& up :
       {Vector(0, 0, 1), Vector(0, 0, -1), Vector(1, 0, 0), Vector(0.6, 0, 0.8)}) {
    const Eigen::Matrix3d R = uprightRotation(up);
    EXPECT_LT((R * up - Vector::UnitZ()).norm(), 1e-12);
    EXPECT_NEAR(R.determinant(), 1, 1e-12);
  }
}
