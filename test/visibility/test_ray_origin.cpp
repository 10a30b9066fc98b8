// SPDX-License-Identifier: BSD-3-Clause
#include "rays.h"
#include "support/points.h"
#include "support/room.h"

#include <pcl6d/visibility/ray_origin.h>

using pcl6d::crossedShare;
using pcl6d::isPlausibleOrigin;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::RayImageOptions;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kNan;
using pcl6d::test::PillarRoom;
using pcl6d::test::scanAround;
using Isometry = Eigen::Isometry3d;

namespace {
const Eigen::Vector3f kZero = Eigen::Vector3f::Zero();

Points
scanOfRoom()
{
  Random random(3);
  return PillarRoom().scan(Isometry::Identity(), random, 0.02, 0.005);
}

/** \return the scan as a cut-out in a common frame */
Points
movedBy(const Eigen::Vector3d& offset)
{
  return pcl6d::transformed(scanOfRoom(), Isometry(Eigen::Translation3d(offset)));
}

/** \return the points that a rule keeps */
template <typename Rule>
Points
keptOf(const Points& points, Rule rule)
{
  Points kept;
  for (const auto& p : points)
    if (rule(p))
      kept.push_back(p);
  return kept;
}
} // namespace

TEST(RayOrigin, OfAScanIsPlausible)
{
  EXPECT_LT(crossedShare(scanOfRoom(), kZero), 0.01);
  EXPECT_TRUE(isPlausibleOrigin(scanOfRoom()));
}

TEST(RayOrigin, OfACutOutInACommonFrameIsNot)
{
  for (const Eigen::Vector3d& offset : {Eigen::Vector3d(6, 31, 49),
                                        Eigen::Vector3d(400, 0, 0),
                                        Eigen::Vector3d(5000, 3000, 100),
                                        Eigen::Vector3d(0, 0, 20)}) {
    SCOPED_TRACE(offset.transpose());
    const Points far = movedBy(offset);
    EXPECT_FALSE(isPlausibleOrigin(far));
    EXPECT_TRUE(isPlausibleOrigin(far, offset.cast<float>()))
        << "where the scanner stood";
  }
}

TEST(RayOrigin, CrossesTheBackOfAHollowBody)
{
  // Law: of a hollow body seen from outside each ray meets a front and a back; the back is the
  // half that is crossed.
  const Points ball = scanAround(
      20000, Eigen::Vector3d(30, 0, 0), [](const Eigen::Vector3d&) { return 5.0; });
  constexpr double kRimTol = 0.15; // at the rim front and back are one surface
  EXPECT_NEAR(crossedShare(ball, kZero), 0.5, kRimTol);
  EXPECT_EQ(crossedShare(ball, {30, 0, 0}), 0);
}

TEST(RayOrigin, StaysPlausibleForPartsOfAScan)
{
  const Points scan = scanOfRoom();
  const Points side = keptOf(scan, [](const auto& p) { return p.x() > 0; });
  const Points without_cone =
      keptOf(scan, [](const auto& p) { return p.z() > -0.7F * p.norm(); });
  // A depth camera: the origin lies outside of the hull of the points.
  const Points view = keptOf(scan, [](const auto& p) {
    return p.x() > 0 && std::abs(p.y()) < 0.5F * p.x() &&
           std::abs(p.z()) < 0.4F * p.x();
  });
  const Points line =
      keptOf(scan, [](const auto& p) { return std::abs(p.z()) < 0.02; });
  ASSERT_GT(line.size(), 50u);
  ASSERT_GT(view.size(), 500u);
  for (const Points* part : {&side, &without_cone, &view, &line})
    EXPECT_TRUE(isPlausibleOrigin(*part));
}

TEST(RayOrigin, StaysPlausibleBehindGlassAndFences)
{
  // Every fifth ray ends at a pane of glass 2 m ahead, the others at walls behind.
  Points scan = scanOfRoom();
  for (std::size_t i = 0; i < scan.size(); i += 5)
    if (scan[i].x() > 2)
      scan[i] *= 2 / scan[i].x();
  EXPECT_TRUE(isPlausibleOrigin(scan));
}

TEST(RayOrigin, TakesAnyPoints)
{
  EXPECT_EQ(crossedShare({}, kZero), 0);
  EXPECT_EQ(crossedShare({{1, 2, 3}}, kZero), 0);
  EXPECT_EQ(crossedShare(Points(100, {kNan, 0, 0}), kZero), 0);
  EXPECT_EQ(crossedShare(Points(100, {0, 0, 0}), kZero), 0);
  EXPECT_EQ(crossedShare(Points(100, {1, 2, 3}), kZero), 0) << "copies";
  Points with = scanOfRoom();
  const double before = crossedShare(with, kZero);
  with.push_back({kNan, 1, 1});
  EXPECT_EQ(crossedShare(with, kZero), before);
}

TEST(RayOrigin, LeavesNoRaysWhereItIsNoScanner)
{
  const Points far = movedBy({6, 31, 49});
  EXPECT_EQ(pcl6d::plausibleRays(far).resolution(), 0);
  RayImageOptions there;
  there.origin = {6, 31, 49};
  EXPECT_GT(pcl6d::plausibleRays(far, there).resolution(), 0);
  there.noise = -1;
  EXPECT_NE(badArgumentOf([&] { pcl6d::plausibleRays(far, there); }), "");
}
