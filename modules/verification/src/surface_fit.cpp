// SPDX-License-Identifier: BSD-3-Clause
#include "surface_covariance.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/require.h>
#include <pcl6d/registration/localizability.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using verification::jacobianOf;
using verification::Matrix6;
using verification::MeasuredTwice;
using verification::PairGrids;
using verification::SurfacePair;
using verification::SurfacePairs;

namespace {
/** Edge of the wide cubes, in cubes of the options: larger than most surfaces of a room. */
constexpr double kWideCubes = 4;

/** Collects pairs and counts the tested points. */
class PairCollector {
public:
  explicit PairCollector(const SurfaceFitOptions& options) : options_(options) {}

  /** Pairs points of a scan with surfaces of another scan. */
  void
  add(const VerifiedScan& of,
      const VerifiedScan& in,
      const Eigen::Isometry3d& T_in_of,
      const Eigen::Isometry3d& T_first_in,
      bool is_forward)
  {
    const Points& points = of.surfaces().points();
    const Normals& normals = in.surfaces().normals();
    const std::size_t stride =
        std::max<std::size_t>(1, points.size() / options_.points);
    const auto limit_sq =
        static_cast<float>(options_.max_distance * options_.max_distance);
    for (std::size_t i = stride / 2; i < points.size(); i += stride) {
      const Eigen::Vector3d place = T_in_of * points[i].cast<double>();
      const Neighbour near =
          in.surfaces().tree().nearest(place.cast<float>(), limit_sq);
      ++looked_at;
      if (near.index < 0)
        continue;
      const auto k = static_cast<std::size_t>(near.index);
      if (normals[k].isZero(0) ||
          !faceEachOther(of.surfaces().normals()[i], normals[k], T_in_of))
        continue;
      const Eigen::Vector3d normal = normals[k].cast<double>();
      const Eigen::Vector3d other =
          T_in_of.linear() * of.surfaces().normals()[i].cast<double>();
      const Eigen::Vector3d partner = in.surfaces().points()[k].cast<double>();
      const double missing = normal.dot(partner - place);
      // Opposite direction: the point of the first scan moves, the second stays.
      pairs.push_back({T_first_in * (is_forward ? place : partner),
                       T_first_in.linear() * normal,
                       T_first_in.linear() * other,
                       is_forward ? missing : -missing});
    }
  }

  std::vector<SurfacePair> pairs;
  std::size_t looked_at = 0;

private:
  /** \return whether the normals face the same way: the two faces of a wall are never paired. */
  static bool
  faceEachOther(const Eigen::Vector3f& n,
                const Eigen::Vector3f& m,
                const Eigen::Isometry3d& T)
  {
    return (T.linear() * n.cast<double>()).dot(m.cast<double>()) > 0;
  }

  const SurfaceFitOptions& options_;
};

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

/** Directions of motion, in the order of their eigenvalues, and how the pairs fix them. */
struct FitDirections {
  Matrix6 axes;      ///< columns: motions that move the pairs by 1 m (rms)
  Twist mean_square; ///< of the cosines to the normals of one scan
  Twist inverse;     ///< of the sum of squared cosines; 0: open
  Twist step;        ///< along the axes
};

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

/** \return B^-1/2: from turns with a displacement of the pairs of 1 m (rms) to turns [rad], defined
 * by localizabilityOf(). With the spread of the pairs alone, a roll about the long axis of an
 * elongated scan would count as unobserved, because its levers are short. Turns about a line of
 * pairs use a thickness of a thousandth of its length. */
Eigen::Matrix3d
unitTurns(const std::vector<SurfacePair>& pairs, const SurfaceFit& fit)
{
  if (!(fit.spread > 0))
    return Eigen::Matrix3d::Identity();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const SurfacePair& pair : pairs) {
    const Eigen::Vector3d lever = pair.place - fit.centroid;
    scatter += lever * lever.transpose() / static_cast<double>(pairs.size());
  }
  const auto eigen = symmetricEigen<3>(
      Eigen::Matrix3d(scatter.trace() * Eigen::Matrix3d::Identity() - scatter));
  const Eigen::Vector3d squares =
      eigen.values.cwiseMax(1e-6 * eigen.values(2)).cwiseSqrt().cwiseInverse();
  return eigen.vectors * squares.asDiagonal() * eigen.vectors.transpose();
}

/** \return the directions of the pairs; an open direction takes no step */
FitDirections
directionsOf(const std::vector<SurfacePair>& pairs,
             const Matrix6& H,
             const Twist& b,
             const SurfaceFit& fit)
{
  Matrix6 unit = Matrix6::Identity(); // turns as motions of the pairs
  unit.bottomRightCorner<3, 3>() = unitTurns(pairs, fit);
  const auto count = static_cast<double>(pairs.size());
  const auto eigen = symmetricEigen<6>(Matrix6(unit * H * unit / count));
  FitDirections directions;
  directions.axes = unit * eigen.vectors;
  directions.mean_square = eigen.values;
  for (int k = 0; k < 6; ++k)
    directions.inverse(k) =
        eigen.values(k) < Localizability::kOpen ? 0 : 1 / (eigen.values(k) * count);
  directions.step = directions.inverse.cwiseProduct(directions.axes.transpose() * b);
  return directions;
}

/** \return the terms of the pairs times their residuals */
std::vector<Twist>
gradientsOf(std::vector<Twist> terms, const std::vector<double>& residuals)
{
  for (std::size_t i = 0; i < terms.size(); ++i)
    terms[i] *= residuals[i];
  return terms;
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
  const Twist least =
      0.1 * fit.residual * fit.residual * count * directions.mean_square;
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

/** Solves for the step, and gives the covariances of the pose. */
void
solve(const std::vector<SurfacePair>& pairs,
      double voxel,
      const SurfaceFitOptions& options,
      SurfaceFit& fit)
{
  Matrix6 H = Matrix6::Zero();
  Twist b = Twist::Zero();
  for (const SurfacePair& pair : pairs) {
    const Twist j = jacobianOf(pair.place, pair.normal, fit.centroid);
    H += j * j.transpose();
    b += pair.residual * j;
  }
  const FitDirections directions = directionsOf(pairs, H, b, fit);
  fit.open_directions = static_cast<int>((directions.inverse.array() == 0).count());
  fit.step = directions.axes * directions.step;
  if (options.covariance)
    addCovariances(
        pairs, options.cube_voxels * voxel, options.shared_error, directions, fit);
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

SurfacePairs
verification::pairSurfaces(const VerifiedScan& first,
                           const VerifiedScan& second,
                           const Eigen::Isometry3d& T_first_second,
                           const SurfaceFitOptions& options)
{
  options.validate();
  PairCollector found(options);
  found.add(second, first, T_first_second, Eigen::Isometry3d::Identity(), true);
  found.add(first, second, T_first_second.inverse(), T_first_second, false);
  return {
      std::move(found.pairs), found.looked_at, std::max(first.voxel(), second.voxel())};
}

SurfaceFit
verification::fitOf(const SurfacePairs& found, const SurfaceFitOptions& options)
{
  SurfaceFit fit;
  fit.pairs = found.pairs.size();
  if (found.looked_at > 0)
    fit.overlap = static_cast<double>(fit.pairs) / static_cast<double>(found.looked_at);
  constexpr std::size_t kLeastPairs = 12; // two for each direction
  if (fit.pairs < kLeastPairs)
    return fit;
  for (const SurfacePair& pair : found.pairs)
    fit.centroid += pair.place / static_cast<double>(fit.pairs);
  double residual_sq = 0, spread_sq = 0;
  for (const SurfacePair& pair : found.pairs) {
    residual_sq += pair.residual * pair.residual;
    spread_sq += (pair.place - fit.centroid).squaredNorm();
  }
  fit.residual = std::sqrt(residual_sq / static_cast<double>(fit.pairs));
  fit.spread = std::sqrt(spread_sq / static_cast<double>(fit.pairs));
  solve(found.pairs, found.voxel, options, fit);
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
