// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>

#include <Eigen/Eigenvalues>

#include <type_traits>

// Function templates have the visibility of the place of instantiation.
namespace PCL6D_EXPORTS pcl6d {

namespace {
template <int Size>
using Square = Eigen::Matrix<double, Size, Size>;
template <int Size>
using Column = Eigen::Matrix<double, Size, 1>;

/** Eigen has a special kernel for 3 x 3, and this size is hot. The remaining sizes share the
 * solver of dynamic size: equal bits as fixed size, which costs 10 s and 0.4 GB of compiling
 * per size and saves less than half a microsecond a call. */
template <int Size>
using Solver = Eigen::SelfAdjointEigenSolver<
    std::conditional_t<Size == 3, Square<3>, Eigen::MatrixXd>>;
} // namespace

template <int Size>
SymmetricEigen<Size>
symmetricEigen(const Square<Size>& A)
{
  const Solver<Size> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template <int Size>
Column<Size>
symmetricEigenvalues(const Square<Size>& A)
{
  return Solver<Size>(A, Eigen::EigenvaluesOnly).eigenvalues();
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

} // namespace pcl6d
