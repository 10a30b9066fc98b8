// SPDX-License-Identifier: BSD-3-Clause
#include "support/bits.h"
#include "support/points.h"
#include "support/room.h"

#include <pcl6d/registration/icp.h>
#include <pcl6d/registration/overlap_search.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {
using namespace pcl6d;
using namespace pcl6d::test;

const Eigen::Isometry3d kNoGuess = Eigen::Isometry3d::Identity();

// Two scans of one room from different places.
struct OverlappingScans {
  Eigen::Isometry3d truth; // T_target_source
  Points target, source;

  explicit OverlappingScans(double step = 0.03)
  {
    const PillarRoom room;
    Random random(7);
    const Eigen::Isometry3d first = randomPose(random, 0.5, 0.1);
    const Eigen::Isometry3d second = randomPose(random, 0.8, 0.5);
    truth = first.inverse() * second;
    target = room.scan(first, random, step);
    source = room.scan(second, random, step);
  }

  // The truth, moved about the middle of the source: what the window speaks of.
  Eigen::Isometry3d
  guess(const Eigen::Vector3d& shift, const EulerAngles& turn) const
  {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const auto& p : source)
      middle += p.cast<double>() / static_cast<double>(source.size());
    middle = truth * middle;
    return Eigen::Translation3d(middle) * poseFromEuler(shift, turn) *
           Eigen::Translation3d(-middle) * truth;
  }
};

IcpOptions
fineIcp()
{
  IcpOptions options;
  options.max_distance = 0.1;
  options.max_distance_start = 0.5;
  return options;
}

std::string
refusal(const OverlapSearchOptions& options)
{
  const Points points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  return badArgumentOf([&] { searchByOverlap(points, points, kNoGuess, options); });
}
} // namespace

TEST(OverlapSearch, BringsBadGuessesIntoTheBasinOfIcp)
{
  const OverlappingScans scans;
  const PointTree tree(scans.target);
  OverlapSearchOptions options;
  options.translation_window = Eigen::Vector3d(1, 1, 0.3);
  Random random(11);
  for (int i = 0; i < 8; ++i) {
    SCOPED_TRACE(i);
    const auto within = [&](double window) { return random.uniform(-window, window); };
    const Eigen::Isometry3d guess =
        scans.guess(Eigen::Vector3d(within(1), within(1), within(0.3)),
                    {within(0.1), within(0.1), within(0.35)});
    const CoarseEstimate found =
        searchByOverlap(scans.target, scans.source, guess, options);
    EXPECT_EQ(found.status, Status::kOk);
    const auto off = distanceBetween(scans.truth, found.T_target_source);
    EXPECT_LT(off.translation, 0.35);
    EXPECT_LT(off.rotation, 0.07);
    const IcpResult icp_result =
        icp(tree, scans.target, scans.source, found.T_target_source, fineIcp());
    const auto end = distanceBetween(scans.truth, icp_result.T_target_source);
    EXPECT_LT(end.translation, 0.03);
    EXPECT_LT(end.rotation, 0.005);
  }
}

TEST(OverlapSearch, LeavesAPerfectGuessWhereItIs)
{
  const OverlappingScans scans;
  const CoarseEstimate found = searchByOverlap(scans.target, scans.target, kNoGuess);
  EXPECT_EQ(found.status, Status::kOk);
  EXPECT_TRUE(sameBits(found.T_target_source, kNoGuess)); // ties: the smallest motion
  EXPECT_EQ(found.score, 1);
  EXPECT_LT(found.ambiguity(), 0.95);
}

TEST(OverlapSearch, GivesTheSameBitsForAnyNumberOfThreads)
{
  const OverlappingScans scans(0.05);
  const Eigen::Isometry3d guess =
      scans.guess(Eigen::Vector3d(0.4, -0.3, 0.1), {0.05, -0.05, 0.2});
  OverlapSearchOptions options;
  options.num_threads = 1;
  const CoarseEstimate one =
      searchByOverlap(scans.target, scans.source, guess, options);
  for (const unsigned int threads : {2u, 3u, 8u}) {
    options.num_threads = threads;
    const CoarseEstimate many =
        searchByOverlap(scans.target, scans.source, guess, options);
    EXPECT_TRUE(sameBits(many.T_target_source, one.T_target_source));
    EXPECT_EQ(many.score, one.score);
    EXPECT_EQ(many.second_score, one.second_score);
  }
}

TEST(OverlapSearch, MovesWithTheFrameOfTheTarget)
{
  OverlappingScans scans(0.05);
  for (auto& p : scans.target) // so that float holds the moved points exactly
    p = (p * 4096).array().round() / 4096;
  const Eigen::Isometry3d guess =
      scans.guess(Eigen::Vector3d(0.4, -0.3, 0.1), {0.05, -0.05, 0.2});
  const Eigen::Isometry3d shift(Eigen::Translation3d(64, -128, 32));
  const CoarseEstimate here = searchByOverlap(scans.target, scans.source, guess);
  const CoarseEstimate there =
      searchByOverlap(transformed(scans.target, shift), scans.source, shift * guess);
  EXPECT_EQ(there.status, here.status);
  const auto off = distanceBetween(shift * here.T_target_source, there.T_target_source);
  EXPECT_LT(off.translation, 1e-9);
  EXPECT_LT(off.rotation, 1e-7);
  EXPECT_NEAR(there.score, here.score, 2.0 / 600); // cubes at a border, by rounding
}

TEST(OverlapSearch, DoesNotChooseAPlaceAlongACorridor)
{
  Random random(3);
  Points corridor; // floor and two walls, 2 m wide, longer than the window
  for (int i = 0; i < 30000; ++i) {
    const double along = random.uniform(-20, 20), across = random.uniform(-1, 1);
    const double up = random.uniform(0, 2);
    corridor.push_back((i % 3 == 0 ? Eigen::Vector3d(along, across, 0)
                                   : Eigen::Vector3d(along, i % 3 == 1 ? 1 : -1, up))
                           .cast<float>());
  }
  const CoarseEstimate found = searchByOverlap(corridor, corridor, kNoGuess);
  EXPECT_EQ(found.status, Status::kRankDeficient);
  EXPECT_GT(found.ambiguity(), 0.95);
  EXPECT_GT(found.score, 0.9);
}

TEST(OverlapSearch, DoesNotChooseAPlaceOnAPlane)
{
  Random random(3);
  Points plane, part;
  for (int i = 0; i < 20000; ++i)
    plane.emplace_back(random.uniform(-5, 5), random.uniform(-5, 5), 0);
  for (const auto& p : plane)
    if (p.norm() < 2)
      part.push_back(p);
  EXPECT_EQ(searchByOverlap(plane, part, kNoGuess).status, Status::kRankDeficient);
}

TEST(OverlapSearch, RefusesScansThatDoNotMeet)
{
  const OverlappingScans scans(0.05);
  const Eigen::Isometry3d far(Eigen::Translation3d(50, 0, 0));
  const CoarseEstimate found = searchByOverlap(scans.target, scans.source, far);
  EXPECT_EQ(found.status, Status::kTooFewPairs);
  EXPECT_TRUE(sameBits(found.T_target_source, far));
  EXPECT_EQ(found.score, 0);
}

TEST(OverlapSearch, ReturnsTheGuessWithoutEnoughPoints)
{
  const Points none, one = {{1, 2, 3}}, not_finite(9, Eigen::Vector3f::Constant(kNan));
  const Points repeated(50, Eigen::Vector3f(1, 2, 3));
  const OverlappingScans scans(0.1);
  const Eigen::Isometry3d guess = planarPose(1, 2, 0.3);
  for (const Points* few : {&none, &one, &not_finite, &repeated}) {
    for (const bool is_target : {true, false}) {
      const CoarseEstimate found = searchByOverlap(
          is_target ? *few : scans.target, is_target ? scans.source : *few, guess);
      EXPECT_EQ(found.status, Status::kTooFewPairs);
      EXPECT_TRUE(sameBits(found.T_target_source, guess));
    }
  }
}

TEST(OverlapSearch, LeavesOutPointsThatAreNotFinite)
{
  const OverlappingScans scans(0.05);
  const Eigen::Isometry3d guess =
      scans.guess(Eigen::Vector3d(0.3, 0.2, 0), {0, 0, 0.1});
  Points target = scans.target, source = scans.source;
  target.insert(target.begin() + 10, Eigen::Vector3f(kNan, 0, 0));
  source.insert(source.begin(), Eigen::Vector3f(0, kInfinity, 0));
  const CoarseEstimate expected = searchByOverlap(scans.target, scans.source, guess);
  const CoarseEstimate found = searchByOverlap(target, source, guess);
  EXPECT_TRUE(sameBits(found.T_target_source, expected.T_target_source));
  EXPECT_EQ(found.score, expected.score);
}

TEST(OverlapSearch, RefusesBadOptions)
{
  const auto with = [](auto change) {
    OverlapSearchOptions options;
    change(options);
    return refusal(options);
  };
  EXPECT_EQ(refusal({}), "");
  EXPECT_EQ(with([](auto& o) { o.translation_window = Eigen::Vector3d(1, 0, 1); }),
            "translation_window = 1 0 1, but must be finite and > 0");
  EXPECT_EQ(with([](auto& o) { o.rotation_window.x() = -1; }),
            "rotation_window = -1 0.1 0.35, but must be finite and > 0");
  EXPECT_EQ(with([](auto& o) { o.rotation_window.z() = 4; }),
            "rotation_window = 0.1 0.1 4, but must be <= pi");
  EXPECT_EQ(with([](auto& o) { o.first_cube = 0; }),
            "first_cube = 0, but must be finite and > 0");
  EXPECT_EQ(with([](auto& o) { o.last_cube = INFINITY; }),
            "last_cube = inf, but must be finite and > 0");
  EXPECT_EQ(with([](auto& o) { o.max_cubes = 2; }), "max_cubes = 2, but must be >= 3");
  EXPECT_EQ(with([](auto& o) { o.max_candidates = 1; }),
            "max_candidates = 1, but must be >= 2");
  EXPECT_EQ(with([](auto& o) { o.min_score = 1.5; }),
            "min_score = 1.5, but must be in [0, 1]");
  EXPECT_EQ(with([](auto& o) { o.max_ambiguity = NAN; }),
            "max_ambiguity = nan, but must be in [0, 1]");
  Eigen::Isometry3d scaled = kNoGuess;
  scaled.linear() *= 2;
  EXPECT_EQ(badArgumentOf([&] { searchByOverlap({}, {}, scaled); }),
            "guess = 2 0 0 0; 0 2 0 0; 0 0 2 0; 0 0 0 1, but must be a rigid motion");
}
