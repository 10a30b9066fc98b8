// SPDX-License-Identifier: BSD-3-Clause
#include "moving_room.h"
#include "support/points.h"

namespace pcl6d {
namespace {

using namespace test;

/** Somebody who walks through a room. */
const std::vector<TrueScan>&
walkerScene()
{
  static const std::vector<TrueScan> scans = [] {
    MovingRoom room;
    room.step = 0.025;
    return scansOf(room, 5, [](std::size_t i) {
      return std::vector<Body>{walker(-3.5 + 1.2 * static_cast<double>(i), 2.2)};
    });
  }();
  return scans;
}

MovingScans
added()
{
  MovingScans scans;
  for (const TrueScan& scan : walkerScene())
    scans.add(scan.points, scan.T_world_scan);
  return scans;
}

TEST(MovingScans, NumberScansAsTheyCome)
{
  MovingScans scans;
  EXPECT_EQ(scans.size(), 0u);
  EXPECT_EQ(scans.add(walkerScene()[0].points, walkerScene()[0].T_world_scan), 0u);
  EXPECT_EQ(scans.add(walkerScene()[1].points, walkerScene()[1].T_world_scan), 1u);
  EXPECT_EQ(scans.size(), 2u);
  EXPECT_EQ(scans.observers().size(), 2u);
  scans.add(walkerScene()[2].points, walkerScene()[2].T_world_scan);
  EXPECT_EQ(scans.observers().size(), 3u) << "also after they have judged";
}

TEST(MovingScans, DeriveTheVoxelUnlessItIsGiven)
{
  MovingScans scans;
  scans.add(walkerScene()[0].points, walkerScene()[0].T_world_scan);
  scans.setVoxel(0.3);
  scans.add(walkerScene()[1].points, walkerScene()[1].T_world_scan);
  scans.setVoxel({});
  scans.add(walkerScene()[0].points, walkerScene()[0].T_world_scan);
  EXPECT_GT(scans.voxel(0), 0.05);
  EXPECT_LT(scans.voxel(0), 0.3);
  EXPECT_EQ(scans.voxel(1), 0.3);
  EXPECT_EQ(scans.voxel(2), scans.voxel(0));
}

TEST(MovingScans, TheScannerMayStandAnywhereInItsFrame)
{
  const Eigen::Vector3f origin(2, -1, 0.5);
  MovingScans shifted;
  std::vector<Points> points;
  for (const TrueScan& scan : walkerScene()) {
    points.push_back(scan.points);
    for (Eigen::Vector3f& p : points.back())
      p += origin;
    Eigen::Isometry3d T = scan.T_world_scan;
    T.translate(-origin.cast<double>());
    shifted.add(points.back(), T, {}, origin);
  }
  MovingScans plain = added();
  const auto expected = plain.motion(2, walkerScene()[2].points);
  const auto found = shifted.motion(2, points[2]);
  std::size_t other = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    other += found[i] != expected[i] ? 1 : 0;
  // The sums are rounded to 1e-7 m.
  EXPECT_LT(other, found.size() / 1000);
}

TEST(MovingScans, NoReturnsAreNoRays)
{
  // Of a black piece of the wall no echo comes back, which is written as 60 m but in one scan:
  // as rays, these would have passed where it stands.
  std::vector<TrueScan> scans = walkerScene();
  MovingScans observers;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    for (Eigen::Vector3f& p : scans[i].points) {
      const Eigen::Vector3d place = scans[i].T_world_scan * p.cast<double>();
      if (i != 2 && place.x() > 4.9 && std::abs(place.y()) < 2)
        p *= 60 / p.norm();
    }
    observers.add(scans[i].points, scans[i].T_world_scan);
  }
  EXPECT_FALSE(observers.isBlind());
  const auto motion = observers.motion(1, scans[1].points);
  for (std::size_t p = 0; p < motion.size(); ++p) {
    if (scans[1].points[p].norm() > 50) {
      ASSERT_EQ(motion[p], PointMotion::kUnknown) << "beyond the range gate";
    }
  }
  const Told room =
      toldOf({scans[2]}, {observers.motion(2, scans[2].points)}, Met::kRoom);
  EXPECT_LT(room.dynamic, 3u);
}

TEST(MovingScans, JudgeAPartOfAScan)
{
  MovingScans observers = added();
  Points thinned;
  std::vector<Met> met;
  for (std::size_t p = 0; p < walkerScene()[2].points.size(); p += 3) {
    thinned.push_back(walkerScene()[2].points[p]);
    met.push_back(walkerScene()[2].met[p]);
  }
  const auto motion = observers.motion(2, thinned);
  std::size_t mover = 0, told = 0;
  for (std::size_t i = 0; i < met.size(); ++i) {
    mover += met[i] == Met::kMover ? 1 : 0;
    told += met[i] == Met::kMover && motion[i] == PointMotion::kDynamic ? 1 : 0;
  }
  ASSERT_GT(mover, 30u);
  EXPECT_GT(told, 9 * mover / 10);
}

TEST(MovingScans, ScansOfNothingJudgeNobody)
{
  MovingScans scans = added();
  const Eigen::Isometry3d here = walkerScene()[0].T_world_scan;
  scans.add({}, here);
  scans.add({{kNan, 0, 0}, {kInfinity, 1, 1}}, here);
  scans.add({{1, 2, 0}}, here);
  EXPECT_TRUE(scans.motion(5, {}).empty());
  EXPECT_EQ(scans.motion(6, {{kNan, 0, 0}}),
            std::vector<PointMotion>{PointMotion::kUnknown});
  MovingScans plain = added();
  EXPECT_EQ(scans.motion(2, walkerScene()[2].points),
            plain.motion(2, walkerScene()[2].points));
}

TEST(MovingScans, VoxelsTooSmallForTheRoomLeaveNoRays)
{
  MovingScans scans;
  scans.setVoxel(1e-9);
  for (const TrueScan& scan : walkerScene())
    scans.add(scan.points, scan.T_world_scan);
  const Points& points = walkerScene()[2].points;
  EXPECT_EQ(scans.motion(2, points),
            std::vector<PointMotion>(points.size(), PointMotion::kUnknown));
}

TEST(MovingScans, RefuseWhatBreaksARuleAndStayAsTheyWere)
{
  MovingScans scans = added();
  const Points& points = walkerScene()[0].points;
  Eigen::Isometry3d bent = Eigen::Isometry3d::Identity();
  bent.linear() *= 1.1;
  EXPECT_NE(
      badArgumentOf([&] { scans.add(points, bent); }).find("scan 5: T_world_scan"),
      std::string::npos);
  const Eigen::Isometry3d here = Eigen::Isometry3d::Identity();
  EXPECT_NE(badArgumentOf([&] {
              scans.add(points, here, {-1, 0});
            }).find("scan 5: sigma of translation = -1"),
            std::string::npos);
  EXPECT_NE(badArgumentOf([&] {
              scans.add(points, here, {}, {kNan, 0, 0});
            }).find("origin of the rays = "),
            std::string::npos);
  for (const double bad : {0.0, -0.1, double{kNan}, double{kInfinity}})
    EXPECT_NE(badArgumentOf([&] { scans.setVoxel(bad); }).find("voxel = "),
              std::string::npos);
  for (const auto& ask : std::vector<std::function<void()>>{
           [&] { (void)scans.motion(5, points); }, [&] { (void)scans.voxel(5); }})
    EXPECT_EQ(badArgumentOf(ask), "scan = 5, but must be one of 5");
  EXPECT_EQ(scans.size(), 5u);
}

} // namespace
} // namespace pcl6d
