// SPDX-License-Identifier: BSD-3-Clause
// A square sheet that faces the scanner 2 m away, and scans in which something else is in
// its place.
#include "object_localization/localization_cases.h"

#include <pcl6d/object_localization/pose_check.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace pcl6d {
namespace {
constexpr double kSide = 0.3, kElement = 0.02, kTolerance = 0.02, kRange = 2; // [m]
constexpr double kSpacing = 0.01 / kRange;                                    // [rad]

/** What a scanner sees of a square across the x axis.
 * \param[in] middle (y, z) of the square [m]
 * \param[in] spacing [rad] of the rays */
void
addSquare(Points& scan,
          double range,
          double side,
          const Eigen::Vector2d& middle = {0, 0},
          double spacing = kSpacing)
{
  OrientedPoints square;
  const Eigen::Vector3d corner(range, middle.x() - side / 2, middle.y() - side / 2);
  test::addPatch(square, {corner, {0, 0, side}, {0, side, 0}}, spacing * range);
  scan.insert(scan.end(), square.points.begin(), square.points.end());
}

/** The sheet in its own frame, seen from -x; at the origin. */
ModelSurface
sheet()
{
  OrientedPoints dense;
  test::addPatch(
      dense, {{0, -kSide / 2, -kSide / 2}, {0, 0, kSide}, {0, kSide, 0}}, 0.005);
  return {dense, kElement};
}

PoseCheck
checked(const Points& scan,
        const Eigen::Isometry3d& T_scene_model = poseFromEuler({kRange, 0, 0}, {}),
        double tolerance = kTolerance)
{
  const ModelSurface model = sheet();
  const LocalizationScene scene(scan);
  const SceneSurface surface(scene.points(), kElement, std::sqrt(2.0) * kSide, 1);
  return checkPose(scene, surface, model, T_scene_model, tolerance);
}

/** The kinds are disjoint, and shares are shares. */
void
expectSane(const PoseCheck& check)
{
  EXPECT_LE(check.facing(), check.elements);
  EXPECT_LE(check.visibleFraction(), 1);
  EXPECT_LE(check.agreement(), 1);
  EXPECT_LE(check.freeSpaceViolation(), 1);
  EXPECT_LE(check.continued, check.support.size());
  EXPECT_TRUE(std::is_sorted(check.support.begin(), check.support.end()));
  EXPECT_EQ(std::adjacent_find(check.support.begin(), check.support.end()),
            check.support.end());
}
} // namespace

TEST(CheckPose, SupportsWhatIsThere)
{
  Points scan;
  addSquare(scan, kRange, kSide);
  const PoseCheck check = checked(scan);
  expectSane(check);
  EXPECT_GT(check.elements, 200u);
  EXPECT_EQ(check.supported, check.elements);
  EXPECT_EQ(check.visibleFraction(), 1);
  EXPECT_EQ(check.agreement(), 1);
  EXPECT_EQ(check.freeSpaceViolation(), 0);
  EXPECT_LT(check.continuation(), 0.1);
  EXPECT_LT(check.rms, 1e-3);
  EXPECT_GT(check.support.size(), 200u);
}

TEST(CheckPose, RefutesWhatTheScannerSawThrough)
{
  Points scan;
  addSquare(scan, 3, 2);
  const PoseCheck check = checked(scan);
  expectSane(check);
  EXPECT_GT(check.refuted, 150u);
  EXPECT_EQ(check.supported + check.occluded + check.misfit, 0u);
  EXPECT_EQ(check.freeSpaceViolation(), 1);
  EXPECT_EQ(check.visibleFraction(), 0);
}

TEST(CheckPose, RefutesBetweenTheRaysOfACoarseScan)
{
  // Rays are three elements apart here, and none meets an element: those are refuted that
  // lie so far between rays that it takes all around to tell.
  Points scan;
  addSquare(scan, 3, 2, {0, 0}, 0.031);
  const PoseCheck check = checked(scan);
  expectSane(check);
  EXPECT_GT(check.refuted, 20u);
  EXPECT_EQ(check.supported + check.occluded + check.misfit + check.unseen, 0u);
  // Not if a ray nearby ended before the object.
  addSquare(scan, 1.5, 0.4, {0, 0}, 0.031);
  EXPECT_EQ(checked(scan).refuted, 0u);
}

TEST(CheckPose, SaysNothingOfAnObjectBeyondAllNumbers)
{
  Points scan;
  addSquare(scan, kRange, kSide);
  for (const double far : {1e19, 1e30, 1e100, 1e300}) {
    const PoseCheck check = checked(scan, poseFromEuler({far, 0, 0}, {}));
    expectSane(check);
    EXPECT_EQ(check.supported + check.refuted, 0u) << far;
    EXPECT_EQ(check.visibleFraction(), 0) << far;
  }
}

TEST(CheckPose, DoesNotCountWhatIsHidden)
{
  Points scan;
  addSquare(scan, 1.7, 0.5);
  const PoseCheck hidden = checked(scan);
  expectSane(hidden);
  EXPECT_GT(hidden.occluded, 80u); // the others met no ray
  EXPECT_EQ(hidden.supported + hidden.refuted + hidden.misfit, 0u);
  // Half of it behind something: what is seen fits.
  scan.clear();
  addSquare(scan, 1.7, 0.5, {0.25, 0});
  OrientedPoints half;
  test::addPatch(
      half, {{kRange, -kSide / 2, -kSide / 2}, {0, 0, kSide}, {0, kSide / 2, 0}}, 0.01);
  scan.insert(scan.end(), half.points.begin(), half.points.end());
  const PoseCheck check = checked(scan);
  expectSane(check);
  EXPECT_GT(check.visibleFraction(), 0.45);
  EXPECT_LT(check.visibleFraction(), 0.85); // too much: the near surface is coarse
  EXPECT_EQ(check.refuted, 0u);
  EXPECT_GT(check.agreement(), 0.9);
}

TEST(CheckPose, TellsAMisfit)
{
  Points scan; // between what fits and what is behind
  addSquare(scan, kRange + 1.7 * kTolerance, kSide);
  const PoseCheck check = checked(scan);
  expectSane(check);
  EXPECT_GT(check.misfit, 150u);
  EXPECT_LT(check.agreement(), 0.1);
  EXPECT_EQ(check.freeSpaceViolation(), check.supported + check.refuted == 0 ? 1 : 0);
}

TEST(CheckPose, KnowsNothingOfWhereNothingWasMeasured)
{
  Points scan;
  addSquare(scan, kRange, kSide, {1, 0});
  const PoseCheck check = checked(scan);
  expectSane(check);
  EXPECT_EQ(check.unseen, check.elements);
  EXPECT_EQ(check.visibleFraction(), 0);
}

TEST(CheckPose, SeesThatASurfaceGoesOn)
{
  Points scan; // not so large that it is a wall
  addSquare(scan, kRange, 1.25 * kSide);
  const PoseCheck check =
      checked(scan, poseFromEuler({kRange, 0, 0}, {}), kTolerance / 2);
  expectSane(check);
  EXPECT_EQ(check.supported, check.elements);
  EXPECT_GT(check.continuation(), 0.4);
}

TEST(CheckPose, TakesAWallForNoObject)
{
  Points scan;
  addSquare(scan, kRange, 5 * kSide);
  const PoseCheck check = checked(scan);
  expectSane(check);
  EXPECT_EQ(check.supported, 0u);
  EXPECT_EQ(check.agreement(), 0);
}

TEST(CheckPose, SaysNothingOfABackSide)
{
  Points scan;
  addSquare(scan, kRange, kSide);
  const PoseCheck check = checked(scan, poseFromEuler({kRange, 0, 0}, {0, 0, M_PI}));
  EXPECT_EQ(check.elements, 0u);
  EXPECT_EQ(check.visibleFraction(), 0);
  EXPECT_EQ(check.agreement(), 0);
  EXPECT_EQ(check.freeSpaceViolation(), 1);
  EXPECT_EQ(check.continuation(), 0);
}

} // namespace pcl6d
