// SPDX-License-Identifier: BSD-3-Clause
// The motion within all scans at once.
#include "support/moving_room.h"

#include <pcl6d/common/error.h>
#include <pcl6d/deskew/motion_relaxation.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace {
using pcl6d::MotionRelaxationOptions;
using pcl6d::MotionScan;
using pcl6d::Status;
using pcl6d::test::MovingScanner;

constexpr double kTurn = 0.1;       // [s] of a scan
constexpr double kTolerance = 5e-3; // [m] of a point 3 m away: the noise

struct MotionRelaxation : testing::Test {
  pcl6d::Random random{11};
  MovingScanner scanner;
  MotionRelaxationOptions options = [] {
    MotionRelaxationOptions ours;
    ours.noise = 0.005;
    return ours;
  }();

  // Scans one after the other whose knots are right but for some centimetres; the first
  // begins where it did.
  std::vector<MotionScan>
  scans(int count)
  {
    std::vector<MotionScan> scans;
    for (int i = 0; i < count; ++i) {
      MotionScan scan;
      scan.sample = scanner.sweep(i * kTurn, random);
      scan.knots = scanner.knots({i * kTurn, (i + 1) * kTurn});
      for (std::size_t k = i == 0 ? 1 : 0; k < 2; ++k) {
        for (int axis = 0; axis < 3; ++axis)
          scan.knots.poses[k].translation()[axis] += random.uniform(-0.02, 0.02);
        scan.knots.poses[k].linear() =
            pcl6d::rotationFromVector(Eigen::Vector3d(random.uniform(-0.005, 0.005),
                                                      random.uniform(-0.005, 0.005),
                                                      random.uniform(-0.005, 0.005))) *
            scan.knots.poses[k].linear();
      }
      scans.push_back(std::move(scan));
    }
    return scans;
  }

  double
  worst(const std::vector<pcl6d::Trajectory>& knots) const
  {
    double worst = 0;
    for (const auto& scan : knots)
      for (std::size_t k = 0; k < scan.poses.size(); ++k)
        worst = std::max(worst, scanner.errorOf(scan.poses[k], scan.stamps[k]));
    return worst;
  }
};
} // namespace

TEST_F(MotionRelaxation, FindsTheMotionThatTheScansWereMadeWith)
{
  const auto moving = scans(8);
  std::vector<pcl6d::Trajectory> before;
  for (const auto& scan : moving)
    before.push_back(scan.knots);
  const auto result = pcl6d::relaxMotions(moving, options);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_GT(result.links, 100u);
  EXPECT_GT(worst(before), 5 * kTolerance);
  EXPECT_LT(worst(result.knots), kTolerance);
}

TEST_F(MotionRelaxation, RigidScansStayRigid)
{
  auto moving = scans(4);
  for (auto& scan : moving) {
    scan.is_rigid = true;
    scan.knots.poses[1] = scan.knots.poses[0];
  }
  for (const auto& knots : pcl6d::relaxMotions(moving, options).knots) {
    const auto bent = pcl6d::distanceBetween(knots.poses[0], knots.poses[1]);
    EXPECT_LT(bent.translation, 0.02 * options.noise);
    EXPECT_LT(bent.rotation, 0.02 * options.noise);
  }
}

TEST_F(MotionRelaxation, HasTheSameBitsForAnyNumberOfThreads)
{
  const auto moving = scans(4);
  options.num_threads = 1;
  const auto one = pcl6d::relaxMotions(moving, options);
  for (const unsigned threads : {2u, 8u}) {
    options.num_threads = threads;
    const auto more = pcl6d::relaxMotions(moving, options);
    for (std::size_t i = 0; i < moving.size(); ++i)
      for (std::size_t k = 0; k < 2; ++k)
        EXPECT_TRUE(one.knots[i].poses[k].matrix() == more.knots[i].poses[k].matrix());
  }
}

TEST_F(MotionRelaxation, ScansThatMeetNowhereStayWhereTheyAre)
{
  auto moving = scans(2);
  for (auto& pose : moving[1].knots.poses)
    pose.translation().x() += 1000;
  const auto result = pcl6d::relaxMotions(moving, options);
  EXPECT_NE(result.status, Status::kDiverged);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT((result.knots[i].poses[0].translation() -
               moving[i].knots.poses[0].translation())
                  .norm(),
              0.1);
  EXPECT_EQ(pcl6d::relaxMotions({}, options).status, Status::kTooFewPairs);
}

TEST_F(MotionRelaxation, RefusesWhatBreaksARule)
{
  const auto moving = scans(2);
  const auto refused = [](const std::vector<MotionScan>& scans,
                          const MotionRelaxationOptions& with) {
    EXPECT_THROW(pcl6d::relaxMotions(scans, with), pcl6d::BadArgument);
  };
  auto broken = moving;
  broken[1].sample.times.pop_back();
  refused(broken, options);
  broken = moving;
  broken[0].knots.poses.pop_back();
  refused(broken, options);
  for (auto change : std::vector<void (*)(MotionRelaxationOptions&)>{
           [](MotionRelaxationOptions& o) { o.noise = 0; },
           [](MotionRelaxationOptions& o) { o.motion.linear = 0; },
           [](MotionRelaxationOptions& o) { o.map.cell = -1; },
           [](MotionRelaxationOptions& o) { o.hold_translation = 0; },
           [](MotionRelaxationOptions& o) { o.hold_rotation = 0; },
           [](MotionRelaxationOptions& o) { o.max_rounds = 0; }}) {
    MotionRelaxationOptions with = options;
    change(with);
    refused(moving, with);
  }
}
