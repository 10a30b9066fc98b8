// SPDX-License-Identifier: BSD-3-Clause
#include "registered_run.h"
#include "support/bits.h"
#include "support/drift.h"
#include "support/points.h"

#include <pcl6d/common/error.h>
#include <pcl6d/slam6d/auto_parameters.h>
#include <pcl6d/slam6d/scan_preparation.h>
#include <pcl6d/slam6d/slam6d.h>

#include <cmath>
#include <sstream>
#include <tuple>

using pcl6d::Parameter;
using pcl6d::Random;
using pcl6d::Slam6D;
using pcl6d::Slam6DOptions;
using pcl6d::Slam6DParameters;
using pcl6d::Slam6DResult;
using pcl6d::test::DriftingRun;
using pcl6d::test::makeDriftingRun;
using pcl6d::test::registered;
using pcl6d::test::sameBits;

namespace {
constexpr double kNoReturn = 32.767; // [m]

/** A run whose scanner writes a code where no echo came back. */
DriftingRun
runWithNoReturns(std::size_t count)
{
  DriftingRun run = makeDriftingRun(count);
  Random random(3);
  for (auto& scan : run.scans)
    for (std::size_t i = 0; i < scan.size(); i += 10)
      scan[i] = (kNoReturn * scan[i].normalized().cast<double>()).cast<float>();
  return run;
}

/** The value as a user reads it in a summary and types it again. */
double
printed(const Parameter& parameter)
{
  std::ostringstream text;
  text << parameter.value;
  return std::stod(text.str());
}

std::vector<double>
valuesOf(const Slam6DParameters& p)
{
  return {p.min_range.value,
          p.max_range.value,
          p.voxel.value,
          p.max_distance.value,
          p.max_distance_start.value};
}
} // namespace

TEST(Slam6DParameters, AreDerivedFromTheScans)
{
  const auto p = registered(runWithNoReturns(2)).parameters;
  for (const auto& parameter :
       {p.min_range, p.max_range, p.voxel, p.max_distance, p.max_distance_start}) {
    EXPECT_FALSE(parameter.given);
    EXPECT_FALSE(parameter.why.empty());
    EXPECT_GT(parameter.value, 0);
  }
  EXPECT_LT(p.max_range.value, kNoReturn) << "codes are no surfaces";
  EXPECT_GT(p.max_range.value, 14) << "the room is";
  EXPECT_LE(p.min_range.value, 0.2);
  // Never anneal below the point spacing of the reduced model (4.1.5).
  EXPECT_GE(p.max_distance.value, p.voxel.value);
  EXPECT_GE(p.max_distance_start.value, p.max_distance.value);
}

TEST(Slam6DParameters, LetTheRangeEndWithTheGridWithoutACode)
{
  const auto p = registered(makeDriftingRun(1)).parameters;
  constexpr double kVoxels = 1 << 18;
  EXPECT_LE(p.max_range.value, kVoxels * p.voxel.value) << "rounded down";
  EXPECT_GT(p.max_range.value, 0.9 * kVoxels * p.voxel.value) << "to two digits";
  EXPECT_EQ(p.max_range.value, printed(p.max_range));
  EXPECT_EQ(p.max_range.why, "as far as the grid of the reduction reaches");
  EXPECT_FALSE(p.max_range.given);
}

TEST(Slam6DParameters, LetTheRangeEndWithTheGridIfTheCodeLiesBeyond)
{
  Slam6DOptions options;
  options.voxel = 1e-4;
  const auto p = registered(runWithNoReturns(1), options).parameters;
  EXPECT_EQ(p.max_range.value, 26) << "2^18 voxels are 26.2 m";
  EXPECT_EQ(p.max_range.why, "as far as the grid of the reduction reaches");
}

TEST(Slam6DParameters, KeepOneWildReturnFromEndingTheRun)
{
  DriftingRun run = makeDriftingRun(3);
  run.scans[1][100] = {2e5f, 0, 0};   // 200 km
  run.scans[2][100] = {0, -1e30f, 0}; // its square overflows float
  Slam6DOptions options;
  options.voxel = 0.15; // the grid of the reduction ends at 157 km
  EXPECT_TRUE(registered(run, options).trusted());
}

TEST(Slam6D, MatchesWithinTheGridHoweverFarAScanReaches)
{
  // Given an infinite range, a scan may reach 2^20 voxels, but the metascan is thinned
  // on a grid that is half as wide.
  DriftingRun run = makeDriftingRun(3);
  Slam6DOptions options;
  options.max_range = pcl6d::test::kInfinity;
  options.voxel = 0.25;
  const Slam6DResult tame = registered(run, options);
  for (auto& scan : run.scans)
    scan.push_back({2e5f, 0, 0}); // 800000 voxels
  const Slam6DResult wild = registered(run, options);
  EXPECT_TRUE(wild.trusted());
  for (std::size_t i = 0; i < run.scans.size(); ++i)
    EXPECT_TRUE(sameBits(wild.scans[i].T_world_scan, tame.scans[i].T_world_scan));
}

TEST(Slam6DParameters, GiveTheSameRunWhenGivenAsPrinted)
{
  const DriftingRun run = runWithNoReturns(3);
  const Slam6DResult derived = registered(run);
  const Slam6DParameters& p = derived.parameters;
  Slam6DOptions options;
  options.min_range = printed(p.min_range);
  options.max_range = printed(p.max_range);
  options.voxel = printed(p.voxel);
  options.max_distance = printed(p.max_distance);
  options.max_distance_start = printed(p.max_distance_start);
  const Slam6DResult given = registered(run, options);
  EXPECT_EQ(valuesOf(given.parameters), valuesOf(p));
  for (std::size_t i = 0; i < run.scans.size(); ++i)
    EXPECT_TRUE(sameBits(given.scans[i].T_world_scan, derived.scans[i].T_world_scan));
}

TEST(Slam6DParameters, GivenOnesWin)
{
  Slam6DOptions options;
  options.min_range = 0.5;
  options.max_range = 12;
  options.voxel = 0.3;
  options.max_distance = 0.7;
  options.max_distance_start = 1.5;
  const auto p = registered(runWithNoReturns(2), options).parameters;
  EXPECT_EQ(valuesOf(p), (std::vector<double>{0.5, 12, 0.3, 0.7, 1.5}));
  for (const auto& parameter :
       {p.min_range, p.max_range, p.voxel, p.max_distance, p.max_distance_start})
    EXPECT_TRUE(parameter.given);
}

TEST(Slam6DParameters, FollowAGivenVoxelAndTheMetric)
{
  Slam6DOptions options;
  options.voxel = 0.4;
  for (const auto& [metric, max_distance, why] :
       {std::tuple(pcl6d::Metric::kPoint, 0.8, "2 x voxel"),
        std::tuple(pcl6d::Metric::kPlane, 0.68, "1.7 x voxel, with normals"),
        std::tuple(pcl6d::Metric::kGicp, 0.68, "1.7 x voxel, with normals")}) {
    SCOPED_TRACE(toString(metric));
    options.metric = metric;
    const auto p = registered(makeDriftingRun(2), options).parameters;
    EXPECT_TRUE(p.voxel.given);
    EXPECT_FALSE(p.max_distance.given);
    EXPECT_EQ(p.max_distance.value, max_distance);
    EXPECT_EQ(p.max_distance.why, why);
    EXPECT_EQ(p.max_distance_start.value, 4.8);
    EXPECT_EQ(p.max_distance_start.why, "12 x voxel");
  }
}

TEST(Slam6DParameters, DropWhatIsOutsideTheGate)
{
  Slam6DOptions options;
  options.voxel = 0.001; // keeps every point
  options.max_distance_start = options.max_distance = 0.5;
  options.min_range = 2;
  options.max_range = 4;
  const DriftingRun run = makeDriftingRun(1);
  std::size_t expected = 0;
  for (const auto& p : run.scans[0])
    expected += p.norm() >= 2 && p.norm() <= 4;
  const auto result = registered(run, options);
  EXPECT_EQ(result.scans[0].reduced, expected);
  EXPECT_EQ(result.scans[0].points, run.scans[0].size());
}

TEST(Slam6DParameters, ComeFromTheFirstSixteenScans)
{
  DriftingRun first = makeDriftingRun(16), more = makeDriftingRun(18);
  // The scans that come later are of another kind: twice as large.
  for (const std::size_t i : {16u, 17u})
    for (auto& p : more.scans[i])
      p *= 2;
  const auto parameters = [](const DriftingRun& run) {
    Slam6D slam;
    slam.setObserver([&](std::size_t, const pcl6d::ScanResult&) { slam.cancel(); });
    for (std::size_t i = 0; i < run.scans.size(); ++i)
      slam.addScan(run.scans[i], run.odometry[i]);
    slam.optimize(); // stops after the first scan: only the parameters are wanted
    return valuesOf(slam.result().parameters);
  };
  EXPECT_EQ(parameters(more), parameters(first));
  // All sixteen count: without nine of them the others would be the majority.
  for (std::size_t i = 7; i < 16; ++i)
    for (auto& p : first.scans[i])
      p *= 2;
  EXPECT_NE(parameters(more), parameters(first));
}

TEST(Slam6DParameters, ScaleWithTheWorld)
{
  // An object of 1 m on a turntable is mapped as well as a room of 10 m.
  const DriftingRun room = makeDriftingRun(3);
  DriftingRun toy = room;
  for (auto& scan : toy.scans)
    for (auto& p : scan)
      p *= 0.1f;
  for (auto* poses : {&toy.truth, &toy.odometry})
    for (auto& pose : *poses)
      pose.translation() *= 0.1;
  const auto a = registered(room), b = registered(toy);
  EXPECT_NEAR(b.parameters.voxel.value, 0.1 * a.parameters.voxel.value, 1e-3);
  EXPECT_TRUE(b.trusted());
}

TEST(Slam6DParameters, PlanarScansAreGatedBeforeTheyAreRaised)
{
  // A 2D scanner in a round room of 3 m; each tenth ray has no echo, some hit the robot.
  constexpr float kCode = 8.18f; // [m]
  pcl6d::Points scan;
  for (int i = 0; i < 360; ++i) {
    const float range = i % 10 == 3 ? kCode : i % 60 == 7 ? 0.f : 3.f;
    const double angle = i * M_PI / 180;
    scan.emplace_back(range * std::cos(angle), range * std::sin(angle), 0.f);
  }
  const Slam6DParameters p =
      pcl6d::deriveParameters(Slam6DOptions(), {scan, scan, scan});
  EXPECT_GT(p.planar_rows.value, 0);
  EXPECT_FALSE(p.planar_rows.given);
  EXPECT_NEAR(p.max_range.value, kCode, 0.1);
  const pcl6d::Points raised = pcl6d::gateScan(scan, "scan", p);
  EXPECT_GT(raised.size(), 13 * 300U);
  for (const auto& point : raised) {
    EXPECT_LT(point.head<2>().norm(), 3.1f); // no ledge of a ray without echo
    EXPECT_GT(point.head<2>().norm(), 1.f);  // no post where the scanner stands
  }
  Slam6DOptions never;
  never.planar_rows = 0;
  EXPECT_EQ(
      pcl6d::gateScan(scan, "scan", pcl6d::deriveParameters(never, {scan, scan, scan}))
          .size(),
      318U); // as measured: 36 codes and 6 at the robot are out
  never.planar_rows = -1;
  EXPECT_THROW(never.validate(), pcl6d::BadArgument);
}
