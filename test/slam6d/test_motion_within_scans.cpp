// SPDX-License-Identifier: BSD-3-Clause
// Slam6D with scans that were taken on the move.
#include "support/moving_room.h"

#include <pcl6d/common/error.h>
#include <pcl6d/slam6d/slam6d.h>

#include <gtest/gtest.h>

#include <functional>

namespace {
using pcl6d::ScanTimes;
using pcl6d::Slam6D;
using pcl6d::Slam6DOptions;
using pcl6d::TimedPoints;
using pcl6d::test::MovingScanner;

constexpr double kTurn = 0.1;       // [s] of a scan
constexpr double kTolerance = 0.02; // [m] as is asked of 95 % of all points

struct MotionWithinScans : testing::Test {
  pcl6d::Random random{21};
  MovingScanner scanner;
  Slam6DOptions options = [] {
    Slam6DOptions ours;
    ours.verify = false; // that takes most of the time
    return ours;
  }();
  std::vector<TimedPoints> sweeps;
  double period = kTurn; // [s] from scan to scan

  void
  drive(int count)
  {
    for (int i = 0; i < count; ++i) {
      sweeps.push_back(scanner.sweep(i * period, random));
      for (double& time : sweeps.back().times)
        time -= i * period; // since the stamp
    }
  }

  // Scans of 1.2 s, with 0.3 s between them.
  void
  driveSlowly(int count)
  {
    scanner.turn = 1.2;
    period = 1.5;
    scanner.velocity = Eigen::Vector3d(0.3, 0.05, 0);
    scanner.turning.setZero();
    options.motion.knots = 0.3;
    options.voxel = 0.1; // of so few points a coarser one would follow
    drive(count);
  }

  // Adds all scans, without odometry.
  void
  addTo(Slam6D& slam, bool has_stamps = true) const
  {
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
      ScanTimes times{sweeps[i].times, {}};
      if (has_stamps)
        times.stamp = static_cast<double>(i) * period;
      slam.addScan(sweeps[i].points, times, scanner.poseAt(0));
    }
  }

  // The share of points within the tolerance of where they are.
  double
  shareInPlace(const pcl6d::Slam6DResult& result) const
  {
    std::size_t all = 0, near = 0;
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
      const auto& scan = result.scans[i];
      const pcl6d::Points undone =
          scan.motion && scan.motion->deskewed
              ? pcl6d::undoMotion(sweeps[i], scan.motion->path, 0)
              : sweeps[i].points;
      for (std::size_t k = 0; k < undone.size(); k += 20, ++all) {
        const Eigen::Vector3d truth =
            scanner.poseAt(static_cast<double>(i) * period + sweeps[i].times[k]) *
            sweeps[i].points[k].cast<double>();
        near +=
            (scan.T_world_scan * undone[k].cast<double>() - truth).norm() < kTolerance;
      }
    }
    return static_cast<double>(near) / static_cast<double>(all);
  }

  void
  expectLeft(const pcl6d::Slam6DResult& result, pcl6d::RejectReason reason) const
  {
    for (const auto& scan : result.scans) {
      ASSERT_TRUE(scan.motion);
      EXPECT_FALSE(scan.motion->deskewed);
      EXPECT_EQ(scan.motion->rejection.reason, reason)
          << scan.motion->rejection << ", rotation " << scan.motion->rotation;
    }
  }
};
} // namespace

TEST_F(MotionWithinScans, IsFoundAndUndoneWithoutOdometry)
{
  drive(12);
  for (const bool has_stamps : {true, false}) {
    Slam6D slam(options);
    addTo(slam, has_stamps);
    ASSERT_TRUE(slam.optimize());
    ASSERT_EQ(slam.result().scans.size(), 12u);
    EXPECT_GT(shareInPlace(slam.result()), 0.95);
    for (const auto& scan : slam.result().scans) {
      ASSERT_TRUE(scan.motion);
      EXPECT_TRUE(scan.motion->deskewed) << scan.motion->rejection;
      EXPECT_NEAR(scan.motion->translation, kTurn * scanner.velocity.norm(), 0.01);
      EXPECT_NEAR(scan.motion->rotation, kTurn * scanner.turning.norm(), 0.004);
      EXPECT_NEAR(scan.motion->seconds, kTurn, 0.01);
      EXPECT_EQ(scan.motion->knots, 2u);
    }
  }
}

TEST_F(MotionWithinScans, HasTheSameBitsForAnyNumberOfThreads)
{
  drive(6);
  const auto poses = [&](unsigned threads) {
    options.num_threads = threads;
    Slam6D slam(options);
    addTo(slam);
    slam.optimize();
    return slam.result().scans;
  };
  const auto one = poses(1);
  for (const unsigned threads : {2u, 8u}) {
    const auto more = poses(threads);
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_TRUE(one[i].T_world_scan.matrix() == more[i].T_world_scan.matrix());
      EXPECT_TRUE(one[i].motion->path.poses.back().matrix() ==
                  more[i].motion->path.poses.back().matrix());
    }
  }
}

TEST_F(MotionWithinScans, ScannersThatStandStillGiveWhatTheyGiveWithoutTimes)
{
  scanner.velocity.setZero();
  scanner.turning.setZero();
  drive(5);
  Slam6D timed(options), plain(options);
  addTo(timed);
  for (const auto& sweep : sweeps)
    plain.addScan(sweep.points, scanner.poseAt(0));
  timed.optimize();
  plain.optimize();
  expectLeft(timed.result(), pcl6d::RejectReason::kNoMotionSeen);
  for (std::size_t i = 0; i < sweeps.size(); ++i)
    EXPECT_TRUE(timed.result().scans[i].T_world_scan.matrix() ==
                plain.result().scans[i].T_world_scan.matrix());
  EXPECT_EQ(timed.result().stages.size(), plain.result().stages.size());
}

TEST_F(MotionWithinScans, StopAndGoIsSeenToBeSo)
{
  // Scans from four places half a metre apart, each taken at rest, ten seconds apart.
  Slam6D timed(options), plain(options);
  for (int i = 0; i < 4; ++i) {
    MovingScanner still = scanner;
    still.begin = scanner.begin + i * Eigen::Vector3d(0.5, 0.1, 0);
    still.velocity.setZero();
    still.turning.setZero();
    const TimedPoints sweep = still.sweep(0, random);
    timed.addScan(sweep.points, {sweep.times, 10. * i}, still.poseAt(0));
    plain.addScan(sweep.points, still.poseAt(0));
  }
  timed.optimize();
  plain.optimize();
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_FALSE(timed.result().scans[i].motion->deskewed);
    EXPECT_TRUE(timed.result().scans[i].T_world_scan.matrix() ==
                plain.result().scans[i].T_world_scan.matrix());
  }
}

TEST_F(MotionWithinScans, OneScanStaysAsItIs)
{
  drive(1);
  Slam6D slam(options);
  addTo(slam);
  EXPECT_TRUE(slam.result().scans.empty()) << "the next one may tell how it moved";
  slam.optimize();
  ASSERT_EQ(slam.result().scans.size(), 1u);
  expectLeft(slam.result(), pcl6d::RejectReason::kNoNextScan);
}

TEST_F(MotionWithinScans, EqualTimesAreNoMotion)
{
  drive(3);
  for (auto& sweep : sweeps)
    sweep.times.assign(sweep.times.size(), 0.25);
  Slam6D slam(options);
  addTo(slam);
  slam.optimize();
  expectLeft(slam.result(), pcl6d::RejectReason::kOneTime);
}

TEST_F(MotionWithinScans, ScansThatDoNotMeetStayAsTheyAre)
{
  drive(2);
  for (auto& p : sweeps[1].points)
    p = Eigen::Vector3f(p.x() + 200, p.y(), p.z());
  Slam6D slam(options);
  addTo(slam);
  slam.optimize();
  expectLeft(slam.result(), pcl6d::RejectReason::kNoPreviousScanMet);
}

TEST_F(MotionWithinScans, AThirdOfATurnWithinAScanIsTooMuchForTwoPoses)
{
  scanner.velocity.setZero();
  scanner.turning = Eigen::Vector3d(0, 0, 2 * M_PI / 3 / kTurn);
  drive(4);
  Slam6D slam(options);
  for (std::size_t i = 0; i < sweeps.size();
       ++i) { // with odometry, or nothing is known
    const double stamp = static_cast<double>(i) * kTurn;
    slam.addScan(sweeps[i].points, {sweeps[i].times, stamp}, scanner.poseAt(stamp));
  }
  slam.optimize();
  expectLeft(slam.result(), pcl6d::RejectReason::kTurnTooLarge);
}

TEST_F(MotionWithinScans, ATurnThatBeginsWithinASlowScanIsFollowed)
{
  // At the end of the fourth of five scans: by 18 degrees within it. Of one pose per scan nobody
  // could tell.
  scanner.stop = 3 * 1.5 + 0.6;
  scanner.turning_after = 0.52;
  driveSlowly(5);
  Slam6D slam(options);
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    const double stamp = static_cast<double>(i) * period;
    slam.addScan(sweeps[i].points, {sweeps[i].times, stamp}, scanner.poseAt(stamp));
  }
  slam.optimize();
  EXPECT_GT(shareInPlace(slam.result()), 0.95);
  for (const auto& scan : slam.result().scans) {
    EXPECT_TRUE(scan.motion->deskewed) << scan.motion->rejection;
    EXPECT_EQ(scan.motion->knots, 5u);
  }
  EXPECT_NEAR(slam.result().scans[3].motion->rotation, 0.6 * 0.52, 0.02);
  EXPECT_NEAR(slam.result().scans[4].motion->rotation, 1.2 * 0.52, 0.02);
}

TEST_F(MotionWithinScans, ThoseOfSeveralKnotsWaitForWhatComesAfter)
{
  driveSlowly(7);
  Slam6D slam(options);
  addTo(slam);
  EXPECT_EQ(slam.result().scans.size(), 1u); // one for its odometry, five to be seen
  slam.optimize();
  EXPECT_EQ(slam.result().scans.size(), 7u);
}

TEST_F(MotionWithinScans, GoesOnBehindRegisteredScans)
{
  drive(6);
  options.motion.keep_still = true;
  Slam6D slam(options);
  MovingScanner still = scanner;
  still.velocity.setZero();
  still.turning.setZero();
  pcl6d::ScanResult earlier;
  earlier.initial_pose = earlier.T_world_scan = still.poseAt(0);
  earlier.state = pcl6d::ScanState::kFixed;
  slam.addRegistered(still.sweep(0, random).points, earlier);
  addTo(slam);
  slam.optimize();
  ASSERT_EQ(slam.result().scans.size(), 7u);
  EXPECT_FALSE(slam.result().scans[0].motion);
  for (std::size_t i = 2; i < 7; ++i) {
    EXPECT_TRUE(slam.result().scans[i].motion->deskewed) << i;
    EXPECT_LT(scanner.errorOf(slam.result().scans[i].T_world_scan,
                              static_cast<double>(i - 1) * kTurn),
              kTolerance);
  }
}

TEST_F(MotionWithinScans, ALongScanHasItsPosesFartherApart)
{
  drive(3);
  constexpr double kSlower = 10000; // scans of more than ten minutes
  period *= kSlower;
  for (auto& sweep : sweeps)
    for (double& time : sweep.times)
      time *= kSlower;
  Slam6D slam(options);
  addTo(slam);
  slam.optimize();
  for (const auto& scan : slam.result().scans) {
    ASSERT_TRUE(scan.motion);
    EXPECT_LE(scan.motion->knots, 41U);
  }
  options.motion.knots = 0.1;
  Slam6D finer(options);
  EXPECT_THROW(
      {
        addTo(finer);
        finer.optimize();
      },
      pcl6d::BadArgument);
}

TEST_F(MotionWithinScans, BadInputIsRefusedAndNamed)
{
  drive(1);
  Slam6D slam(options);
  const auto refused = [&](const pcl6d::Points& points,
                           const ScanTimes& times,
                           const Eigen::Isometry3d& pose,
                           const std::string& words) {
    try {
      slam.addScan(points, times, pose, "a.pcd");
      ADD_FAILURE() << "not refused: " << words;
    } catch (const pcl6d::BadArgument& e) {
      EXPECT_NE(std::string(e.what()).find("a.pcd: "), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    }
  };
  const auto& [points, times] = sweeps[0];
  const Eigen::Isometry3d pose = scanner.poseAt(0);
  auto fewer = times;
  fewer.pop_back();
  refused(points, {fewer, 0.0}, pose, "each point needs a time");
  auto broken = times;
  broken[3] = NAN;
  refused(points, {broken, 0.0}, pose, "1 points have an infinite time or NaN");
  refused({points[0]}, {{0.0}, 0.0}, pose, "1 points");
  Eigen::Isometry3d bent = pose;
  bent.linear() *= 2;
  refused(points, {times, 0.0}, bent, "not a rigid motion");
  Slam6DOptions wrong = options;
  for (const double knots : {0.0, -1.0, double(NAN)}) {
    wrong.motion.knots = knots;
    EXPECT_THROW(Slam6D{wrong}, pcl6d::BadArgument);
  }
}
