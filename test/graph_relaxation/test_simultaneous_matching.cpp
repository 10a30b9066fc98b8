// SPDX-License-Identifier: BSD-3-Clause
#include "support/bits.h"
#include "support/points.h"
#include "support/room.h"

#include <pcl6d/graph_relaxation/simultaneous_matching.h>

#include <cmath>

namespace pcl6d::test {

namespace {
/** Scans of a room from a ring of places, with poses that are off; the first is right. */
struct Ring {
  explicit Ring(std::size_t n = 6)
  {
    Random random(21);
    const PillarRoom room;
    IcpModel::Options with_normals;
    with_normals.normals = true;
    for (std::size_t i = 0; i < n; ++i) {
      const double turn = 2 * M_PI * i / n;
      truth.push_back(poseFromEuler(
          {0.5 + 1.2 * std::cos(turn), 1.2 * std::sin(turn), 0}, {0, 0, 0.3 * i}));
      scans.push_back(std::make_shared<const IcpModel>(
          room.scan(truth.back(), random, 0.06), with_normals));
      poses.push_back(i == 0 ? truth[0] : truth[i] * randomPose(random, 0.08, 0.02));
    }
  }

  double
  error(const std::vector<Eigen::Isometry3d>& found) const
  {
    double sum = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
      sum += distanceBetween(found[i], truth[i]).translation;
    return sum / truth.size(); // [m]
  }

  SimultaneousMatching::Scans scans;
  std::vector<Eigen::Isometry3d> truth, poses;
};

SimultaneousMatchingOptions
fineOptions()
{
  SimultaneousMatchingOptions options;
  options.icp.max_distance = 0.3;
  options.icp.metric = Metric::kPlane;
  options.min_translation = 0.001;
  options.min_rotation = 0.0002;
  return options;
}
} // namespace

TEST(SimultaneousMatching, BringsTheScansOfARingTogether)
{
  const Ring ring;
  const auto result = SimultaneousMatching(fineOptions()).align(ring.scans, ring.poses);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_EQ(result.failed, 0u);
  EXPECT_LT(ring.error(result.poses), 0.2 * ring.error(ring.poses));
}

TEST(SimultaneousMatching, SpreadsFromOneScanToItsNeighbours)
{
  const Ring ring;
  for (const std::size_t start : {std::size_t(0), std::size_t(3)}) {
    const auto result =
        SimultaneousMatching(fineOptions()).align(ring.scans, ring.poses, {start});
    EXPECT_EQ(result.status, Status::kOk);
    EXPECT_GT(result.pops, ring.scans.size());
    EXPECT_LT(ring.error(result.poses), 0.2 * ring.error(ring.poses));
  }
}

TEST(SimultaneousMatching, NeverMovesTheMaster)
{
  const Ring ring;
  auto options = fineOptions();
  for (const std::size_t master : {0, 2}) {
    options.master = master;
    const auto result =
        SimultaneousMatching(options).align(ring.scans, ring.poses, {0, 1, 2, 3});
    for (std::size_t i = 0; i < ring.poses.size(); ++i)
      EXPECT_EQ(sameBits(result.poses[i], ring.poses[i]), i == master) << i;
  }
}

TEST(SimultaneousMatching, NeedsOneMatchForOneScanBesideTheMaster)
{
  const Ring ring(2);
  const auto result =
      SimultaneousMatching(fineOptions()).align(ring.scans, ring.poses, {1});
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_EQ(result.pops, 1u); // it moved, but the master need not be woken
  EXPECT_FALSE(sameBits(result.poses[1], ring.poses[1]));
}

TEST(SimultaneousMatching, StopsAtTheLimit)
{
  const Ring ring;
  auto options = fineOptions();
  options.min_translation = 0; // no step is small enough
  options.pops_per_scan = 3;
  std::vector<std::size_t> seen;
  SimultaneousMatching matching(options);
  matching.setProgress([&](const Progress& progress) {
    EXPECT_EQ(progress.total, 18u);
    seen.push_back(progress.done);
  });
  const auto result = matching.align(ring.scans, ring.poses);
  EXPECT_EQ(result.status, Status::kMaxIterations);
  EXPECT_EQ(result.pops, 18u);
  ASSERT_EQ(seen.size(), 18u);
  EXPECT_EQ(seen.back(), 18u);
}

TEST(SimultaneousMatching, GivesTheSameBitsForAnyNumberOfThreads)
{
  const Ring ring(4);
  auto options = fineOptions();
  options.icp.num_threads = 1;
  const auto expected = SimultaneousMatching(options).align(ring.scans, ring.poses);
  for (const unsigned int threads : {2, 8}) {
    options.icp.num_threads = threads;
    const auto result = SimultaneousMatching(options).align(ring.scans, ring.poses);
    EXPECT_EQ(result.pops, expected.pops);
    for (std::size_t i = 0; i < ring.poses.size(); ++i)
      EXPECT_TRUE(sameBits(result.poses[i], expected.poses[i])) << i;
  }
}

TEST(SimultaneousMatching, WorksFarFromTheOrigin)
{
  Ring ring(4);
  const auto near = SimultaneousMatching(fineOptions()).align(ring.scans, ring.poses);
  for (auto& pose : ring.poses)
    pose.pretranslate(Eigen::Vector3d(691234, 5336789, 500));
  for (auto& pose : ring.truth)
    pose.pretranslate(Eigen::Vector3d(691234, 5336789, 500));
  const auto far = SimultaneousMatching(fineOptions()).align(ring.scans, ring.poses);
  EXPECT_EQ(far.status, Status::kOk);
  EXPECT_LT(ring.error(far.poses), 0.2 * ring.error(ring.poses));
  // Poses round to 1e-9 m there, the points in a scan's frame to 1e-6 m here and there.
  for (std::size_t i = 0; i < far.poses.size(); ++i) {
    Eigen::Isometry3d back = far.poses[i];
    back.pretranslate(-Eigen::Vector3d(691234, 5336789, 500));
    EXPECT_LT(distanceBetween(back, near.poses[i]).translation, 1e-3) << i;
  }
}

TEST(SimultaneousMatching, MatchesNothingWhereNothingOverlaps)
{
  Ring ring(3);
  for (std::size_t i = 0; i < 3; ++i)
    ring.poses[i].translation().x() += 100.0 * i;
  const auto result = SimultaneousMatching(fineOptions()).align(ring.scans, ring.poses);
  EXPECT_EQ(result.status, Status::kTooFewPairs);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_TRUE(sameBits(result.poses[i], ring.poses[i]));

  auto options = fineOptions(); // more pairs than there are points
  options.min_pairs = 1000000;
  const Ring together(3);
  EXPECT_EQ(SimultaneousMatching(options).align(together.scans, together.poses).status,
            Status::kTooFewPairs);
}

TEST(SimultaneousMatching, TakesNoScansOneScanAndEmptyScans)
{
  const SimultaneousMatching matching(fineOptions());
  EXPECT_EQ(matching.align({}, {}).status, Status::kTooFewPairs);
  const Ring one(1);
  EXPECT_EQ(matching.align(one.scans, one.poses, {0}).status, Status::kTooFewPairs);
  Ring ring(3);
  ring.scans[1] = std::make_shared<const IcpModel>(
      Points{{kNan, 0, 0}}, Normals(1), IcpModel::Options{});
  const auto result = matching.align(ring.scans, ring.poses);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_TRUE(sameBits(result.poses[1], ring.poses[1]));
}

TEST(SimultaneousMatching, RefusesBadInput)
{
  Ring ring(3);
  const SimultaneousMatching matching;
  EXPECT_EQ(badArgumentOf([&] { matching.align(ring.scans, ring.poses, {3}); }),
            "start = 3, but must be less than the 3 scans");
  EXPECT_EQ(badArgumentOf([&] { matching.align(ring.scans, {}); }),
            "poses = 0, but must be one per scan");
  auto poses = ring.poses;
  poses[1](0, 3) = kNan;
  EXPECT_EQ(badArgumentOf([&] { matching.align(ring.scans, poses); }),
            "pose = 1, but must be finite and rigid");
  ring.scans[2] = nullptr;
  EXPECT_EQ(badArgumentOf([&] { matching.align(ring.scans, ring.poses); }),
            "scan = 2, but must be given, not null");
  SimultaneousMatchingOptions options;
  options.master = 3;
  EXPECT_EQ(badArgumentOf([&] {
              SimultaneousMatching(options).align(Ring(3).scans, ring.poses);
            }),
            "master = 3, but must be less than the 3 scans");
  options.pops_per_scan = 0;
  EXPECT_EQ(badArgumentOf([&] { SimultaneousMatching with(options); }),
            "pops_per_scan = 0, but must be > 0");
}

} // namespace pcl6d::test
