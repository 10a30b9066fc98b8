// SPDX-License-Identifier: BSD-3-Clause
// Spheres and boards of known centres in terrestrial scans of a room.
#include "target_room.h"

#include <pcl6d/common/error.h>
#include <pcl6d/object_localization/scan_targets.h>

#include <gtest/gtest.h>

#include <cmath>

using Eigen::Vector3d;
using pcl6d::findTargets;
using pcl6d::FoundTarget;
using pcl6d::Points;
using pcl6d::RejectedTarget;
using pcl6d::TargetFault;
using pcl6d::TargetKind;
using pcl6d::TargetOptions;
using pcl6d::TargetSearch;
using pcl6d::test::Ball;
using pcl6d::test::kDiameter;
using pcl6d::test::kSize;
using pcl6d::test::Square;
using pcl6d::test::TargetRoom;

namespace {
TargetOptions
bothKinds()
{
  TargetOptions options;
  options.sphere_diameters = {kDiameter};
  options.board_sizes = {kSize};
  return options;
}

TargetSearch
searchIn(const TargetRoom& room, std::uint64_t seed = 1)
{
  std::vector<float> intensity;
  const Points points = room.scan(seed, intensity);
  return findTargets(points, intensity, bothKinds());
}

/** Four deviations of the centre: one in a thousand exceeds them, in three coordinates. */
double
boundOf(const FoundTarget& target)
{
  return 4 * std::sqrt(3.0) * target.sigma;
}

const std::vector<Ball> kBalls = {{{2, 1, 0.2}}, {{-3, 0.5, -0.4}}, {{0.5, -2.5, 0.6}}};
} // namespace

TEST(ScanTargets, FindsSpheresWithinTheirStandardDeviation)
{
  double squares = 0;
  std::size_t count = 0;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const TargetSearch search = searchIn({kBalls, {}, {}}, seed);
    ASSERT_EQ(search.found.size(), 3U);
    EXPECT_TRUE(search.rejected.empty());
    const std::size_t order[] = {0, 2, 1}; // by distance
    for (std::size_t k = 0; k < 3; ++k) {
      const FoundTarget& target = search.found[k];
      EXPECT_EQ(target.kind, TargetKind::kSphere);
      const double error = (target.centre - kBalls[order[k]].centre).norm();
      EXPECT_LT(error, boundOf(target));
      EXPECT_LT(target.sigma, 0.001);
      EXPECT_GT(target.quality, 0.9);
      squares += error * error / (3 * target.sigma * target.sigma);
      ++count;
    }
  }
  // The mean square in deviations is 1; of 18 coordinates it has a deviation of 0.33.
  EXPECT_LT(squares / static_cast<double>(count), 2);
  EXPECT_GT(squares / static_cast<double>(count), 0.4);
}

TEST(ScanTargets, FindsBoardsWithinTheirStandardDeviation)
{
  const std::vector<Square> squares = {
      {{3, 0, 0.3}, Vector3d(1, 0, 0)},
      {{0, 2.5, -0.3}, Vector3d(0.5, 0.8, 0.1).normalized(), kSize, 1.1},
      {{-2, -1, 0}, Vector3d(1, -0.2, 0.3).normalized(), kSize, -0.4}};
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const TargetSearch search = searchIn({{}, squares, {}}, seed);
    ASSERT_EQ(search.found.size(), 3U);
    for (const FoundTarget& target : search.found) {
      EXPECT_EQ(target.kind, TargetKind::kBoard);
      double error = 1;
      for (const Square& square : squares)
        error = std::min(error, (target.centre - square.centre).norm());
      EXPECT_LT(error, boundOf(target));
      EXPECT_LT(target.sigma, 0.002);
      sum += error * error / (3 * target.sigma * target.sigma);
    }
  }
  EXPECT_LT(sum / 6, 2);
  EXPECT_GT(sum / 6, 0.1);
}

TEST(ScanTargets, FindsAPartlyHiddenSphereAndNamesOneThatIsMostlyHidden)
{
  const Ball ball{{2, 1, 0.2}};
  const Vector3d side = ball.centre.unitOrthogonal();
  TargetRoom room{{ball}, {}, {{0.6 * ball.centre + 0.25 * side, 0.5}}};
  const TargetSearch part = searchIn(room);
  ASSERT_EQ(part.found.size(), 1U);
  EXPECT_LT(part.found[0].quality, 1);
  EXPECT_LT((part.found[0].centre - ball.centre).norm(), boundOf(part.found[0]));
  room.screens[0].centre = 0.6 * ball.centre + 0.224 * side;
  const TargetSearch rest = searchIn(room);
  EXPECT_TRUE(rest.found.empty());
  ASSERT_EQ(rest.rejected.size(), 1U);
  EXPECT_EQ(rest.rejected[0].fault, TargetFault::kMostlyHidden);
  EXPECT_GT(rest.rejected[0].measured, 0.2);
  EXPECT_LT(rest.rejected[0].measured, 0.5);
}

TEST(ScanTargets, NamesABallOfAnotherSize)
{
  const TargetSearch search = searchIn({{{{2, 1, 0.2}, 0.2}}, {}, {}});
  EXPECT_TRUE(search.found.empty());
  ASSERT_EQ(search.rejected.size(), 1U);
  EXPECT_EQ(search.rejected[0].fault, TargetFault::kOtherDiameter);
  EXPECT_NEAR(search.rejected[0].measured, 0.2, 0.01) << "[m]";
}

TEST(ScanTargets, NamesABoardAtAGrazingAngleAndASmallerOne)
{
  const Vector3d at(1.5, 0, 0.2);
  const Vector3d ray = at.normalized();
  const double angle = 76 * M_PI / 180;
  const Vector3d normal = std::cos(angle) * ray +
                          std::sin(angle) * Vector3d(-ray.y(), ray.x(), 0).normalized();
  const TargetSearch grazing = searchIn({{}, {{at, normal.normalized()}}, {}});
  EXPECT_TRUE(grazing.found.empty());
  ASSERT_EQ(grazing.rejected.size(), 1U);
  EXPECT_EQ(grazing.rejected[0].fault, TargetFault::kGrazingAngle);
  EXPECT_NEAR(grazing.rejected[0].measured, angle, 0.02) << "[rad]";
  const TargetSearch small = searchIn({{}, {{at, ray, 0.1}}, {}});
  EXPECT_TRUE(small.found.empty());
}

TEST(ScanTargets, NamesEachFaultWithItsNumber)
{
  const auto words = [](TargetKind kind, TargetFault fault, double measured) {
    return toWords(RejectedTarget{kind, 0.15, Vector3d::Zero(), fault, measured});
  };
  EXPECT_EQ(words(TargetKind::kSphere, TargetFault::kOtherDiameter, 0.2),
            "its diameter is 0.200 m");
  EXPECT_EQ(words(TargetKind::kSphere, TargetFault::kMostlyHidden, 0.31),
            "only 31 % of the visible side have points");
  EXPECT_EQ(words(TargetKind::kBoard, TargetFault::kGrazingAngle, 76 * M_PI / 180),
            "seen at 76 deg, at most 70 deg");
  EXPECT_EQ(
      words(TargetKind::kBoard, TargetFault::kSmallerBoard, 0.62),
      "smaller than 0.15 m: near the border 62 % of the points have the colour of "
      "their quarter");
}

TEST(ScanTargets, FindsNoneWhereThereAreNone)
{
  const TargetSearch search = searchIn({});
  EXPECT_TRUE(search.found.empty());
  EXPECT_TRUE(search.rejected.empty());
  EXPECT_TRUE(findTargets({}, {}, bothKinds()).found.empty());
  EXPECT_TRUE(findTargets(Points(50, {pcl6d::test::kNan, 0, 0}), {}, bothKinds())
                  .found.empty());
  EXPECT_TRUE(
      findTargets(Points(500, {1, 2, 3}), std::vector<float>(500, 1), bothKinds())
          .found.empty());
}

TEST(ScanTargets, AreTheSameForAnyNumberOfThreads)
{
  std::vector<float> intensity;
  const Points points =
      TargetRoom{kBalls, {{{3, 0, 0.3}, Vector3d(1, 0, 0)}}, {}}.scan(1, intensity);
  TargetOptions one = bothKinds(), four = bothKinds();
  one.num_threads = 1;
  four.num_threads = 4;
  const TargetSearch a = findTargets(points, intensity, one);
  const TargetSearch b = findTargets(points, intensity, four);
  ASSERT_EQ(a.found.size(), 4U);
  ASSERT_EQ(b.found.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_TRUE(a.found[k].centre == b.found[k].centre);
}

TEST(ScanTargets, NamesWrongOptions)
{
  TargetOptions options;
  options.sphere_diameters = {0};
  EXPECT_THROW(findTargets({}, {}, options), pcl6d::BadArgument);
  options = {};
  options.board_sizes = {-1};
  EXPECT_THROW(findTargets({}, {}, options), pcl6d::BadArgument);
  options = {};
  EXPECT_THROW(findTargets(Points(2), {1}, options), pcl6d::BadArgument);
}
