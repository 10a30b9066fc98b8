// SPDX-License-Identifier: BSD-3-Clause
// A spinning lidar of 16 rings and what is left of it, by default options: scans are registered
// where they show enough, and no wrong map is called reliable.
#include "registered_run.h"
#include "support/constants.h"
#include "support/room.h"

#include <algorithm>
#include <functional>

namespace {
using pcl6d::Points;
using pcl6d::poseFromEuler;
using pcl6d::Random;
using pcl6d::ScanState;
using pcl6d::Slam6DResult;
using pcl6d::test::DriftingRun;
using pcl6d::test::kDegree;
using pcl6d::test::PillarRoom;
using pcl6d::test::registered;

constexpr std::size_t kScans = 5;
constexpr double kOff = 0.145;   // [m] the odometry's largest error
constexpr double kRight = 0.045; // [m] a map that is right takes away two thirds of it

/** \return a turn of rings 2 deg apart; 1 cm of noise, as its data sheet has it (one sigma
 * of 3 cm at three) */
Points
ringsOf(const PillarRoom& room, const Eigen::Isometry3d& pose, Random& random)
{
  Points points;
  const double phase = random.uniform(0, 0.8 * kDegree);
  for (int ring = 0; ring < 16; ++ring)
    for (double a = phase; a < 2 * M_PI; a += 0.8 * kDegree) {
      const double e = (2 * ring - 15) * kDegree;
      const Eigen::Vector3d ray(
          std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
      const double r = room.range(pose.translation(), pose.linear() * ray);
      points.push_back(((r + 0.01 * random.normal()) * ray).cast<float>());
    }
  return points;
}

/** \return a drive through the room, with odometry that is off by up to 14 cm and 2 deg */
DriftingRun
ringRun()
{
  DriftingRun run;
  Random random(4);
  const PillarRoom room;
  for (std::size_t i = 0; i < kScans; ++i) {
    const auto x = static_cast<double>(i);
    run.truth.push_back(poseFromEuler({0.5 * x - 1, 0.1 * x, 0}, {0, 0, 0.1 * x}));
    run.odometry.push_back(run.truth.back() *
                           poseFromEuler({0.03 * x, -0.02 * x, 0}, {0, 0, 0.008 * x}));
    run.scans.push_back(ringsOf(room, run.truth.back(), random));
  }
  return run;
}

/** \return the same after a change of each scan */
DriftingRun
changed(const std::function<Points(const Points&)>& change)
{
  DriftingRun run = ringRun();
  for (Points& scan : run.scans)
    scan = change(scan);
  return run;
}

/** \return the points for which keep(place) holds */
Points
chosen(const Points& points, const std::function<bool(std::size_t)>& keep)
{
  Points kept;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (keep(i))
      kept.push_back(points[i]);
  return kept;
}

double
largestError(const Slam6DResult& result, const DriftingRun& run)
{
  double largest = 0;
  for (std::size_t i = 0; i < run.truth.size(); ++i) {
    const Eigen::Isometry3d moved =
        result.scans[0].T_world_scan.inverse() * result.scans[i].T_world_scan;
    const Eigen::Isometry3d truth = run.truth[0].inverse() * run.truth[i];
    largest = std::max(largest, (moved.translation() - truth.translation()).norm());
  }
  return largest;
}

void
expectRight(const DriftingRun& run)
{
  const Slam6DResult result = registered(run);
  EXPECT_EQ(result.count(ScanState::kPredicted), 0u);
  EXPECT_LT(largestError(result, run), kRight);
  EXPECT_TRUE(result.trusted());
}

/** Registered or not: all poses are numbers, what is not registered has a reason, and a map
 * that is off is doubted. */
void
expectHonest(const DriftingRun& run)
{
  const Slam6DResult result = registered(run);
  ASSERT_EQ(result.scans.size(), kScans);
  for (const auto& scan : result.scans) {
    EXPECT_TRUE(scan.T_world_scan.matrix().allFinite());
    if (scan.state == ScanState::kPredicted)
      EXPECT_FALSE(scan.rejections.empty());
  }
  if (largestError(result, run) > kOff)
    EXPECT_FALSE(result.trusted());
}
} // namespace

TEST(Sensors, RingsAreRegistered)
{
  expectRight(ringRun());
}

TEST(Sensors, MapsOfRingsFollowTheirRefinedLinks)
{
  const DriftingRun run = ringRun();
  const Slam6DResult result = registered(run);
  ASSERT_GE(result.stages.size(), 2u);
  EXPECT_EQ(result.stages.back().kind, pcl6d::StageKind::kLinks);
  Slam6DResult before = result; // the last stage that was not reverted
  for (std::size_t k = 0; k + 1 < result.stages.size(); ++k)
    for (std::size_t i = 0; i < kScans && !result.stages[k].history.empty(); ++i)
      before.scans[i].T_world_scan = result.stages[k].history.back()[i];
  EXPECT_LT(largestError(result, run), largestError(before, run));
  for (std::size_t i = 1; i < kScans; ++i)
    EXPECT_TRUE(result.verification->scans[i].bound);
}

TEST(Sensors, MapsStayAsMatchedWithoutRelaxationOrVerdict)
{
  pcl6d::Slam6DOptions options;
  options.relaxation.reset();
  for (const bool is_verified : {true, false}) {
    options.verify = is_verified;
    for (const pcl6d::StageResult& stage : registered(ringRun(), options).stages)
      EXPECT_NE(stage.kind, pcl6d::StageKind::kLinks);
    options.relaxation = pcl6d::Slam6DOptions().relaxation;
  }
}

TEST(Sensors, RingsInAnyOrderAreRegistered)
{
  Random random(7);
  expectRight(changed([&](const Points& scan) {
    Points mixed = scan;
    for (std::size_t i = mixed.size() - 1; i > 0; --i)
      std::swap(mixed[i],
                mixed[static_cast<std::size_t>(
                    random.uniform(0, static_cast<double>(i) + 0.999))]);
    return mixed;
  }));
}

TEST(Sensors, RingsOfWhichEachPointComesTwiceAreRegistered)
{
  expectRight(changed([](const Points& scan) {
    Points twice = scan;
    twice.insert(twice.end(), scan.begin(), scan.end());
    return twice;
  }));
}

TEST(Sensors, RingsWithGapsAreRegistered)
{
  expectRight(changed([](const Points& scan) {
    return chosen(scan, [](std::size_t i) {
      return i / 450 % 4 != 1 && i % 450 > 60; // every fourth ring; a sector
    });
  }));
}

TEST(Sensors, RingsBesideADenseScannerAreRegistered)
{
  DriftingRun run = ringRun();
  Random random(9);
  for (const std::size_t i : {1, 3})
    run.scans[i] = PillarRoom().scan(run.truth[i], random, 0.02);
  expectRight(run);
}

TEST(Sensors, OneRingIsHonest)
{
  expectHonest(changed([](const Points& scan) {
    return chosen(scan, [](std::size_t i) { return i / 450 == 8; });
  }));
}

TEST(Sensors, FiftyPointsAreHonest)
{
  expectHonest(changed([](const Points& scan) {
    const std::size_t step = scan.size() / 50;
    return chosen(scan, [=](std::size_t i) { return i % step == 0; });
  }));
}

TEST(Sensors, PointsOnALineAreHonest)
{
  expectHonest(changed([](const Points& scan) {
    Points line;
    for (const auto& p : scan)
      line.emplace_back(p.x(), 2.0f, 0.5f);
    return line;
  }));
}

TEST(Sensors, PointsOnAPlaneAreHonest)
{
  expectHonest(changed([](const Points& scan) {
    Points plane;
    for (const auto& p : scan)
      plane.emplace_back(p.x(), p.y(), -1.0f);
    return plane;
  }));
}

TEST(Sensors, EqualPointsAreRefusedByTheNameOfTheScan)
{
  const DriftingRun run = changed(
      [](const Points& scan) { return Points(scan.size(), scan[scan.size() / 2]); });
  try {
    registered(run);
    FAIL() << "nothing was thrown";
  } catch (const pcl6d::ComputeFailed& e) {
    EXPECT_EQ(std::string(e.what()).find("scan 0: "), 0u) << e.what();
  }
}
