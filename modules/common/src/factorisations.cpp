// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>

// Function templates have the visibility of the place of instantiation.
namespace PCL6D_EXPORTS pcl6d {

namespace {
template <int Size>
using Square = Eigen::Matrix<double, Size, Size>;
template <int Size>
using Column = Eigen::Matrix<double, Size, 1>;
} // namespace

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
  // Bits and speed equal to fixed size, for half the compile time.
  return Eigen::MatrixXd(A).inverse();
}

SingularValues
singularValues(const Eigen::Matrix3d& A)
{
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(
      A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

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
