// SPDX-License-Identifier: BSD-3-Clause
// Votes that come and go are those of all that voted and did not take them back.
#include "detectors/hough_votes.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/random.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace {
using pcl6d::AccumulatorBall;
using pcl6d::plane_segmentation::HoughCell;
using pcl6d::plane_segmentation::HoughVoteOptions;
using pcl6d::plane_segmentation::HoughVotes;
using pcl6d::plane_segmentation::SurfelColumns;
using pcl6d::plane_segmentation::voteForAll;

SurfelColumns
randomSurfels(std::size_t size, std::uint64_t seed)
{
  pcl6d::Random random(seed);
  SurfelColumns surfels;
  for (std::size_t i = 0; i < size; ++i) {
    const Eigen::Vector3d normal(random.normal(), random.normal(), random.normal());
    const Eigen::Vector3d point(
        random.uniform(0, 9), random.uniform(0, 9), random.uniform(0, 3));
    surfels.append(point.cast<float>(), normal.normalized().cast<float>(), 0.01f);
  }
  return surfels;
}

void
append(SurfelColumns& all, const SurfelColumns& more)
{
  for (std::size_t i = 0; i < more.size(); ++i)
    all.append(more.point(i), more.normal(i), more.reach[i]);
}

void
expectSame(const std::vector<HoughCell>& a, const std::vector<HoughCell>& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].direction, b[i].direction) << i;
    ASSERT_EQ(a[i].offset, b[i].offset) << i;
    ASSERT_EQ(a[i].votes, b[i].votes) << i;
  }
}

TEST(HoughVotes, OfBatchesAreThoseOfAllTogether)
{
  const AccumulatorBall ball(20);
  const SurfelColumns first = randomSurfels(500, 1), second = randomSurfels(300, 2);
  SurfelColumns both = first;
  append(both, second);
  HoughVoteOptions options;
  options.min_votes = 3;
  HoughVotes votes(ball, options);
  votes.add(first);
  votes.add(second);
  expectSame(votes.cells(options.min_votes), voteForAll(both, ball, options));
  ASSERT_FALSE(votes.cells(options.min_votes).empty());
}

TEST(HoughVotes, TakenBackLeaveThoseOfTheOthers)
{
  const AccumulatorBall ball(20);
  const SurfelColumns first = randomSurfels(500, 1), second = randomSurfels(300, 2);
  HoughVotes votes(ball, {});
  votes.add(first);
  votes.add(second);
  votes.remove(first);
  expectSame(votes.cells(1), voteForAll(second, ball, {}));
  std::uint64_t total = 0, cells = 0;
  for (std::size_t direction = 0; direction < ball.size(); ++direction)
    total += votes.votesFor(direction);
  for (const HoughCell& cell : votes.cells(1))
    cells += cell.votes;
  EXPECT_EQ(total, cells);
  votes.remove(second);
  EXPECT_TRUE(votes.cells(1).empty());
}

TEST(HoughVotes, OfNoneAreNone)
{
  const AccumulatorBall ball(20);
  HoughVotes votes(ball, {});
  votes.add({});
  EXPECT_TRUE(votes.cells(1).empty());
  EXPECT_EQ(votes.votesFor(0), 0u);
}

TEST(HoughVotes, OfFarPointsNeedLargeCells)
{
  const AccumulatorBall ball(20);
  SurfelColumns surfels = randomSurfels(10, 3);
  surfels.append({9e8F, 0, 0}, {1, 0, 0}, 0.01F);
  HoughVoteOptions options;
  EXPECT_THROW(voteForAll(surfels, ball, options), pcl6d::BadArgument);
  options.offset_cell = 1e4;
  EXPECT_FALSE(voteForAll(surfels, ball, options).empty());
}
} // namespace
