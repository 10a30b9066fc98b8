// SPDX-License-Identifier: BSD-3-Clause
// Which motions surfaces fix, of scenes whose answer is known.
#include "support/pairs.h"

#include <pcl6d/registration/localizability.h>

#include <Eigen/LU>
#include <gtest/gtest.h>

using pcl6d::Localizability;
using pcl6d::localizabilityOf;
using pcl6d::PlaneAccumulator;
using pcl6d::PlaneSums;
using pcl6d::Random;
using pcl6d::Twist;
using pcl6d::test::normalVector;

namespace {
constexpr int kSamples = 3000;
const Eigen::Isometry3d kScenePose =
    pcl6d::poseFromEuler({20, -10, 5}, {0.4, -0.3, 1.2});

/** Sums of pairs that touch, given by a place and a normal in a scene at kScenePose. */
template <typename Draw>
PlaneSums
sumsOf(Draw draw)
{
  PlaneAccumulator sums;
  for (int i = 0; i < kSamples; ++i) {
    const auto [place, normal] = draw(i);
    sums.add(kScenePose * place, kScenePose * place, kScenePose.linear() * normal);
  }
  return sums.sums();
}

using PlaceAndNormal = std::pair<Eigen::Vector3d, Eigen::Vector3d>;

/** \return a point on the six sides of a cube about the origin */
PlaceAndNormal
onCube(Random& random, int i, double half)
{
  Eigen::Vector3d p = pcl6d::test::randomVector(random, half);
  const int axis = i % 3;
  p[axis] = i % 2 ? half : -half;
  return {p, Eigen::Vector3d::Unit(axis)};
}

void
expectSound(const Localizability& found)
{
  EXPECT_EQ(found.directions.fullPivLu().rank(), 6) << "every motion is made of them";
  EXPECT_GE(found.eigenvalues(0), 0);
  EXPECT_LE(found.eigenvalues(5), 1 + 1e-12);
  for (int i = 0; i < 5; ++i)
    EXPECT_LE(found.eigenvalues(i), found.eigenvalues(i + 1));
}

/** \return the open motion of a direction: velocity of a point, in the scene's frame */
Eigen::Vector3d
velocityAt(const Localizability& found, int i, const Eigen::Vector3d& place)
{
  const Twist u = found.directions.col(i);
  const Eigen::Vector3d turn = u.tail<3>();
  const Eigen::Vector3d v =
      u.head<3>() + turn.cross(kScenePose * place - found.centroid);
  return kScenePose.linear().transpose() * v;
}
} // namespace

TEST(Localizability, OfABoxIsFixedInAllDirections)
{
  Random random(1);
  const auto found =
      localizabilityOf(sumsOf([&](int i) { return onCube(random, i, 2); }));
  expectSound(found);
  EXPECT_EQ(found.openDirections(), 0);
  // Translations 1/3 each. A turn about an axis: mean (d x n)^2 = 2/9 h^2 of the mean
  // squared distance 10/9 h^2 from it.
  EXPECT_NEAR(found.eigenvalues.sum(), 1 + 0.6, 0.02);
  EXPECT_NEAR(found.eigenvalues(5), 1.0 / 3, 0.02);
  EXPECT_NEAR(found.eigenvalues(0), 0.2, 0.02);
  EXPECT_LT((found.centroid - kScenePose.translation()).norm(), 0.1);
}

TEST(Localizability, OfACorridorIsOpenAlongIt)
{
  Random random(2);
  const auto found = localizabilityOf(sumsOf([&](int i) {
    PlaceAndNormal at = onCube(random, i, 1);
    while (at.second.x() == 1)
      at = onCube(random, ++i, 1);
    at.first.x() *= 10;
    return at;
  }));
  expectSound(found);
  EXPECT_EQ(found.openDirections(), 1);
  EXPECT_LT(found.eigenvalues(0), 1e-12);
  const Eigen::Vector3d along = kScenePose.linear().col(0);
  EXPECT_NEAR(std::abs(found.directions.col(0).head<3>().dot(along)), 1, 1e-9);
  EXPECT_LT(found.directions.col(0).tail<3>().norm(), 1e-6);
}

TEST(Localizability, OfAPlaneIsOpenThreefold)
{
  Random random(3);
  const auto found = localizabilityOf(sumsOf([&](int) {
    const Eigen::Vector3d p = pcl6d::test::randomVector(random, 3);
    return PlaceAndNormal({p.x(), p.y(), 0}, Eigen::Vector3d::UnitZ());
  }));
  expectSound(found);
  EXPECT_EQ(found.openDirections(), 3);
  EXPECT_NEAR(found.eigenvalues.sum(), 3, 1e-9) << "one shift and two turns, whole";
  for (int i = 0; i < 3; ++i)
    for (const Eigen::Vector3d& p :
         {Eigen::Vector3d(1, 2, 0), Eigen::Vector3d(-3, 1, 0)})
      EXPECT_LT(std::abs(velocityAt(found, i, p).z()), 1e-6) << "stays in the plane";
}

TEST(Localizability, OfASphereIsOpenToTurnsAboutItsCentre)
{
  Random random(4);
  for (const bool half : {false, true}) {
    const auto found = localizabilityOf(sumsOf([&](int) {
      Eigen::Vector3d n = normalVector(random, 1).normalized();
      if (half)
        n.z() = std::abs(n.z());
      return PlaceAndNormal(2 * n, n);
    }));
    expectSound(found);
    EXPECT_EQ(found.openDirections(), 3);
    for (int i = 0; i < 3; ++i) {
      EXPECT_LT(found.eigenvalues(i), 1e-12);
      EXPECT_LT(velocityAt(found, i, Eigen::Vector3d::Zero()).norm(), 1e-6);
    }
    EXPECT_GT(found.eigenvalues(3), 0.01);
  }
}

TEST(Localizability, OfACylinderIsOpenTwofold)
{
  Random random(5);
  const auto found = localizabilityOf(sumsOf([&](int) {
    const double a = random.uniform(0, 2 * M_PI);
    const Eigen::Vector3d n(0, std::cos(a), std::sin(a));
    return PlaceAndNormal(n + random.uniform(-5, 5) * Eigen::Vector3d::UnitX(), n);
  }));
  expectSound(found);
  EXPECT_EQ(found.openDirections(), 2);
  for (int i = 0; i < 2; ++i)
    for (const double x : {-3.0, 0.0, 4.0}) {
      const Eigen::Vector3d v = velocityAt(found, i, {x, 0, 0});
      EXPECT_LT(v.tail<2>().norm(), 1e-6) << "the axis stays where it is";
    }
}

TEST(Localizability, DoesNotDependOnWhereTheSceneStandsNorOnItsUnit)
{
  const auto with = [](double unit, const Eigen::Vector3d& shift) {
    Random random(6);
    PlaneAccumulator sums;
    for (int i = 0; i < kSamples; ++i) {
      const auto [p, n] = onCube(random, i, 2);
      const Eigen::Vector3d at = unit * (p + shift);
      sums.add(at, at, n);
    }
    return localizabilityOf(sums.sums());
  };
  const auto plain = with(1, {0, 0, 0});
  EXPECT_LT((with(1, {1e5, -1e5, 1e5}).eigenvalues - plain.eigenvalues).norm(), 1e-6);
  EXPECT_LT((with(1e-3, {0, 0, 0}).eigenvalues - plain.eigenvalues).norm(), 1e-9);
  EXPECT_LT((with(1e3, {0, 0, 0}).eigenvalues - plain.eigenvalues).norm(), 1e-9);
}

TEST(Localizability, OfNothingIsOpenInAllDirections)
{
  expectSound(localizabilityOf(PlaneSums()));
  EXPECT_EQ(localizabilityOf(PlaneSums()).openDirections(), 6);
  PlaneAccumulator one, same;
  one.add({1, 2, 3}, {1, 2, 3}, {0, 0, 1});
  EXPECT_EQ(localizabilityOf(one.sums()).openDirections(), 5);
  for (int i = 0; i < 10; ++i)
    same.add({1, 2, 3}, {1, 2, 3}, Eigen::Vector3d::Unit(i % 3));
  expectSound(localizabilityOf(same.sums()));
  EXPECT_EQ(localizabilityOf(same.sums()).openDirections(), 3);
  PlaneSums bad = one.sums();
  bad.A(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(localizabilityOf(bad).openDirections(), 6);
}
