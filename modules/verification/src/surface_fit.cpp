// SPDX-License-Identifier: BSD-3-Clause
#include "surface_directions.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using verification::FitDirections;
using verification::Matrix6;
using verification::MeasuredTwice;
using verification::PairGrids;
using verification::SurfacePair;

namespace {
/** Edge of the wide cubes, in cubes of the options: larger than most surfaces of a room. */
constexpr double kWideCubes = 4;

/** \return the standard deviation of the residuals after the step, from their median:
 * edges have no influence */
double
usualResidual(const std::vector<double>& left)
{
  constexpr double kOfMedian = 1.4826; // of a normal distribution
  std::vector<double> sizes;
  sizes.reserve(left.size());
  for (const double residual : left)
    sizes.push_back(std::abs(residual));
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return kOfMedian * *middle;
}

/** \return variances along the axes, of the error common to the pairs. Points are denser near the
 * scanner, so pairs of rough surfaces pull the scans together by sliding along surfaces oblique to
 * the motion: nearly every pair in a gallery, hardly any pair in a room with square walls.
 * \param[in] size [m] of the error of a pair */
Twist
sharedVariances(const FitDirections& directions,
                const MeasuredTwice& measured,
                double size)
{
  Twist pull = Twist::Zero();
  for (const Twist& along : measured.one)
    for (int k = 0; k < 6; ++k) {
      const double cosine = std::min(1.0, std::abs(along(k)));
      pull(k) += cosine * std::sqrt(1 - cosine * cosine);
    }
  return (size * directions.inverse.cwiseProduct(pull)).cwiseAbs2();
}

/** \return the terms of the pairs times their residuals */
std::vector<Twist>
gradientsOf(std::vector<Twist> terms, const std::vector<double>& residuals)
{
  for (std::size_t i = 0; i < terms.size(); ++i)
    terms[i] *= residuals[i];
  return terms;
}

/** \return what copies of pairs add to the variance of a sum of equal terms, in units of the
 * squared cosines: n copies have n times the variance of n pairs */
Twist
ofCopies(const std::vector<SurfacePair>& pairs, const MeasuredTwice& measured)
{
  Twist sum = Twist::Zero();
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (pairs[i].copies > 1)
      sum += (pairs[i].copies - 1) * measured.one[i].cwiseAbs2();
  return sum;
}

/** Fills both covariances. */
void
addCovariances(const std::vector<SurfacePair>& pairs,
               double cube,
               double shared_error,
               const FitDirections& directions,
               SurfaceFit& fit)
{
  const PairGrids grids = gridsOf(pairs, fit.centroid, cube);
  const MeasuredTwice measured =
      measuredTwice(pairs, fit.centroid, directions.axes, grids);
  std::vector<double> left;
  left.reserve(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i)
    left.push_back(pairs[i].residual - measured.one[i].dot(directions.step));
  const auto count = static_cast<double>(pairs.size());
  // Few cubes may show no error in a direction: take a tenth of the independent error.
  const Twist least = 0.1 * fit.residual * fit.residual *
                      (count * directions.mean_square + ofCopies(pairs, measured));
  Twist open = Twist::Zero(),
        weight; // the uncertainty of an open direction: the spread
  for (int k = 0; k < 6; ++k) {
    open(k) = directions.inverse(k) > 0 ? 0 : fit.spread * fit.spread;
    weight(k) = directions.inverse(k) > 0
                    ? 1 / (count * measured.weight(k, directions.mean_square(k)))
                    : 0;
  }
  const Twist shared =
      sharedVariances(directions, measured, shared_error * usualResidual(left));
  Matrix6 spread = sumOfCubes(gradientsOf(measured.one, left), grids, 6);
  spread.diagonal() += least;
  const auto& V = directions.axes;
  const auto inverse = directions.inverse.asDiagonal();
  Matrix6 C = inverse * spread * inverse;
  C.diagonal() += open + shared;
  fit.covariance = V * C * V.transpose();
  C = weight.asDiagonal() *
      gradientCovariance(gradientsOf(measured.other, left),
                         grids,
                         gridsOf(pairs, fit.centroid, kWideCubes * cube),
                         least) *
      weight.asDiagonal();
  C.diagonal() += open;
  fit.pose_covariance = V * C * V.transpose();
}

} // namespace

void
SurfaceFitOptions::validate() const
{
  require(std::isfinite(max_distance) && max_distance > 0,
          "max_distance",
          max_distance,
          "finite and > 0");
  require(points > 0, "points", points, "> 0");
  require(std::isfinite(cube_voxels) && cube_voxels > 0,
          "cube_voxels",
          cube_voxels,
          "finite and > 0");
  require(std::isfinite(shared_error) && shared_error >= 0,
          "shared_error",
          shared_error,
          "finite and >= 0");
}

double
SurfaceFit::displacement() const
{
  return std::sqrt(step.head<3>().squaredNorm() +
                   step.tail<3>().squaredNorm() * spread * spread * 2 / 3);
}

double
SurfaceFit::deviation() const
{
  return std::sqrt(covariance.topLeftCorner<3, 3>().trace() +
                   covariance.bottomRightCorner<3, 3>().trace() * spread * spread * 2 /
                       3);
}

double
SurfaceFit::mahalanobisSq() const
{
  if (pairs < 6)
    return 0;
  Twist unit = Twist::Ones();
  unit.tail<3>().setConstant(spread > 0 ? 1 / spread : 1);
  const Twist scaled = step.cwiseQuotient(unit);
  const Matrix6 C =
      unit.cwiseInverse().asDiagonal() * covariance * unit.cwiseInverse().asDiagonal();
  const auto eigen = symmetricEigen<6>(C);
  const Twist along = eigen.vectors.transpose() * scaled;
  double sum = 0;
  for (int k = 0; k < 6; ++k)
    if (eigen.values(k) > 0)
      sum += along(k) * along(k) / eigen.values(k);
  return sum;
}

SurfaceFit
verification::fitOf(const SurfacePairs& found, const SurfaceFitOptions& options)
{
  SurfaceFit fit;
  fit.pairs = found.evenly;
  if (found.looked_at > 0)
    fit.overlap = static_cast<double>(fit.pairs) / static_cast<double>(found.looked_at);
  constexpr std::size_t kLeastPairs = 12; // two for each direction
  if (fit.pairs < kLeastPairs)
    return fit;
  const PairExtent extent = extentOf(found.pairs);
  fit.centroid = extent.centroid;
  fit.spread = extent.spread;
  fit.residual = extent.residual;
  const FitDirections directions = directionsOf(found.pairs, extent);
  fit.open_directions = directions.open();
  fit.step = directions.axes * directions.step;
  if (options.covariance)
    addCovariances(found.pairs,
                   options.cube_voxels * found.voxel,
                   options.shared_error,
                   directions,
                   fit);
  return fit;
}

SurfaceFit
fitSurfaces(const VerifiedScan& first,
            const VerifiedScan& second,
            const Eigen::Isometry3d& T_first_second,
            const SurfaceFitOptions& options)
{
  return verification::fitOf(
      verification::pairSurfaces(first, second, T_first_second, options), options);
}

} // namespace pcl6d
