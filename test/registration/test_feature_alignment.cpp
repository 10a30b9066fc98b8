// SPDX-License-Identifier: BSD-3-Clause
#include "support/bits.h"
#include "support/points.h"
#include "support/room.h"

#include <pcl6d/registration/feature_alignment.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {
using namespace pcl6d;
using namespace pcl6d::test;

// Scans of one room from two places.
struct TwoScans {
  Eigen::Isometry3d truth; // T_target_source
  Points target, source;

  explicit TwoScans(std::uint64_t seed, double turn = 0.5, double step = 0.05)
  {
    const PillarRoom room;
    Random random(seed);
    const Eigen::Isometry3d first = randomPose(random, 0.6, 0.1);
    const Eigen::Isometry3d second = randomPose(random, 0.8, turn);
    truth = first.inverse() * second;
    target = room.scan(first, random, step);
    source = room.scan(second, random, step);
  }
};

// Voxels are about 0.3 m here and noise is 5 mm. What is left once ICP has slid the few
// thousand means of voxels onto each other: a tenth of a voxel, at walls 5 m away.
void
expectNear(const Eigen::Isometry3d& found, const Eigen::Isometry3d& truth)
{
  const auto off = distanceBetween(truth, found);
  EXPECT_LT(off.translation, 0.03);
  EXPECT_LT(off.rotation, 0.005);
}

void
expectSame(const CoarseEstimate& a, const CoarseEstimate& b)
{
  EXPECT_EQ(a.status, b.status);
  EXPECT_TRUE(sameBits(a.T_target_source, b.T_target_source));
  EXPECT_EQ(a.score, b.score);
  EXPECT_EQ(a.second_score, b.second_score);
}

// A corridor of floor and two walls, from which the scanner sees ten metres.
Points
corridor(Random& random, std::size_t count)
{
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double along = random.uniform(-10, 10), across = random.uniform(-1, 1);
    const double up = random.uniform(-1, 1);
    points.push_back((i % 3 == 0 ? Eigen::Vector3d(along, across, -1)
                                 : Eigen::Vector3d(along, i % 3 == 1 ? 1 : -1, up))
                         .cast<float>());
  }
  return points;
}

std::string
refusal(const FeatureAlignmentOptions& options)
{
  return badArgumentOf([&] { alignByFeatures({}, {}, options); });
}
} // namespace

TEST(FeatureAlignment, FindsAnyTurnWithoutAGuess)
{
  for (const double turn : {0.0, 0.7, 2.0, M_PI}) {
    SCOPED_TRACE("turn [rad] " + std::to_string(turn));
    const TwoScans scans(7, turn, 0.03); // coarser, half a turn is nearly as good
    const CoarseEstimate found = alignByFeatures(scans.target, scans.source);
    EXPECT_EQ(found.status, Status::kOk);
    expectNear(found.T_target_source, scans.truth);
    EXPECT_GT(found.score, 0.5);
    EXPECT_LE(found.second_score, found.score);
  }
}

TEST(FeatureAlignment, FindsTheSamePlaceWithManySeeds)
{
  const TwoScans scans(21);
  FeatureAlignmentOptions options;
  for (options.seed = 0; options.seed < 4; ++options.seed) {
    SCOPED_TRACE("seed " + std::to_string(options.seed));
    const CoarseEstimate found = alignByFeatures(scans.target, scans.source, options);
    EXPECT_EQ(found.status, Status::kOk);
    expectNear(found.T_target_source, scans.truth);
  }
}

TEST(FeatureAlignment, IsItsOwnInverse)
{
  const TwoScans scans(9, 1.0);
  const CoarseEstimate there = alignByFeatures(scans.target, scans.source);
  const CoarseEstimate back = alignByFeatures(scans.source, scans.target);
  EXPECT_EQ(there.status, Status::kOk);
  EXPECT_EQ(back.status, Status::kOk);
  expectNear(there.T_target_source * back.T_target_source,
             Eigen::Isometry3d::Identity());
}

TEST(FeatureAlignment, GivesTheSameBitsForAnyNumberOfThreads)
{
  const TwoScans scans(5);
  FeatureAlignmentOptions options;
  options.num_threads = 1;
  const CoarseEstimate one = alignByFeatures(scans.target, scans.source, options);
  EXPECT_EQ(one.status, Status::kOk);
  for (const unsigned int threads : {2u, 3u, 8u}) {
    options.num_threads = threads;
    expectSame(alignByFeatures(scans.target, scans.source, options), one);
  }
}

TEST(FeatureAlignment, DoesNotCountRepeatedOrMissingPoints)
{
  const TwoScans scans(5);
  Points target = scans.target, source = scans.source;
  target.insert(target.end(), scans.target.begin(), scans.target.end());
  source.insert(source.begin(), 100, Eigen::Vector3f(kNan, 1, kInfinity));
  const CoarseEstimate found = alignByFeatures(target, source);
  EXPECT_EQ(found.status, Status::kOk);
  expectNear(found.T_target_source, scans.truth);
}

TEST(FeatureAlignment, DoesNotBelieveTwoDifferentPlaces)
{
  PillarRoom other; // another room: smaller, with other furniture
  other.walls = {Eigen::Vector3d(-3, -6, -1.2), Eigen::Vector3d(2.5, 3, 1.4)};
  other.pillars = {{Eigen::Vector3d(-2, 1, -1.2), Eigen::Vector3d(-1, 1.4, 0)},
                   {Eigen::Vector3d(0.5, -4, -1.2), Eigen::Vector3d(2.5, -3.3, -0.2)},
                   {Eigen::Vector3d(-3, -3, -1.2), Eigen::Vector3d(-2.5, -2, 0.8)}};
  Random random(13);
  const Points elsewhere = other.scan(randomPose(random, 0.3, 0.1), random);
  const TwoScans scans(7);
  const CoarseEstimate found = alignByFeatures(scans.target, elsewhere);
  EXPECT_NE(found.status, Status::kOk) << found.score << " " << found.second_score;
}

TEST(FeatureAlignment, CountsWhatTheOtherScanLookedThrough)
{
  const PillarRoom room;
  PillarRoom parted = room; // by a screen that the first scan did not see
  parted.pillars.push_back({Eigen::Vector3d(2, -2, -1), Eigen::Vector3d(2.2, 2, 2)});
  Random random(17);
  const Eigen::Isometry3d pose = planarPose(0.3, 0.2, 0.4);
  const Points before = room.scan(Eigen::Isometry3d::Identity(), random, 0.03);
  const Points again = room.scan(pose, random, 0.03);
  const Points after = parted.scan(pose, random, 0.03);
  FeatureAlignmentOptions strict, lenient; // the screen denies 3 % of what meets
  strict.min_consistency = 0.99;
  lenient.min_consistency = 0;
  EXPECT_EQ(alignByFeatures(before, again, strict).status, Status::kOk);
  EXPECT_EQ(alignByFeatures(before, after, strict).status, Status::kTooFewPairs);
  EXPECT_EQ(alignByFeatures(after, before, strict).status, Status::kTooFewPairs);
  const CoarseEstimate found = alignByFeatures(before, after, lenient);
  EXPECT_EQ(found.status, Status::kOk);
  expectNear(found.T_target_source, pose);
}

TEST(FeatureAlignment, DoesNotChooseAPlaceAlongACorridor)
{
  Random random(3);
  const Points target = corridor(random, 20000), source = corridor(random, 20000);
  EXPECT_NE(alignByFeatures(target, source).status, Status::kOk);
  const CoarseEstimate found = alignByFeatures(target, target);
  EXPECT_EQ(found.status, Status::kRankDeficient);
  EXPECT_GT(found.ambiguity(), 0.95);
}

TEST(FeatureAlignment, DoesNotChooseBetweenTheWaysIntoASymmetricRoom)
{
  PillarRoom room; // half a turn maps it to itself
  room.walls = {Eigen::Vector3d(-5, -4, -1), Eigen::Vector3d(5, 4, 2)};
  room.pillars = {{Eigen::Vector3d(1, 1, -1), Eigen::Vector3d(2, 3, 2)},
                  {Eigen::Vector3d(-2, -3, -1), Eigen::Vector3d(-1, -1, 2)}};
  Random random(4);
  const Points target = room.scan(Eigen::Isometry3d::Identity(), random);
  const Points source = room.scan(planarPose(0, 0, 0.3), random);
  const CoarseEstimate found = alignByFeatures(target, source);
  EXPECT_EQ(found.status, Status::kRankDeficient);
  EXPECT_GT(found.score, 0.8);
}

TEST(FeatureAlignment, HasNoAnswerWithoutShape)
{
  Random random(3);
  Points plane;
  for (int i = 0; i < 20000; ++i)
    plane.emplace_back(random.uniform(-5, 5), random.uniform(-5, 5), -1);
  const Points none, two = {{1, 2, 3}, {2, 2, 3}};
  const Points not_finite(9, Eigen::Vector3f::Constant(kNan));
  const Points repeated(500, Eigen::Vector3f(1, 2, 3));
  const TwoScans scans(7, 0.5, 0.1);
  EXPECT_NE(alignByFeatures(plane, plane).status, Status::kOk);
  EXPECT_NE(alignByFeatures(scans.target, plane).status, Status::kOk);
  for (const Points* few : {&none, &two, &not_finite, &repeated}) {
    for (const CoarseEstimate& found : {alignByFeatures(*few, scans.source),
                                        alignByFeatures(scans.target, *few),
                                        alignByFeatures(*few, *few)}) {
      EXPECT_EQ(found.status, Status::kTooFewPairs);
      EXPECT_TRUE(sameBits(found.T_target_source, Eigen::Isometry3d::Identity()));
    }
  }
}

TEST(FeatureAlignment, RefusesBadOptions)
{
  const auto with = [](auto change) {
    FeatureAlignmentOptions options;
    change(options);
    return refusal(options);
  };
  EXPECT_EQ(refusal({}), "");
  EXPECT_EQ(with([](auto& o) { o.voxel = 0; }),
            "voxel = 0, but must be finite and > 0");
  EXPECT_EQ(with([](auto& o) { o.feature_radius = NAN; }),
            "feature_radius = nan, but must be finite and > 0");
  EXPECT_EQ(with([](auto& o) { o.min_overlap = -0.1; }),
            "min_overlap = -0.1, but must be in [0, 1]");
  EXPECT_EQ(with([](auto& o) { o.min_consistency = 2; }),
            "min_consistency = 2, but must be in [0, 1]");
  EXPECT_EQ(with([](auto& o) { o.max_ambiguity = 1.1; }),
            "max_ambiguity = 1.1, but must be in [0, 1]");
}
