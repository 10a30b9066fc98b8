// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface_pairs.h"

#include <pcl6d/registration/twist.h>

#include <array>
#include <cstddef>
#include <vector>

/** \file How precisely pairs of surfaces fix a pose: sums over cubes of pairs, whose errors are
 * correlated, and over the normals of both scans, whose errors are independent. */
namespace pcl6d::verification {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/** \return the derivative of a distance along a normal by a motion about the centroid */
Twist
jacobianOf(const Eigen::Vector3d& place,
           const Eigen::Vector3d& normal,
           const Eigen::Vector3d& centroid);

/** \brief Numbers of the cubes that hold the pairs, in a grid. */
struct PairCubes {
  std::vector<std::size_t> of_pair;
  std::size_t count = 0;
};

/** \brief Four grids, shifted by half a cube: sums over cubes are averaged over them. */
using PairGrids = std::array<PairCubes, 4>;

/** \param[in] cube [m] edge */
PairGrids
gridsOf(const std::vector<SurfacePair>& pairs,
        const Eigen::Vector3d& centroid,
        double cube);

/** \return sum g g^T over the cubes of a grid, with the sum g of the terms of a cube, averaged
 * over the grids
 * \param[in] unknowns fitted to the pairs: the factor P / (P - unknowns) for P cubes */
Matrix6
sumOfCubes(const std::vector<Twist>& terms, const PairGrids& grids, int unknowns);

/** \brief Directions of motion as the normals of both scans measure them.
 *
 * The square of a cosine between a motion and an estimated normal is too large by the error of the
 * normal: along a tunnel, normals that err by 6 degrees have a mean square cosine of 0.01. In the
 * product of the cosines of both normals of a pair most of the bias is gone, as different points
 * of different scans are behind them (instrumental variables: O. Reiersol, "Confluence analysis by
 * means of instrumental sets of variables", Arkiv foer Matematik 32A(4), 1945). Not all: normals of
 * edges have any direction, but face the scanner and each other, so their products are positive. */
struct MeasuredTwice {
  /** Along the axes, a row per pair: of the normal, and of the other normal. */
  std::vector<Twist> one, other;
  Twist product = Twist::Zero();   ///< mean product of both cosines
  Twist deviation = Twist::Zero(); ///< its standard deviation, by cubes

  /** \return the number to divide by, per pair, for the motion along an axis: the product, at
   * least its own deviation, at most the mean square cosine of one normal */
  double
  weight(int direction, double mean_square) const;
};

/** \param[in] axes columns: motions about the centroid that move the pairs by 1 m (rms) */
MeasuredTwice
measuredTwice(const std::vector<SurfacePair>& pairs,
              const Eigen::Vector3d& centroid,
              const Matrix6& axes,
              const PairGrids& grids);

/** \return the covariance, along the axes, of the sum of the gradients of all pairs
 * \param[in] gradients of the pairs along the axes \param[in] narrow grids of cubes within which
 * errors are correlated \param[in] wide grids of larger cubes, for errors along whole surfaces; the
 * grids with the larger errors count
 * \param[in] least variance that counts in each direction */
Matrix6
gradientCovariance(const std::vector<Twist>& gradients,
                   const PairGrids& narrow,
                   const PairGrids& wide,
                   const Twist& least);

} // namespace pcl6d::verification
