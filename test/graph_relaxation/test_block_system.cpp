// SPDX-License-Identifier: BSD-3-Clause
#include "block_systems.h"
#include "support/bits.h"

#include <pcl6d/common/error.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <limits>

namespace {
using pcl6d::BlockSystem;
using pcl6d::test::chain;
using pcl6d::test::Couplings;
using pcl6d::test::grid;
using pcl6d::test::Sample;
using pcl6d::test::Shape;
using pcl6d::test::shapes;

// The matrices are well conditioned (below 20): some ulp per eliminated column.
constexpr double kTolerance = 1e-13;

template <int Size>
void
expectDenseSolution(const Shape& shape)
{
  Sample<Size> sample(shape);
  ASSERT_TRUE(sample.system.factorize());
  const Eigen::VectorXd x = sample.stacked(sample.system.solve(sample.right));
  const Eigen::VectorXd b = sample.stacked(sample.right);
  EXPECT_LT((x - sample.dense.ldlt().solve(b)).norm(), kTolerance * b.norm());
  const Eigen::MatrixXd inverse = sample.dense.inverse();
  const auto blocks = sample.system.inverseDiagonals();
  ASSERT_EQ(blocks.size(), shape.size);
  for (std::size_t i = 0; i < blocks.size(); ++i)
    EXPECT_LT((blocks[i] - inverse.block<Size, Size>(Size * i, Size * i)).norm(),
              kTolerance)
        << "block " << i;
}

class BlockSystems : public testing::TestWithParam<Shape> {};
} // namespace

TEST_P(BlockSystems, SolveLikeADenseMatrix)
{
  expectDenseSolution<1>(GetParam());
  expectDenseSolution<3>(GetParam());
  expectDenseSolution<6>(GetParam());
  expectDenseSolution<7>(GetParam());
}

TEST_P(BlockSystems, GiveTheSameBitsForAnyNumberOfThreads)
{
  Sample<6> one(GetParam()), more(GetParam());
  ASSERT_TRUE(one.system.factorize(0.1, 1));
  const auto x = one.system.solve(one.right);
  const auto inverse = one.system.inverseDiagonals();
  for (const unsigned int threads : {2u, 3u, 7u}) {
    ASSERT_TRUE(more.system.factorize(0.1, threads));
    const auto y = more.system.solve(more.right);
    const auto other = more.system.inverseDiagonals();
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_TRUE(pcl6d::test::sameBits(x[i], y[i]));
      EXPECT_TRUE(pcl6d::test::sameBits(inverse[i], other[i]));
    }
  }
}

TEST_P(BlockSystems, TakeNewNumbersIntoTheSameStructure)
{
  Sample<3> sample(GetParam());
  const Sample<3> other(GetParam(), 9);
  ASSERT_TRUE(sample.system.factorize());
  sample.system.setZero();
  for (std::size_t i = 0; i < GetParam().size; ++i)
    sample.system.diagonal(i) = other.dense.block<3, 3>(3 * i, 3 * i);
  for (std::size_t k = 0; k < GetParam().couplings.size(); ++k) {
    const auto [a, b] = GetParam().couplings[k];
    sample.system.coupling(k) = other.dense.block<3, 3>(3 * a, 3 * b);
  }
  ASSERT_TRUE(sample.system.factorize());
  const Eigen::VectorXd b = other.stacked(other.right);
  const Eigen::VectorXd x = sample.stacked(sample.system.solve(other.right));
  EXPECT_LT((x - other.dense.ldlt().solve(b)).norm(), kTolerance * b.norm());
}

INSTANTIATE_TEST_SUITE_P(Shapes,
                         BlockSystems,
                         testing::ValuesIn(shapes()),
                         [](const auto& shape) { return shape.param.name; });

TEST(BlockSystem, ALargeGridSharedAmongThreadsKeepsItsBits)
{
  // Large enough for subtrees and fronts that several threads work on.
  const Shape shape{"Large", 1600, grid(40)};
  Sample<6> sample(shape);
  ASSERT_TRUE(sample.system.factorize(0, 1));
  const auto x = sample.system.solve(sample.right);
  const Eigen::VectorXd b = sample.stacked(sample.right);
  EXPECT_LT((sample.dense * sample.stacked(x) - b).norm(),
            kTolerance * sample.dense.norm() * sample.stacked(x).norm());
  ASSERT_TRUE(sample.system.factorize(0, 4));
  const auto y = sample.system.solve(sample.right);
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_TRUE(pcl6d::test::sameBits(x[i], y[i]));
}

TEST(BlockSystem, DampingScalesTheDiagonal)
{
  Sample<3> sample({"Chain", 4, chain(4)});
  ASSERT_TRUE(sample.system.factorize(0.5));
  Eigen::MatrixXd damped = sample.dense;
  damped.diagonal() *= 1.5;
  const Eigen::VectorXd b = sample.stacked(sample.right);
  const Eigen::VectorXd x = sample.stacked(sample.system.solve(sample.right));
  EXPECT_LT((x - damped.ldlt().solve(b)).norm(), kTolerance * b.norm());
}

TEST(BlockSystem, OnlyTheLowerTriangleOfADiagonalBlockCounts)
{
  Sample<3> sample({"Chain", 4, chain(4)});
  for (std::size_t i = 0; i < 4; ++i)
    sample.system.diagonal(i).triangularView<Eigen::StrictlyUpper>().setConstant(
        std::numeric_limits<double>::quiet_NaN());
  ASSERT_TRUE(sample.system.factorize());
  const Eigen::VectorXd b = sample.stacked(sample.right);
  const Eigen::VectorXd x = sample.stacked(sample.system.solve(sample.right));
  EXPECT_LT((x - sample.dense.ldlt().solve(b)).norm(), kTolerance * b.norm());
}

TEST(BlockSystem, HasNoFactorUnlessPositiveDefinite)
{
  Sample<3> sample({"Grid", 144, grid(12)});
  const auto keep = sample.system.diagonal(77);
  for (const double value : {-1.0, 0.0, 1e-30, 1e300, double(NAN), double(INFINITY)}) {
    SCOPED_TRACE(value);
    sample.system.diagonal(77)(2, 2) = value;
    EXPECT_EQ(sample.system.factorize(), value == 1e300);
    sample.system.diagonal(77) = keep;
    EXPECT_TRUE(sample.system.factorize()) << "and recovers";
  }
  sample.system.coupling(5)(1, 1) = NAN;
  EXPECT_FALSE(sample.system.factorize());
  EXPECT_THROW(sample.system.solve(sample.right), pcl6d::ComputeFailed);
  EXPECT_THROW(sample.system.inverseDiagonals(), pcl6d::ComputeFailed);
}

TEST(BlockSystem, RefusesAGraphWithNothingFixed)
{
  // The Laplacian of a chain is singular, and its last pivot is exactly zero.
  const std::size_t size = 20;
  BlockSystem<1> system(size, chain(size));
  for (std::size_t k = 0; k + 1 < size; ++k)
    system.coupling(k)(0) = -1;
  for (std::size_t i = 0; i < size; ++i)
    system.diagonal(i)(0) = i == 0 || i + 1 == size ? 1 : 2;
  EXPECT_FALSE(system.factorize());
  system.diagonal(0)(0) += 1;
  EXPECT_TRUE(system.factorize());
}

TEST(BlockSystem, MayBeEmpty)
{
  BlockSystem<6> system(0, {});
  EXPECT_TRUE(system.factorize());
  EXPECT_TRUE(system.solve({}).empty());
  EXPECT_TRUE(system.inverseDiagonals().empty());
}

TEST(BlockSystem, RefusesAStructureThatIsNone)
{
  const auto messageOf = [](const Couplings& couplings) -> std::string {
    try {
      BlockSystem<6>(3, couplings);
    } catch (const pcl6d::BadArgument& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(messageOf({{0, 1}, {1, 2}}), "no error");
  EXPECT_EQ(messageOf({{0, 3}}), "coupling (0, 3), but there are only 3 blocks");
  EXPECT_EQ(messageOf({{1, 1}}),
            "coupling (1, 1), but a block is not coupled with itself");
  EXPECT_EQ(messageOf({{0, 1}, {1, 2}, {1, 0}}), "coupling (0, 1) is given twice");
}

TEST(BlockSystem, RefusesARightHandSideOfAnotherSize)
{
  Sample<3> sample({"Chain", 4, chain(4)});
  EXPECT_THROW(sample.system.solve(sample.right), pcl6d::ComputeFailed);
  ASSERT_TRUE(sample.system.factorize());
  sample.right.pop_back();
  EXPECT_THROW(sample.system.solve(sample.right), pcl6d::BadArgument);
}
