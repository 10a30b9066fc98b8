// SPDX-License-Identifier: BSD-3-Clause
#include "refined_fit.h"
#include "surface_directions.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/registration/icp_options.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using verification::FitDirections;
using verification::Matrix6;
using verification::PairExtent;
using verification::PairGrids;
using verification::SurfacePair;
using verification::SurfacePairs;

namespace {
/** Searches for pairs of a selection of the points, then of all points, as of refined matches; and
 * steps with new weights for the same pairs. */
constexpr int kSearches = 12, kSearchesOfAll = 8, kStepsOfPairs = 3;

/** A shorter step is at rest [voxels], as of matches; and the last step of those that never rest,
 * since pairs come and go: that of fits with equal weights (kSettled). */
constexpr double kAtRest = 1e-3, kNearRest = 0.02;

/** Edge of the wide cubes, in cubes of the options, as with equal weights. */
constexpr double kWideCubesOfRefined = 4;

/** Largest factor for few cubes: a single cube says nothing of its own error, and n / (n - 1) has no
 * bound. That of one and a third of a cube. */
constexpr double kLargestOfFew = 4;

/** \return the mean square cosine below which a direction is open: the square of the error of a
 * normal. Planes have half their weight where normals differ by 2 sqrt(epsilon), see planeToPlane(),
 * and the mean of two such normals errs by half of this. */
double
openOfRefined()
{
  return IcpOptions().gicp_epsilon;
}

/** \return pairs along the mean of both normals, with the norm of Generalized-ICP as weight: along
 * n + m it is 2 e / (2 - (1 - e) (1 + n.m)), see planeToPlane(); across it is at most e, and left
 * out */
std::vector<SurfacePair>
meanPlanes(const std::vector<SurfacePair>& pairs)
{
  const double epsilon = IcpOptions().gicp_epsilon;
  std::vector<SurfacePair> planes = pairs;
  for (SurfacePair& plane : planes) {
    const Eigen::Vector3d sum = plane.normal + plane.other_normal;
    const double cosine = plane.normal.dot(plane.other_normal);
    plane.normal = sum.normalized();
    plane.residual = (plane.residual + plane.other_residual) / sum.norm();
    plane.weight = 2 * epsilon / (2 - (1 - epsilon) * (1 + cosine));
  }
  return planes;
}

/** \return 1.4826 times the median, the deviation of normal sizes, as in ICP */
double
scaleOf(std::vector<double> sizes)
{
  constexpr double kOfMedian = 1.4826, kLeastScale = 1e-6; // [m] exact copies
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return std::max(kOfMedian * *middle, kLeastScale);
}

/** Planes with the weights of Geman and McClure. */
struct WeighedPlanes {
  std::vector<SurfacePair> planes;
  std::vector<double> left;  ///< [m] distances that the step leaves
  std::vector<double> slope; ///< derivative of weight times distance by the distance
};

WeighedPlanes
weighed(const std::vector<SurfacePair>& planes,
        const Eigen::Vector3d& centroid,
        const Twist& step)
{
  WeighedPlanes all{planes, {}, {}};
  std::vector<double> sizes;
  for (const SurfacePair& plane : planes) {
    all.left.push_back(
        plane.residual -
        verification::jacobianOf(plane.place, plane.normal, centroid).dot(step));
    sizes.push_back(std::sqrt(plane.weight) * std::abs(all.left.back()));
  }
  const double scale = scaleOf(sizes);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const double size = sizes[i] / scale, square = size * size / 4;
    all.planes[i].weight *= robustWeight(RobustKernel::kGemanMcClure, size);
    all.slope.push_back(all.planes[i].weight * (1 - 3 * square) / (1 + square));
  }
  return all;
}

/** A step of given pairs. */
struct RefinedStep {
  Twist step = Twist::Zero(); ///< about the centroid of the pairs
  WeighedPlanes all;
  FitDirections directions;
};

/** \return the step, with weights made anew a few times; none if a direction is open */
std::optional<RefinedStep>
stepOf(const std::vector<SurfacePair>& pairs)
{
  const PairExtent extent = verification::extentOf(pairs);
  const std::vector<SurfacePair> planes = meanPlanes(pairs);
  RefinedStep refined;
  for (int k = 0; k <= kStepsOfPairs; ++k) {
    refined.all = weighed(planes, extent.centroid, refined.step);
    refined.directions =
        verification::directionsOf(refined.all.planes, extent, openOfRefined());
    if (refined.directions.open() > 0)
      return std::nullopt;
    if (k < kStepsOfPairs)
      refined.step = refined.directions.axes * refined.directions.step;
  }
  return refined;
}

/** Sums over the pairs, along the axes. */
struct Slopes {
  std::vector<Twist> gradients; ///< of each pair
  std::vector<Twist> products;  ///< of the cosines of both normals, times the slope
  std::vector<Twist> squares;   ///< of the cosines, times the weight
  Twist sum = Twist::Zero();    ///< of products
  Twist least =
      Twist::Zero(); ///< variance of gradients that counts, see addCovariances()
};

Slopes
slopesOf(const RefinedStep& refined,
         const std::vector<SurfacePair>& pairs,
         const Eigen::Vector3d& centroid)
{
  constexpr double kOfIndependent = 0.1; // few cubes may show no error in a direction
  Slopes slopes;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const SurfacePair& plane = refined.all.planes[i];
    const auto along = [&](const Eigen::Vector3d& normal) -> Twist {
      return refined.directions.axes.transpose() *
             verification::jacobianOf(plane.place, normal, centroid);
    };
    const Twist cosines = along(plane.normal);
    slopes.gradients.push_back(plane.weight * refined.all.left[i] * cosines);
    slopes.squares.push_back(plane.weight * cosines.cwiseAbs2());
    slopes.products.push_back(
        refined.all.slope[i] *
        along(pairs[i].normal).cwiseProduct(along(pairs[i].other_normal)));
    slopes.sum += slopes.products.back();
    slopes.least += kOfIndependent * plane.copies * slopes.gradients.back().cwiseAbs2();
  }
  return slopes;
}

/** \return along each axis, n / (n - 1) for the effective number n of cubes (L. Kish, "Survey
 * Sampling", 1965, 11.7) that fix the motion: a step follows the error of the only patch of floor, and
 * leaves no residual there */
Twist
ofFewCubes(const std::vector<Twist>& squares, const PairGrids& grids)
{
  Twist numbers = Twist::Zero();
  for (const verification::PairCubes& cubes : grids) {
    std::vector<Twist> sums(cubes.count, Twist::Zero());
    for (std::size_t i = 0; i < squares.size(); ++i)
      sums[cubes.of_pair[i]] += squares[i];
    Twist all = Twist::Zero(), of_squares = Twist::Zero();
    for (const Twist& sum : sums) {
      all += sum;
      of_squares += sum.cwiseAbs2();
    }
    numbers +=
        all.cwiseAbs2().cwiseQuotient(of_squares) / static_cast<double>(grids.size());
  }
  return numbers.cwiseQuotient(numbers - Twist::Ones())
      .cwiseMin(kLargestOfFew)
      .unaryExpr([](double factor) { return factor >= 1 ? factor : kLargestOfFew; });
}

/** \return a covariance that has in each direction the larger variance of two. Few wide cubes show
 * large errors in some directions, and none in others. */
Matrix6
largerOf(const Matrix6& a, const Matrix6& b)
{
  const auto of_a = symmetricEigen<6>(a);
  if (!(of_a.values(0) > 0)) // exact copies
    return a + b;
  const Matrix6 root = of_a.vectors * of_a.values.cwiseSqrt().asDiagonal();
  const Matrix6 inverse =
      of_a.values.cwiseSqrt().cwiseInverse().asDiagonal() * of_a.vectors.transpose();
  const auto ratios = symmetricEigen<6>(Matrix6(inverse * b * inverse.transpose()));
  const Matrix6 axes = root * ratios.vectors;
  return axes * ratios.values.cwiseMax(1).asDiagonal() * axes.transpose();
}

/** \return the covariance of the step of an M-estimator: of the sum of the gradients, by the mean
 * slope from both sides (P. J. Huber, "Robust Statistics", 1981, 6.3) */
Matrix6
covarianceOf(const RefinedStep& refined,
             const std::vector<SurfacePair>& pairs,
             const Eigen::Vector3d& centroid,
             double cube)
{
  const PairGrids grids = verification::gridsOf(pairs, centroid, cube);
  const Slopes slopes = slopesOf(refined, pairs, centroid);
  const Twist deviation =
      verification::sumOfCubes(slopes.products, grids, 0).diagonal().cwiseSqrt();
  Twist inverse;
  const Twist of_few = ofFewCubes(slopes.squares, grids);
  for (int k = 0; k < 6; ++k) {
    const double slope = std::min(std::max(slopes.sum(k), deviation(k)),
                                  1 / refined.directions.inverse(k));
    // The mean of 1 / s^2 is (1 + 3 var s / s^2) / s^2, to second order.
    const double unsure = deviation(k) / slope;
    inverse(k) = std::sqrt(of_few(k) * (1 + 3 * unsure * unsure)) / slope;
  }
  const PairGrids wide =
      verification::gridsOf(pairs, centroid, kWideCubesOfRefined * cube);
  Matrix6 gradients = verification::sumOfCubes(slopes.gradients, grids, 6);
  gradients.diagonal() += slopes.least;
  gradients = largerOf(gradients, verification::sumOfCubes(slopes.gradients, wide, 6));
  const Matrix6 scaled = refined.directions.axes * inverse.asDiagonal();
  return scaled * gradients * scaled.transpose();
}

/** A fit on its way to rest. */
class Refining {
public:
  Refining(const VerifiedScan& first,
           const VerifiedScan& second,
           const Eigen::Isometry3d& T_first_second,
           const SurfaceFitOptions& options)
  : first_(first), second_(second), options_(options), T_(T_first_second)
  {
    options_.covariance = false;
  }

  /** \return whether steps became shorter than a length [voxels]; false without enough pairs or with
   * an open direction */
  bool
  reaches(double rest, int searches)
  {
    for (int k = 0; k < searches; ++k) {
      found_ = verification::pairSurfaces(first_, second_, T_, options_);
      fit_ = verification::fitOf(found_, options_);
      refined_ = fit_.spread > 0 ? stepOf(found_.pairs) : std::nullopt;
      if (!refined_)
        return false;
      fit_.step = refined_->step;
      T_ = Eigen::Translation3d(fit_.centroid) * motionFromTwist(fit_.step) *
           Eigen::Translation3d(-fit_.centroid) * T_;
      if (isShorter(rest))
        return true;
    }
    return false;
  }

  void
  pairAll()
  {
    options_.points =
        std::max(first_.surfaces().points().size(), second_.surfaces().points().size());
  }

  /** \return whether the last step had pairs, and was shorter [voxels] */
  bool
  isShorter(double length) const
  {
    return refined_ && fit_.displacement() < length * found_.voxel;
  }

  /** \return the last fit, with the motion from a pose, and its covariance */
  SurfaceFit
  result(const Eigen::Isometry3d& T_first_second) const
  {
    SurfaceFit fit = fit_;
    fit.open_directions = 0;
    fit.pose_covariance = covarianceOf(
        *refined_, found_.pairs, fit.centroid, options_.cube_voxels * found_.voxel);
    fit.step =
        twistFromMotion(Eigen::Translation3d(-fit.centroid) * T_ *
                        T_first_second.inverse() * Eigen::Translation3d(fit.centroid));
    return fit;
  }

private:
  const VerifiedScan& first_;
  const VerifiedScan& second_;
  SurfaceFitOptions options_;
  Eigen::Isometry3d T_;
  SurfacePairs found_;
  SurfaceFit fit_;
  std::optional<RefinedStep> refined_;
};
} // namespace

std::optional<SurfaceFit>
verification::refinedFit(const VerifiedScan& first,
                         const VerifiedScan& second,
                         const Eigen::Isometry3d& T_first_second,
                         const SurfaceFitOptions& options)
{
  Refining refining(first, second, T_first_second, options);
  if (!refining.reaches(kNearRest, kSearches))
    return std::nullopt;
  refining.pairAll();
  if (!refining.reaches(kAtRest, kSearchesOfAll) && !refining.isShorter(kNearRest))
    return std::nullopt;
  const SurfaceFit fit = refining.result(T_first_second);
  return fit.displacement() <= options.max_distance ? std::optional(fit) : std::nullopt;
}

std::optional<SurfaceFit>
verification::seenFrom(const Eigen::Isometry3d& T_now,
                       const Eigen::Isometry3d& T_first_second,
                       const SurfaceFit& fit)
{
  const Eigen::Translation3d centroid(fit.centroid);
  SurfaceFit now = fit;
  now.step = twistFromMotion(motionFromTwist(fit.step) * centroid.inverse() *
                             T_first_second * T_now.inverse() * centroid);
  return now.displacement() <= fit.displacement() ? std::optional(now) : std::nullopt;
}

} // namespace pcl6d
