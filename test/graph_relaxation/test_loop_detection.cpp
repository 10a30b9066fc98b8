// SPDX-License-Identifier: BSD-3-Clause
#include "network_scans.h"
#include "support/bits.h"
#include "support/points.h"

#include <pcl6d/graph_relaxation/loop_detection.h>

using pcl6d::detectLoops;
using pcl6d::LinkKind;
using pcl6d::LinkVerdict;
using pcl6d::LoopDetectionOptions;
using pcl6d::Poses;
using pcl6d::ScanLink;
using pcl6d::test::badArgumentOf;
using pcl6d::test::moved;
using pcl6d::test::NetworkScans;

namespace {
constexpr std::size_t kScans = 16, kGap = 10;

const NetworkScans&
ring()
{
  static const NetworkScans scans =
      pcl6d::test::scansFrom(pcl6d::test::ringPoses(kScans));
  return scans;
}

/** The ring's chain, which ends 0.3 m away from where it began. */
Poses
driftedRing()
{
  return pcl6d::test::drifted(
      ring().truth, pcl6d::poseFromEuler({0.012, -0.01, 0.01}, {0.001, 0, 0.002}));
}

LoopDetectionOptions
optionsOf(std::size_t min_gap)
{
  LoopDetectionOptions options;
  options.max_distance = 2.5;
  options.min_gap = min_gap;
  options.icp.metric = pcl6d::Metric::kGicp;
  options.icp.max_distance = 0.5;
  return options;
}

std::vector<ScanLink>
loopsOf(const Poses& poses, std::vector<bool> usable = {})
{
  usable.resize(kScans, true);
  return detectLoops(ring().scans, poses, usable, optionsOf(kGap));
}

double
errorOf(const ScanLink& loop, const Poses& truth)
{
  const Eigen::Isometry3d T = truth[loop.from].inverse() * truth[loop.to];
  return (T.translation() - loop.T_from_to->translation()).norm();
}
} // namespace

TEST(DetectLoops, FindsTheLoopOfARingWhoseChainHasDrifted)
{
  const Poses poses = driftedRing();
  EXPECT_GT((poses.back().translation() - poses.front().translation()).norm(), 0.15);
  bool whole = false;
  const auto loops = loopsOf(poses);
  for (const ScanLink& loop : loops) {
    EXPECT_EQ(loop.kind, LinkKind::kLoop);
    EXPECT_GE(loop.to, loop.from + kGap);
    EXPECT_EQ(loop.verdict, LinkVerdict::kUsed)
        << loop.from << " - " << loop.to << ": " << loop.rejection;
    EXPECT_DOUBLE_EQ(
        loop.distance,
        (poses[loop.from].translation() - poses[loop.to].translation()).norm());
    ASSERT_TRUE(loop.T_from_to);
    EXPECT_LT(errorOf(loop, ring().truth), 0.02) << loop.from << " - " << loop.to;
    EXPECT_GE(loop.pairs, 250u);
    EXPECT_GE(loop.overlap, 0.3);
    whole = whole || (loop.from == 0 && loop.to == kScans - 1);
  }
  EXPECT_TRUE(whole) << "its ends";
  for (std::size_t k = 1; k < loops.size(); ++k)
    EXPECT_LE(loops[k - 1].to, loops[k].to);
}

TEST(DetectLoops, LeavesOutScansThatAreNotUsable)
{
  std::vector<bool> usable(kScans, true);
  usable[0] = usable[kScans - 2] = false;
  const auto loops = loopsOf(driftedRing(), usable);
  EXPECT_FALSE(loops.empty());
  for (const ScanLink& loop : loops) {
    EXPECT_NE(loop.from, 0u);
    EXPECT_NE(loop.to, kScans - 2);
  }
  EXPECT_TRUE(loopsOf(driftedRing(), std::vector<bool>(kScans, false)).empty());
}

TEST(DetectLoops, LooksOnlyAsFarAsThePositionsAreUncertain)
{
  const Poses poses = driftedRing();
  const std::vector<bool> usable(kScans, true);
  const auto loops = loopsOf(poses);
  ASSERT_FALSE(loops.empty());
  LoopDetectionOptions options = optionsOf(kGap);
  options.position_covariances.assign(kScans, 100 * Eigen::Matrix3d::Identity());
  EXPECT_EQ(detectLoops(ring().scans, poses, usable, options).size(), loops.size());
  // Just below and above the distance of a single candidate, both ends alike.
  const double way_sq = loops[0].distance * loops[0].distance;
  for (const double factor : {1.01, 0.99}) {
    const double variance = factor * way_sq / 11.3 / 2;
    options.position_covariances.assign(kScans, variance * Eigen::Matrix3d::Identity());
    const auto found = detectLoops(ring().scans, poses, usable, options);
    EXPECT_EQ(std::count_if(found.begin(),
                            found.end(),
                            [&](const ScanLink& loop) {
                              return loop.from == loops[0].from &&
                                     loop.to == loops[0].to;
                            }),
              factor > 1 ? 1 : 0);
  }
  options.position_covariances.pop_back();
  EXPECT_NE(badArgumentOf([&] {
              detectLoops(ring().scans, poses, usable, options);
            }).find("position_covariances"),
            std::string::npos);
  options.position_covariances.assign(kScans, -Eigen::Matrix3d::Identity());
  EXPECT_NE(badArgumentOf([&] { options.validate(); }).find("positive definite"),
            std::string::npos);
}

TEST(DetectLoops, LooksOnlyAtScansWithinReach)
{
  Poses poses = driftedRing();
  for (std::size_t i = kGap; i < kScans; ++i)
    poses[i] = moved(poses[i], {0, 0, 11}); // higher than max_height
  EXPECT_TRUE(loopsOf(poses).empty());
  for (std::size_t i = kGap; i < kScans; ++i)
    poses[i] = moved(poses[i], {20, 0, -11});
  EXPECT_TRUE(loopsOf(poses).empty());
}

TEST(DetectLoops, RefusesScansThatSeeDifferentRooms)
{
  // Two rooms side by side, of other shapes; the ends of the chain are 2 m apart with a thin
  // wall between them, whose two sides are near each other.
  pcl6d::test::PillarRoom left, right;
  left.walls = {Eigen::Vector3d(-6, -4, -1), Eigen::Vector3d(-0.05, 4, 2)};
  left.pillars = {{Eigen::Vector3d(-5, 1, -1), Eigen::Vector3d(-4, 2, 2)}};
  right.walls = {Eigen::Vector3d(0.05, -2, -1), Eigen::Vector3d(4, 6, 3)};
  right.pillars = {{Eigen::Vector3d(2.5, -1, -1), Eigen::Vector3d(3, 0, 1)}};
  pcl6d::Random random(9);
  NetworkScans scans;
  for (const double y : {0., 0.5, 1.})
    scans.add(left.scan(pcl6d::poseFromEuler({-1, y, 0}, {0, 0, 0}), random, 0.06),
              pcl6d::poseFromEuler({-1, y, 0}, {0, 0, 0}));
  for (const double y : {1., 0.5, 0.})
    scans.add(right.scan(pcl6d::poseFromEuler({1, y, 0}, {0, 0, 0}), random, 0.06),
              pcl6d::poseFromEuler({1, y, 0}, {0, 0, 0}));
  const auto loops =
      detectLoops(scans.scans, scans.truth, std::vector<bool>(6, true), optionsOf(4));
  ASSERT_FALSE(loops.empty());
  for (const ScanLink& loop : loops) {
    EXPECT_EQ(loop.verdict, LinkVerdict::kRefused) << loop.from << " - " << loop.to;
    EXPECT_GT(loop.pairs, 0u) << "of the wall";
    EXPECT_TRUE(loop.rejection);
  }
}

TEST(DetectLoops, RefusesALoopThatContradictsThoseBesideIt)
{
  // A scan that the chain puts 1.2 m beside its place: matched to the first scans it asks
  // for another closing than all others.
  Poses poses = ring().truth;
  const std::size_t wrong = kScans - 2;
  poses[wrong] = moved(poses[wrong], {0, 0, 1.2});
  std::vector<bool> usable(kScans, true);
  usable[wrong - 1] = false; // or it would hold its neighbour in the metascan
  const auto loops = loopsOf(poses, usable);
  std::size_t good = 0, refused = 0;
  for (const ScanLink& loop : loops) {
    if (loop.to == wrong) {
      EXPECT_EQ(loop.verdict, LinkVerdict::kRefused);
      refused += loop.rejection.reason == pcl6d::RejectReason::kContradictsLoops;
    }
    else
      good += loop.verdict == LinkVerdict::kUsed;
  }
  EXPECT_GE(good, 2u);
  EXPECT_GE(refused, 1u);
}

TEST(DetectLoops, GivesTheSameBitsForAnyNumberOfThreads)
{
  LoopDetectionOptions options = optionsOf(kGap);
  const auto found = [&](unsigned int threads) {
    options.icp.num_threads = threads;
    return detectLoops(
        ring().scans, driftedRing(), std::vector<bool>(kScans, true), options);
  };
  const auto one = found(1), many = found(8);
  ASSERT_EQ(one.size(), many.size());
  for (std::size_t k = 0; k < one.size(); ++k)
    EXPECT_TRUE(pcl6d::test::sameBits(*one[k].T_from_to, *many[k].T_from_to));
}

TEST(DetectLoops, RefusesOtherNumbersOfPosesAndFlags)
{
  const auto& r = ring();
  EXPECT_NE(
      badArgumentOf([&] { detectLoops(r.scans, Poses(3), {true}, {}); }).find("poses"),
      std::string::npos);
  EXPECT_NE(
      badArgumentOf([&] { detectLoops(r.scans, r.truth, {true}, {}); }).find("usable"),
      std::string::npos);
}

TEST(LoopDetectionOptions, NamesTheFieldThatBreaksItsRule)
{
  const auto expectRefused = [](const std::string& name, const auto& change) {
    LoopDetectionOptions options;
    change(options);
    EXPECT_NE(badArgumentOf([&] { options.validate(); }).find(name), std::string::npos)
        << name;
  };
  EXPECT_NO_THROW(LoopDetectionOptions().validate());
  expectRefused("max_distance", [](auto& o) { o.max_distance = 0; });
  expectRefused("max_height", [](auto& o) { o.max_height = -1; });
  expectRefused("min_gap", [](auto& o) { o.min_gap = 0; });
  expectRefused("min_pairs", [](auto& o) { o.min_pairs = 0; });
  expectRefused("min_overlap", [](auto& o) { o.min_overlap = 1.5; });
  expectRefused("max_rms_share", [](auto& o) { o.max_rms_share = 0; });
  expectRefused("min_consistency", [](auto& o) { o.min_consistency = -0.1; });
  expectRefused("max_iterations", [](auto& o) { o.icp.max_iterations = 0; });
}
