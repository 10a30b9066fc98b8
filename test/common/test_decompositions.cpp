// SPDX-License-Identifier: BSD-3-Clause
// The decompositions that are compiled once give Eigen's own bits.
#include <pcl6d/common/decompositions.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <gtest/gtest.h>

using namespace pcl6d;

namespace {
constexpr int kTrials = 50;

template <int Size>
using Square = Eigen::Matrix<double, Size, Size>;

template <int Size>
Square<Size>
randomSymmetric(int rows)
{
  const Square<Size> A = Square<Size>::Random(rows, rows);
  return A * A.transpose();
}

template <int Size>
void
expectEigensBits(int rows = Size)
{
  for (int trial = 0; trial < kTrials; ++trial) {
    const Square<Size> A = randomSymmetric<Size>(rows);
    const Eigen::SelfAdjointEigenSolver<Square<Size>> solver(A + A.transpose());
    const auto eigen = symmetricEigen<Size>(A + A.transpose());
    EXPECT_EQ(eigen.values, solver.eigenvalues());
    EXPECT_EQ(eigen.vectors, solver.eigenvectors());
  }
}

template <int Size>
void
expectCholeskysBits()
{
  for (int trial = 0; trial < kTrials; ++trial) {
    const Square<Size> A = randomSymmetric<Size>(Size);
    const Eigen::Matrix<double, Size, 1> b = Eigen::Matrix<double, Size, 1>::Random();
    const Eigen::Matrix<double, Size, 1> x = A.ldlt().solve(-b);
    EXPECT_EQ(solveSymmetric<Size>(A, -b), x);
    EXPECT_TRUE(isPositiveDefinite(A));
    EXPECT_FALSE(isPositiveDefinite<Size>(-A));
    const Eigen::SelfAdjointEigenSolver<Square<Size>> solver(A, Eigen::EigenvaluesOnly);
    EXPECT_EQ(symmetricEigenvalues(A), solver.eigenvalues());
  }
}
} // namespace

TEST(Decompositions, EigenvaluesAndVectorsOfSymmetricMatrices)
{
  expectEigensBits<2>();
  expectEigensBits<3>();
  expectEigensBits<4>();
  expectEigensBits<6>();
  expectEigensBits<7>();
  expectEigensBits<Eigen::Dynamic>(3);
}

TEST(Decompositions, SymmetricSystems)
{
  expectCholeskysBits<3>();
  expectCholeskysBits<6>();
}

TEST(Decompositions, InverseAndSingularValues)
{
  for (int trial = 0; trial < kTrials; ++trial) {
    const Square<6> A = Square<6>::Random();
    EXPECT_EQ(inverted(A), A.inverse());
    const Eigen::Matrix3d B = Eigen::Matrix3d::Random();
    const Eigen::JacobiSVD<Eigen::Matrix3d> solver(
        B.transpose() * B, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const auto [U, values, V] = singularValues(B.transpose() * B);
    EXPECT_EQ(U, solver.matrixU());
    EXPECT_EQ(values, solver.singularValues());
    EXPECT_EQ(V, solver.matrixV());
  }
}
