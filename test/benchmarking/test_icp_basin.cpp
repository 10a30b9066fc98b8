// SPDX-License-Identifier: BSD-3-Clause
#include "room_pair.h"
#include "support/bits.h"

#include <pcl6d/common/pose.h>

#include <algorithm>
#include <cmath>

using Eigen::Isometry3d;
using pcl6d::evaluateIcpBasin;
using pcl6d::IcpBasin;
using pcl6d::IcpBasinOptions;
using pcl6d::IcpBasinRow;
using pcl6d::IcpBasinRun;
using pcl6d::IcpVariant;
using pcl6d::Metric;
using pcl6d::Points;
using pcl6d::SearchMethod;
using pcl6d::test::evaluateRoom;
using pcl6d::test::kNan;
using pcl6d::test::nearStarts;
using pcl6d::test::room;
using pcl6d::test::RoomPair;
using pcl6d::test::sameBits;

namespace {
constexpr SearchMethod kExact[] = {SearchMethod::kRemembered,
                                   SearchMethod::kKdTree,
                                   SearchMethod::kCachedTree,
                                   SearchMethod::kOctree,
                                   SearchMethod::kBruteForce};

void
expectSameRuns(const IcpBasinRow& a, const IcpBasinRow& b)
{
  ASSERT_EQ(a.runs.size(), b.runs.size());
  for (std::size_t i = 0; i < a.runs.size(); ++i) {
    SCOPED_TRACE("run " + std::to_string(i));
    EXPECT_TRUE(sameBits(a.runs[i].T_target_source, b.runs[i].T_target_source));
    EXPECT_EQ(a.runs[i].correct, b.runs[i].correct);
    EXPECT_EQ(a.runs[i].iterations, b.runs[i].iterations);
    EXPECT_EQ(a.runs[i].pairs, b.runs[i].pairs);
    EXPECT_EQ(a.runs[i].rms, b.runs[i].rms);
    EXPECT_EQ(a.runs[i].stop, b.runs[i].stop);
  }
  EXPECT_EQ(a.summary.success, b.summary.success);
  EXPECT_EQ(a.summary.position_rms, b.summary.position_rms);
  EXPECT_EQ(a.summary.orientation_rms, b.summary.orientation_rms);
  EXPECT_EQ(a.summary.iterations, b.summary.iterations);
}
} // namespace

TEST(IcpBasin, FindsBackFromNearby)
{
  for (const Metric metric : {Metric::kPoint, Metric::kPlane, Metric::kGicp}) {
    SCOPED_TRACE(toString(metric));
    const IcpVariant variant{metric,
                             metric == Metric::kPoint ? "quaternion" : "helix",
                             SearchMethod::kRemembered};
    const IcpBasin basin = evaluateRoom({variant}, nearStarts());
    ASSERT_EQ(basin.rows.size(), 1u);
    EXPECT_EQ(basin.best[0].doubt, "");
    const auto& s = basin.rows[0].summary;
    EXPECT_EQ(s.runs, 27u);
    EXPECT_EQ(s.correct, 27u);
    EXPECT_EQ(s.success, 1);
    EXPECT_GT(s.iterations, 5);
    EXPECT_GT(s.seconds, 0);
    EXPECT_EQ(s.reach_xy, std::sqrt(2 * 0.2 * 0.2));
    EXPECT_EQ(s.reach_yaw, 0.05);
    // Noise of 5 mm and 1 m between rays at 10 m: the pose is good to a few centimetres.
    const auto error =
        pcl6d::distanceBetween(basin.best[0].result.T_target_source, room().truth);
    EXPECT_LT(error.translation, 0.1);
    EXPECT_LT(error.rotation, 0.03);
  }
}

TEST(IcpBasin, IsTheSameForAllExactSearches)
{
  IcpBasinOptions o = nearStarts();
  o.offset_xy = 2; // so that some runs fail
  o.steps_yaw = 1;
  o.icp.max_iterations = 60;
  for (const Metric metric : {Metric::kPoint, Metric::kPlane}) {
    SCOPED_TRACE(toString(metric));
    std::vector<IcpVariant> variants;
    for (const SearchMethod search : kExact)
      variants.push_back({metric, "helix", search});
    const IcpBasin basin = evaluateRoom(variants, o);
    ASSERT_EQ(basin.rows.size(), std::size(kExact));
    EXPECT_GT(basin.rows[0].summary.success, 0.1) << "or the test would tell nothing";
    EXPECT_LT(basin.rows[0].summary.success, 0.95);
    for (const IcpBasinRow& row : basin.rows) {
      SCOPED_TRACE(toString(row.variant.search));
      expectSameRuns(row, basin.rows[0]);
    }
  }
}

TEST(IcpBasin, IsTheSameForAnyNumberOfThreads)
{
  IcpBasinOptions o = nearStarts();
  const std::vector<IcpVariant> variants = {
      {Metric::kPoint, "quaternion", SearchMethod::kApproximate},
      {Metric::kGicp, "linear", SearchMethod::kRemembered}};
  o.num_threads = 1;
  const IcpBasin alone = evaluateRoom(variants, o);
  o.num_threads = 3;
  const IcpBasin together = evaluateRoom(variants, o);
  ASSERT_EQ(alone.rows.size(), 2u);
  ASSERT_EQ(together.rows.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    expectSameRuns(alone.rows[i], together.rows[i]);
    EXPECT_EQ(alone.best[i].sigma_position, together.best[i].sigma_position);
  }
}

TEST(IcpBasin, CallsRunsCorrectThatEndWithinThreeSigma)
{
  IcpBasinOptions o = nearStarts();
  o.offset_xy = 1.5;
  o.offset_yaw = 0.6;
  o.steps_xy = 5;
  const IcpBasin basin = evaluateRoom({IcpVariant()}, o);
  const auto& best = basin.best.at(0);
  const auto& runs = basin.rows.at(0).runs;
  ASSERT_EQ(runs.size(), 75u);
  std::size_t correct = 0, i = 0;
  double squares = 0, wrong_from = 1e9;
  for (const IcpBasinRun& run : runs) {
    const auto start = pcl6d::icpStarts(o)[i++];
    EXPECT_EQ(run.start.x, start.x);
    EXPECT_EQ(run.start.yaw, start.yaw);
    const auto error =
        pcl6d::distanceBetween(best.result.T_target_source, run.T_target_source);
    EXPECT_EQ(run.position_error, error.translation);
    EXPECT_EQ(run.orientation_error, error.rotation);
    EXPECT_EQ(run.correct,
              error.translation <= 3 * best.sigma_position &&
                  error.rotation <= 3 * best.sigma_orientation);
    correct += run.correct;
    squares += run.correct ? error.translation * error.translation : 0;
    if (!run.correct && start.yaw == 0)
      wrong_from = std::min(wrong_from, std::hypot(start.x, start.y));
  }
  const auto& s = basin.rows[0].summary;
  EXPECT_EQ(s.correct, correct);
  EXPECT_GT(correct, 0u);
  EXPECT_LT(correct, runs.size());
  EXPECT_NEAR(s.position_rms, std::sqrt(squares / correct), 1e-12);
  ASSERT_TRUE(s.reach_xy);
  EXPECT_LT(*s.reach_xy, wrong_from);
  EXPECT_EQ(runs[37].start.x, 0);
  EXPECT_TRUE(runs[37].correct) << "the best pose itself";
}

TEST(IcpBasin, TakesSigmaFromTheCovarianceUnlessItIsGivenOrTooSmall)
{
  IcpBasinOptions o = nearStarts();
  o.steps_xy = o.steps_yaw = 1;
  o.min_sigma_position = o.min_sigma_orientation = 1e-9;
  const auto derived = evaluateRoom({IcpVariant()}, o).best.at(0);
  ASSERT_TRUE(derived.result.covariance);
  const auto variances = derived.result.covariance->diagonal();
  EXPECT_DOUBLE_EQ(derived.sigma_position,
                   std::sqrt(variances[0] + variances[1] + variances[2]));
  EXPECT_DOUBLE_EQ(derived.sigma_orientation,
                   std::sqrt(variances[3] + variances[4] + variances[5]));

  o.min_sigma_position = 0.5;
  o.min_sigma_orientation = 0.25;
  EXPECT_EQ(evaluateRoom({IcpVariant()}, o).best.at(0).sigma_position, 0.5);
  EXPECT_EQ(evaluateRoom({IcpVariant()}, o).best.at(0).sigma_orientation, 0.25);
  o.sigma_position = 0.125;
  o.sigma_orientation = 0.0625;
  EXPECT_EQ(evaluateRoom({IcpVariant()}, o).best.at(0).sigma_position, 0.125);
  EXPECT_EQ(evaluateRoom({IcpVariant()}, o).best.at(0).sigma_orientation, 0.0625);
}

TEST(IcpBasin, MatchesAScanWithItselfWithoutAnyError)
{
  const Points& scan = room().target;
  const IcpBasin basin = evaluateIcpBasin(
      scan, scan, Isometry3d::Identity(), {IcpVariant()}, nearStarts());
  EXPECT_EQ(basin.best.at(0).sigma_position, nearStarts().min_sigma_position);
  EXPECT_EQ(basin.rows.at(0).summary.success, 1);
}

TEST(IcpBasin, SkipsPointsThatAreNotFinite)
{
  RoomPair holes = room();
  holes.target.insert(holes.target.begin() + 100, {kNan, 0, 0});
  holes.source.push_back({0, kNan, 0});
  const IcpBasin basin = evaluateIcpBasin(
      holes.target, holes.source, holes.truth, {IcpVariant()}, nearStarts());
  EXPECT_EQ(basin.rows.at(0).summary.success, 1);
}
