// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>

// Function templates take the visibility of where they are instantiated.
namespace PCL6D_EXPORTS pcl6d {

namespace {
template <int Size>
using Square = Eigen::Matrix<double, Size, Size>;
template <int Size>
using Column = Eigen::Matrix<double, Size, 1>;
} // namespace

template <int Size>
SymmetricEigen<Size>
symmetricEigen(const Square<Size>& A)
{
  const Eigen::SelfAdjointEigenSolver<Square<Size>> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template <int Size>
Column<Size>
symmetricEigenvalues(const Square<Size>& A)
{
  return Eigen::SelfAdjointEigenSolver<Square<Size>>(A, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

template <int Size>
Column<Size>
solveSymmetric(const Square<Size>& A, const Column<Size>& b)
{
  return A.ldlt().solve(b);
}

template <int Size>
bool
isPositiveDefinite(const Square<Size>& A)
{
  return A.llt().info() == Eigen::Success;
}

template <int Size>
Square<Size>
inverted(const Square<Size>& A)
{
  return A.inverse();
}

SingularValues
singularValues(const Eigen::Matrix3d& A)
{
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(
      A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

template SymmetricEigen<2>
symmetricEigen(const Square<2>&);
template SymmetricEigen<3>
symmetricEigen(const Square<3>&);
template SymmetricEigen<4>
symmetricEigen(const Square<4>&);
template SymmetricEigen<6>
symmetricEigen(const Square<6>&);
template SymmetricEigen<7>
symmetricEigen(const Square<7>&);
template SymmetricEigen<Eigen::Dynamic>
symmetricEigen(const Square<Eigen::Dynamic>&);
template Column<3>
symmetricEigenvalues(const Square<3>&);
template Column<6>
symmetricEigenvalues(const Square<6>&);
template Column<3>
solveSymmetric(const Square<3>&, const Column<3>&);
template Column<6>
solveSymmetric(const Square<6>&, const Column<6>&);
template bool
isPositiveDefinite(const Square<3>&);
template bool
isPositiveDefinite(const Square<6>&);
template Square<6>
inverted(const Square<6>&);

} // namespace pcl6d
