// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/random.h>
#include <pcl6d/plane_segmentation/accumulator_ball.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {
using pcl6d::AccumulatorBall;

Eigen::Vector3d
randomDirection(pcl6d::Random& random)
{
  return Eigen::Vector3d(random.normal(), random.normal(), random.normal())
      .normalized();
}

Eigen::Vector3d
direction(double polar, double turn)
{
  return {std::cos(turn) * std::sin(polar),
          std::sin(turn) * std::sin(polar),
          std::cos(polar)};
}

bool
contains(const std::vector<std::size_t>& cells, std::size_t cell)
{
  return std::binary_search(cells.begin(), cells.end(), cell);
}

class Slices : public testing::TestWithParam<int> {};

TEST_P(Slices, CutTheSphereIntoCellsOfNearlyEqualArea)
{
  const AccumulatorBall ball(GetParam());
  double sum = 0, smallest = 100, largest = 0;
  for (std::size_t cell = 0; cell < ball.size(); ++cell) {
    sum += ball.area(cell);
    smallest = std::min(smallest, ball.area(cell));
    largest = std::max(largest, ball.area(cell));
  }
  EXPECT_NEAR(sum, 4 * M_PI, 1e-9);
  EXPECT_LE(largest / smallest, 1.10);
}

TEST_P(Slices, KnowTheCellOfEachCentre)
{
  const AccumulatorBall ball(GetParam());
  for (std::size_t cell = 0; cell < ball.size(); ++cell) {
    EXPECT_NEAR(ball.centre(cell).norm(), 1, 1e-12);
    ASSERT_EQ(ball.cellOf(ball.centre(cell)), cell);
  }
}

TEST_P(Slices, HaveNeighboursThatTouch)
{
  const AccumulatorBall ball(GetParam());
  const double width = M_PI / GetParam();
  for (std::size_t cell = 0; cell < ball.size(); ++cell) {
    const auto neighbours = ball.neighbours(cell);
    EXPECT_GE(neighbours.size(), 5u);
    EXPECT_FALSE(contains(neighbours, cell));
    for (const auto other : neighbours) {
      EXPECT_TRUE(contains(ball.neighbours(other), cell));
      // Two cells that touch at a corner: half a diagonal each, a bit more near poles.
      EXPECT_LT(std::acos(ball.centre(cell).dot(ball.centre(other))), 1.8 * width);
    }
  }
}

TEST_P(Slices, MakeAllThatTouchNeighbours)
{
  const AccumulatorBall ball(GetParam());
  pcl6d::Random random(2);
  int crossed = 0;
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3d a = randomDirection(random);
    const Eigen::Vector3d step = 0.01 * M_PI / GetParam() * randomDirection(random);
    const std::size_t from = ball.cellOf(a), to = ball.cellOf((a + step).normalized());
    if (from == to)
      continue;
    ++crossed;
    EXPECT_TRUE(contains(ball.neighbours(from), to)) << a.transpose();
  }
  EXPECT_GT(crossed, 100);
}
INSTANTIATE_TEST_SUITE_P(Counts, Slices, testing::Values(30, 45, 90));

TEST(AccumulatorBall, HasAboutAsManyCellsAsThePaper) // which counts 2571
{
  EXPECT_NEAR(static_cast<double>(AccumulatorBall(45).size()), 2571, 30);
}

TEST(AccumulatorBall, HasOneRoundCellAtEachPole)
{
  const AccumulatorBall ball;
  const double cap = std::acos(1 - ball.area(0) / (2 * M_PI));
  for (double turn = -3; turn <= 3; turn += 0.1) {
    EXPECT_EQ(ball.cellOf(direction(0.99 * cap, turn)), 0u);
    EXPECT_NE(ball.cellOf(direction(1.01 * cap, turn)), 0u);
    EXPECT_EQ(ball.cellOf(direction(M_PI - 0.99 * cap, turn)), ball.size() - 1);
  }
  EXPECT_EQ(ball.cellOf(Eigen::Vector3d::UnitZ()), 0u);
  EXPECT_EQ(ball.cellOf(Eigen::Vector3d(0, 0, -1)), ball.size() - 1);
}

TEST(AccumulatorBall, IsConnectedAcrossThePolesAndWhereTheTurnWraps)
{
  const AccumulatorBall ball;
  const double cap = std::acos(1 - ball.area(0) / (2 * M_PI));
  const std::size_t here = ball.cellOf(direction(1.1 * cap, 0.3));
  const std::size_t across = ball.cellOf(direction(1.1 * cap, 0.3 + M_PI));
  EXPECT_FALSE(contains(ball.window(here, 1), across));
  EXPECT_TRUE(contains(ball.window(here, 2), across)); // by way of the round cell
  const std::size_t before = ball.cellOf(direction(1.5, -1e-6));
  const std::size_t behind = ball.cellOf(direction(1.5, 1e-6));
  EXPECT_NE(before, behind);
  EXPECT_TRUE(contains(ball.neighbours(before), behind));
}

TEST(AccumulatorBall, HasWindowsOfAsManyCellsAsAGrid)
{
  const AccumulatorBall ball;
  for (const auto& middle : {direction(1.5, 1), direction(0.7, 2), direction(0, 0)}) {
    const auto cells = ball.window(ball.cellOf(middle), 4).size();
    EXPECT_GE(cells, 60u); // a grid: 81; a disc: 50
    EXPECT_LE(cells, 110u);
  }
  EXPECT_EQ(ball.window(7, 0), std::vector<std::size_t>{7});
}

TEST(AccumulatorBall, RefusesTooFewOrTooManySlices)
{
  EXPECT_THROW(AccumulatorBall(1), pcl6d::BadArgument);
  EXPECT_THROW(AccumulatorBall(1001), pcl6d::BadArgument);
}
} // namespace
