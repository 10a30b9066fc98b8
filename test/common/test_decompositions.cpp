// SPDX-License-Identifier: BSD-3-Clause
// The decompositions that are compiled once, by the equations that they solve.
#include <pcl6d/common/decompositions.h>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace pcl6d;

namespace {
constexpr int kMatrices = 50;
// Of matrices whose entries are below Size, over a hundred roundings.
constexpr double kRounding = 200 * 7 * std::numeric_limits<double>::epsilon();
using Eigen::MatrixXd;
using Eigen::VectorXd;

template <int Size>
using Square = Eigen::Matrix<double, Size, Size>;

template <int Size>
Square<Size>
randomPositive(int rows = Size)
{
  const MatrixXd A = MatrixXd::Random(rows, rows);
  return A * A.transpose();
}

/** A V = V diag(values), V^T V = 1, ascending values. */
void
expectDecomposed(const MatrixXd& A, const VectorXd& values, const MatrixXd& V)
{
  ASSERT_EQ(values.size(), A.rows());
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    EXPECT_LT((A * V.col(i) - values(i) * V.col(i)).norm(), kRounding);
    for (Eigen::Index j = 0; j <= i; ++j)
      EXPECT_NEAR(V.col(i).dot(V.col(j)), i == j, kRounding);
    if (i > 0) {
      EXPECT_GE(values(i), values(i - 1));
    }
  }
}

template <int Size>
void
expectDecomposed(int rows = Size)
{
  for (int trial = 0; trial < kMatrices; ++trial) {
    const Square<Size> A = randomPositive<Size>(rows);
    const auto eigen = symmetricEigen<Size>(A);
    expectDecomposed(A, eigen.values, eigen.vectors);
  }
}

template <int Size>
void
expectSolved()
{
  for (int trial = 0; trial < kMatrices; ++trial) {
    const Square<Size> A = randomPositive<Size>() + Square<Size>::Identity();
    const Eigen::Matrix<double, Size, 1> b = Eigen::Matrix<double, Size, 1>::Random();
    EXPECT_LT((A * solveSymmetric<Size>(A, b) - b).norm(), kRounding);
    EXPECT_TRUE(isPositiveDefinite(A));
    EXPECT_FALSE(isPositiveDefinite<Size>(-A));
    EXPECT_LT((symmetricEigenvalues(A) - symmetricEigen(A).values).norm(), kRounding);
  }
}
} // namespace

TEST(Decompositions, EigenvaluesAndVectorsOfSymmetricMatrices)
{
  expectDecomposed<2>();
  expectDecomposed<3>();
  expectDecomposed<4>();
  expectDecomposed<6>();
  expectDecomposed<7>();
  expectDecomposed<Eigen::Dynamic>(3);
  expectDecomposed<Eigen::Dynamic>(1);
}

// Trajectories stay the same to the byte: the kernel whose size is known at run time gives
// what Eigen gives for 6 x 6.
TEST(Decompositions, HaveTheBitsOfEigensKernelsOfFixedSize)
{
  for (int trial = 0; trial < kMatrices; ++trial) {
    const Square<6> A = randomPositive<6>();
    const Eigen::SelfAdjointEigenSolver<Square<6>> solver(A);
    EXPECT_EQ(symmetricEigen(A).values, solver.eigenvalues());
    EXPECT_EQ(symmetricEigen(A).vectors, solver.eigenvectors());
  }
}

TEST(Decompositions, OfMatricesWithEqualOrNoEigenvalues)
{
  const auto unit = symmetricEigen<6>(Square<6>::Identity());
  expectDecomposed(MatrixXd::Identity(6, 6), unit.values, unit.vectors);
  EXPECT_EQ(symmetricEigen<4>(Square<4>::Zero()).values.norm(), 0);
  const Square<6> none = Square<6>::Constant(std::nan(""));
  EXPECT_TRUE(symmetricEigen(none).values.hasNaN());
}

TEST(Decompositions, SymmetricSystems)
{
  expectSolved<3>();
  expectSolved<6>();
}

TEST(Decompositions, InverseAndSingularValues)
{
  for (int trial = 0; trial < kMatrices; ++trial) {
    const Square<6> A = randomPositive<6>() + Square<6>::Identity();
    EXPECT_LT((A * inverted(A) - Square<6>::Identity()).norm(), kRounding);
    const Eigen::Matrix3d B = Eigen::Matrix3d::Random();
    const auto [U, values, V] = singularValues(B);
    EXPECT_LT((U * values.asDiagonal() * V.transpose() - B).norm(), kRounding);
    EXPECT_LT((U.transpose() * U - Eigen::Matrix3d::Identity()).norm(), kRounding);
    EXPECT_LT((V.transpose() * V - Eigen::Matrix3d::Identity()).norm(), kRounding);
    EXPECT_TRUE(values(0) >= values(1) && values(1) >= values(2) && values(2) >= 0);
  }
}
