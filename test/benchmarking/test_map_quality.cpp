// SPDX-License-Identifier: BSD-3-Clause
#include "support/drift.h"
#include "support/points.h"

#include <pcl6d/benchmarking/map_quality.h>

#include <gtest/gtest.h>

#include <cmath>

using pcl6d::MapQuality;
using pcl6d::MapQualityOptions;
using pcl6d::measureMap;
using pcl6d::Points;
using pcl6d::test::badArgumentOf;
using pcl6d::test::DriftingRun;

namespace {
using Poses = std::vector<Eigen::Isometry3d>;

constexpr std::size_t kScans = 12;

const DriftingRun&
run()
{
  static const DriftingRun run = pcl6d::test::makeDriftingRun(kScans);
  return run;
}

MapQualityOptions
options(unsigned int threads = 0)
{
  MapQualityOptions options;
  options.voxel = 0.15;
  options.num_threads = threads;
  return options;
}

MapQuality
measured(const Poses& poses, unsigned int threads = 0)
{
  return measureMap(run().scans, poses, options(threads));
}

const MapQuality&
good()
{
  static const MapQuality quality = measured(run().truth);
  return quality;
}

/** The truth, smoothly bent: half a wave of some height [m] over the drive. */
Poses
bent(double height)
{
  Poses poses = run().truth;
  for (std::size_t i = 0; i < poses.size(); ++i)
    poses[i].translation() += height *
                              std::sin(M_PI * static_cast<double>(i) / (kScans - 1)) *
                              Eigen::Vector3d(0.6, 0.6, 0.5);
  return poses;
}

Poses
oneMoved(std::size_t scan)
{
  Poses poses = run().truth;
  poses[scan].translation() += Eigen::Vector3d(0.06, -0.05, 0.04);
  return poses;
}
} // namespace

TEST(MeasureMap, OfTheTruthShowsTheNoiseOfTheScanner)
{
  const MapQuality& quality = good();
  EXPECT_EQ(quality.pairs, 66u) << "all see the same room";
  EXPECT_EQ(quality.scans.size(), kScans);
  EXPECT_EQ(quality.scans[3].neighbours, 11u);
  EXPECT_GT(quality.agreement, 0.1) << "points a voxel apart seldom meet within 6 cm";
  // Walls with 5 mm noise along the ray; points at their edges add to it.
  EXPECT_GE(quality.thickness.planes.size(), 6u);
  EXPECT_LT(quality.thickness.median, 0.01);
  EXPECT_GT(quality.thickness.median, 0.002);
  EXPECT_LT(quality.others.plane.median, 0.006);
  EXPECT_LT(quality.revisit_blur, 1.5) << "edges, seen from other sides, count too";
  EXPECT_GT(quality.spread_points, 5000u);
  EXPECT_EQ(quality.reference.point.count, 0u);
}

TEST(MeasureMap, RanksMapsByHowBentTheyAre)
{
  MapQuality before = good();
  for (const double height : {0.02, 0.07, 0.2}) {
    SCOPED_TRACE("bent by [m] " + std::to_string(height));
    const MapQuality now = measured(bent(height));
    EXPECT_LT(now.agreement, before.agreement);
    EXPECT_GT(now.entropy, before.entropy);
    EXPECT_GT(now.plane_variance, before.plane_variance);
    EXPECT_GT(now.thickness.rms, before.thickness.rms);
    EXPECT_GT(now.thickness.median, before.thickness.median);
    EXPECT_GT(now.others.plane.rms, before.others.plane.rms);
    EXPECT_GT(now.revisits.plane.rms, before.revisits.plane.rms);
    before = now;
  }
  EXPECT_GT(before.revisit_blur, 1.3 * good().revisit_blur);
  EXPECT_GT(measured(run().odometry).entropy, good().entropy);
}

TEST(MeasureMap, NamesTheScanThatIsOff)
{
  std::vector<std::string> names;
  for (std::size_t i = 0; i < kScans; ++i)
    names.push_back("scan" + std::to_string(i));
  EXPECT_EQ(good().verdict(names), "no scan stands out");
  for (const std::size_t off : {0, 5}) {
    const MapQuality quality = measured(oneMoved(off));
    EXPECT_EQ(quality.worstFirst().front(), off);
    EXPECT_EQ(quality.verdict(names).find("1 of 12 scans stands out: scan" +
                                          std::to_string(off) + " ("),
              0u)
        << quality.verdict(names);
    EXPECT_GT(quality.scans[off].worst_score, 3.5);
    EXPECT_FALSE(quality.scans[off].stands_out.empty());
  }
}

TEST(MeasureMap, HasTheSameBitsForAnyNumberOfThreads)
{
  const MapQuality one = measured(bent(0.05), 1), three = measured(bent(0.05), 3);
  EXPECT_EQ(one.agreement, three.agreement);
  EXPECT_EQ(one.entropy, three.entropy);
  EXPECT_EQ(one.plane_variance, three.plane_variance);
  EXPECT_EQ(one.thickness.rms, three.thickness.rms);
  EXPECT_EQ(one.others.plane.rms, three.others.plane.rms);
  EXPECT_EQ(one.others.point.percentile_95, three.others.point.percentile_95);
  for (std::size_t i = 0; i < kScans; ++i)
    EXPECT_EQ(one.scans[i].worst_score, three.scans[i].worst_score);
}

TEST(MeasureMap, DoesNotDependOnTheWorld)
{
  Poses far = run().truth;
  for (auto& pose : far) // national coordinates, in which float has half a metre
    pose = pcl6d::poseFromEuler({4.5e6, 5.4e6, 300}, {0.1, 0, 2}) * pose;
  const MapQuality quality = measured(far);
  EXPECT_NEAR(quality.agreement, good().agreement, 1e-3);
  EXPECT_NEAR(quality.entropy, good().entropy, 0.02);
  EXPECT_NEAR(quality.thickness.median, good().thickness.median, 5e-4);
  EXPECT_NEAR(quality.others.plane.rms, good().others.plane.rms, 5e-4);
  const auto& plane = quality.thickness.planes.front().plane;
  EXPECT_NEAR(plane.normal.dot(plane.hull.front()), plane.offset, 1e-3);
}

TEST(MeasureMap, MeasuresDistancesToAReference)
{
  Points reference;
  for (std::size_t i = 0; i < kScans; ++i)
    for (const auto& p : pcl6d::transformed(run().scans[i], run().truth[i]))
      reference.push_back(p);
  const auto at = [&](const Poses& poses) {
    return measureMap(run().scans, poses, options(), reference);
  };
  const MapQuality exact = at(run().truth), off = at(oneMoved(4));
  EXPECT_EQ(exact.reference.point.median, 0) << "every point is one of it";
  EXPECT_EQ(exact.reference.matched, 1);
  EXPECT_LT(exact.reference.plane.median, 0.006);
  EXPECT_GT(off.scans[4].reference.plane.rms, 2 * exact.scans[4].reference.plane.rms);
  EXPECT_EQ(off.scans[3].reference.plane.rms, exact.scans[3].reference.plane.rms);
}

TEST(MeasureMap, OfScansThatDoNotMeetSaysSo)
{
  const Poses apart{Eigen::Isometry3d::Identity(), pcl6d::planarPose(1000, 0, 0)};
  const MapQuality quality =
      measureMap({run().scans[0], run().scans[1]}, apart, options());
  EXPECT_EQ(quality.pairs, 0u);
  for (const double value : {quality.agreement,
                             quality.others.plane.rms,
                             quality.revisit_blur,
                             quality.thickness.rms,
                             quality.scans[0].agreement})
    EXPECT_TRUE(std::isnan(value));
  EXPECT_TRUE(std::isfinite(quality.entropy)) << "each by itself";
  EXPECT_EQ(quality.verdict({"a", "b"}), "too few scans for one to stand out");
}

TEST(MeasureMap, RefusesWhatIsNoMap)
{
  const auto refused = [](const std::vector<Points>& scans, const Poses& poses) {
    return badArgumentOf([&] { measureMap(scans, poses, options()); });
  };
  const Points& scan = run().scans[0];
  const Poses two(2, Eigen::Isometry3d::Identity());
  EXPECT_EQ(refused({}, {}).find("number of scans = 0"), 0u);
  EXPECT_EQ(refused({scan}, {two[0]}).find("number of scans = 1"), 0u);
  EXPECT_EQ(refused({scan, scan}, {two[0]}).find("number of poses = 1"), 0u);
  const float nan = pcl6d::test::kNan;
  const Points lost{{nan, 0, 0}, {0, nan, 0}, {1, 2, 3}, {1, 2, 4}};
  EXPECT_EQ(refused({scan, lost}, two).find("scan 1: finite points = 2"), 0u);
  Poses broken = two;
  broken[1].translation().x() = std::nan("");
  EXPECT_EQ(refused({scan, scan}, broken).find("pose 1 "), 0u);
  const auto badOption = [&](auto change) {
    MapQualityOptions bad = options();
    change(bad);
    return badArgumentOf([&] { measureMap({scan, scan}, two, bad); });
  };
  EXPECT_EQ(badOption([](auto& o) { o.voxel = 0; }).find("voxel = 0"), 0u);
  EXPECT_EQ(badOption([](auto& o) { o.radius = -1; }).find("radius = -1"), 0u);
  EXPECT_EQ(badOption([](auto& o) { o.max_distance = 0; }).find("max_distance"), 0u);
  EXPECT_EQ(badOption([](auto& o) { o.within = 0; }).find("within = 0"), 0u);
  EXPECT_EQ(badOption([](auto& o) { o.outlier = 0; }).find("outlier = 0"), 0u);
  EXPECT_EQ(badOption([](auto& o) { o.revisit_gap = 1; }).find("revisit_gap"), 0u);
  EXPECT_NE(badArgumentOf([] { good().verdict({"one"}); }), "");
}
