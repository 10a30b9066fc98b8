// SPDX-License-Identifier: BSD-3-Clause
#include "targets/target_parts.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/median.h>
#include <pcl6d/common/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace pcl6d::targets {

namespace {
/** Four times the points that determine centre and radius. */
constexpr std::size_t kLeastPoints = 16;
/** Points about a seed for the first sphere: more points add little. */
constexpr std::size_t kMostOfSeed = 200;
/** Accepted factors of the free radius about the seed: the spread for a cap of one
 * radius with noise of a twentieth of the radius. */
constexpr double kLeastRadius = 0.5, kMostRadius = 2;
/** Largest rms of a sphere, and largest difference of a free radius, as shares of the
 * radius: commercial spheres are round to 1 %; scanners have noise of up to 3.6 mm, on
 * radii of 72 mm. */
constexpr double kMostRms = 0.05, kMostOfRadius = 0.06;
/** Largest number of points within the sphere, as a share of the points on the
 * sphere. */
constexpr double kMostInside = 0.1;
/** Largest number of points that continue the surface beside the sphere, such as on a
 * wall, as a share of the points on the sphere; a foot or a magnet has fewer. */
constexpr double kMostBeside = 0.3;
/** Nearer centres, in diameters, are parts of the carrier: half a metre is the least
 * range of common scanners. */
constexpr double kNearest = 3;
/** Least share of the visible side with points. */
constexpr double kLeastCoverage = 0.5;
/** Share of the radius: the outer part of the visible disc, seen at a slant, is
 * ignored. */
constexpr double kSeenDisc = 0.9;

struct SphereFit {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0;
  double radius_sigma = 0;
  double rms = 0;
  double sigma = 0; ///< of a coordinate of the centre, with the given radius
  std::vector<std::size_t> points;
};

/** \return the sphere that fits points best, by the linear equation |p|^2 = 2 c p + d;
 * nullopt if the points are flat */
std::optional<SphereFit>
linearSphere(const TargetScan& scan,
             const std::vector<std::size_t>& near,
             const Eigen::Vector3d& middle)
{
  using Matrix4 = Eigen::Matrix4d;
  Matrix4 A = Matrix4::Zero();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  const std::size_t stride = 1 + near.size() / kMostOfSeed;
  for (std::size_t k = 0; k < near.size(); k += stride) {
    const Eigen::Vector3d p = scan.points[near[k]].cast<double>() - middle;
    const Eigen::Vector4d row(p.x(), p.y(), p.z(), 1);
    A += row * row.transpose();
    b += p.squaredNorm() * row;
  }
  const SymmetricEigen<4> eigen = symmetricEigen<4>(A);
  if (!(eigen.values(0) > 1e-12 * eigen.values(3)))
    return std::nullopt;
  const Eigen::Vector4d x =
      eigen.vectors *
      (eigen.vectors.transpose() * b).cwiseQuotient(eigen.values).eval();
  SphereFit fit;
  fit.centre = middle + 0.5 * x.head<3>();
  const double radius_sq = x(3) + 0.25 * x.head<3>().squaredNorm();
  if (!(radius_sq > 0) || !fit.centre.allFinite())
    return std::nullopt;
  fit.radius = std::sqrt(radius_sq);
  return fit;
}

/** One step of Gauss and Newton for the centre, and with is_free for the radius.
 * \return the inverse of the normal matrix */
Eigen::Matrix4d
stepOf(const TargetScan& scan, SphereFit& fit, bool is_free)
{
  Eigen::Matrix4d H = Eigen::Matrix4d::Zero();
  Eigen::Vector4d g = Eigen::Vector4d::Zero();
  double sum = 0;
  for (const std::size_t i : fit.points) {
    const Eigen::Vector3d ray = scan.points[i].cast<double>() - fit.centre;
    const double residual = ray.norm() - fit.radius;
    Eigen::Vector4d j;
    j << -ray.normalized(), -1;
    H += j * j.transpose();
    g += residual * j;
    sum += residual * residual;
  }
  if (!is_free) {
    H.row(3).setZero();
    H.col(3).setZero();
    H(3, 3) = 1;
    g(3) = 0;
  }
  const SymmetricEigen<4> eigen = symmetricEigen<4>(H);
  Eigen::Matrix4d inverse = eigen.vectors *
                            eigen.values.cwiseMax(1e-9).cwiseInverse().asDiagonal() *
                            eigen.vectors.transpose();
  const Eigen::Vector4d x = -inverse * g;
  fit.centre += x.head<3>();
  fit.radius += x(3);
  const double freedom =
      std::max(1.0, static_cast<double>(fit.points.size()) - (is_free ? 4 : 3));
  fit.rms = std::sqrt(sum / freedom);
  return inverse;
}

/** Takes the points near the surface on the side that faces the scanner. */
void
takePoints(const TargetScan& scan, double radius, double band, SphereFit& fit)
{
  const Eigen::Vector3d away = fit.centre.normalized();
  std::vector<std::size_t> taken;
  for (const std::size_t i : pointsNear(scan, fit.centre, radius + band)) {
    const Eigen::Vector3d ray = scan.points[i].cast<double>() - fit.centre;
    if (std::abs(ray.norm() - radius) <= band && ray.dot(away) < 0.1 * radius)
      taken.push_back(i);
  }
  fit.points = std::move(taken);
}

/** \return the fit with the given radius from a first centre */
std::optional<SphereFit>
fittedSphere(const TargetScan& scan, double radius, SphereFit fit)
{
  constexpr int kRounds = 8;
  double band = 0.3 * radius;
  for (int round = 0; round < kRounds; ++round) {
    takePoints(scan, radius, band, fit);
    if (fit.points.size() < kLeastPoints)
      return std::nullopt;
    fit.radius = radius;
    const Eigen::Matrix4d inverse = stepOf(scan, fit, false);
    fit.sigma = fit.rms * std::sqrt(inverse.topLeftCorner<3, 3>().trace() / 3);
    band = std::clamp(3 * fit.rms, 0.03 * radius, 0.6 * band + 0.02 * radius);
  }
  return fit;
}

/** \return the share of sixteen equal parts of the visible disc with points */
double
coverageOf(const TargetScan& scan, const SphereFit& fit, double radius)
{
  const Eigen::Vector3d away = fit.centre.normalized();
  const Eigen::Vector3d right = away.unitOrthogonal(), up = away.cross(right);
  std::array<bool, 16> has{};
  constexpr double kPi = 3.14159265358979323846;
  for (const std::size_t i : fit.points) {
    const Eigen::Vector3d ray = scan.points[i].cast<double>() - fit.centre;
    const double u = ray.dot(right), v = ray.dot(up);
    const double out = std::hypot(u, v) / (kSeenDisc * radius);
    if (out > 1)
      continue;
    const auto sector = static_cast<std::size_t>(4 * (std::atan2(v, u) / kPi + 1)) % 8;
    has[sector + (out * out > 0.5 ? 8 : 0)] = true;
  }
  return static_cast<double>(std::count(has.begin(), has.end(), true)) / 16;
}

/** \return the number of points within the sphere */
std::size_t
countInside(const TargetScan& scan, const SphereFit& fit, double radius)
{
  return pointsNear(scan, fit.centre, (1 - 3 * kMostRms) * radius).size();
}

/** \return the number of points around the sphere on the side that faces the scanner,
 * up to four tenths of the radius away */
std::size_t
countBeside(const TargetScan& scan, const SphereFit& fit, double radius)
{
  const Eigen::Vector3d away = fit.centre.normalized();
  std::size_t count = 0;
  for (const std::size_t i : pointsNear(scan, fit.centre, 1.4 * radius)) {
    const Eigen::Vector3d ray = scan.points[i].cast<double>() - fit.centre;
    if (ray.norm() > (1 + 3 * kMostRms) * radius && ray.dot(away) < 0)
      ++count;
  }
  return count;
}

/** \return the sphere of free radius, from points selected anew in each round */
SphereFit
freeSphere(const TargetScan& scan, double radius, SphereFit fit)
{
  constexpr int kRounds = 4, kSteps = 4;
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix4d inverse;
    for (int step = 0; step < kSteps; ++step)
      inverse = stepOf(scan, fit, true);
    fit.radius_sigma = fit.rms * std::sqrt(inverse(3, 3));
    SphereFit wider = fit;
    if (!(fit.radius > 0) || fit.radius > kMostRadius * radius)
      break;
    takePoints(scan, fit.radius, 0.1 * radius, wider);
    if (wider.points.size() < kLeastPoints)
      break;
    fit.points = std::move(wider.points);
  }
  return fit;
}

/** \return whether points look like a sphere of a similar size; other shapes, which are most, are
 * not reported. \param[in] free the sphere of free radius */
bool
isSphere(const TargetScan& scan,
         double radius,
         const SphereFit& fit,
         const SphereFit& free)
{
  const auto count = static_cast<double>(fit.points.size());
  return !(free.rms > kMostRms * radius || free.radius > kMostRadius * radius ||
           free.radius < kLeastRadius * radius ||
           free.radius_sigma > kMostOfRadius * radius ||
           static_cast<double>(countBeside(scan, fit, std::max(radius, free.radius))) >
               kMostBeside * count);
}

/** Sorts a fit into found, rejected or neither. */
void
evaluateSphere(const TargetScan& scan,
               double radius,
               const SphereFit& fit,
               TargetSearch& search)
{
  const auto count = static_cast<double>(fit.points.size());
  if (fit.centre.norm() < kNearest * 2 * radius)
    return;
  if (static_cast<double>(countInside(scan, fit, radius)) > kMostInside * count)
    return;
  const SphereFit free = freeSphere(scan, radius, fit);
  if (!isSphere(scan, radius, fit, free))
    return;
  const double off = std::abs(free.radius - radius);
  const double coverage = coverageOf(scan, fit, radius);
  const bool is_hidden = coverage < kLeastCoverage;
  const bool is_other = off > std::max(kMostOfRadius * radius, 4 * free.radius_sigma);
  if (is_other ? is_hidden : fit.rms > kMostRms * radius)
    return;
  std::optional<MeasuredFault> fault;
  if (is_other)
    fault = {TargetFault::kOtherDiameter, 2 * free.radius};
  else if (is_hidden)
    fault = {TargetFault::kMostlyHidden, coverage};
  addTarget({TargetKind::kSphere,
             2 * radius,
             fit.centre,
             fit.sigma,
             coverage,
             fit.points.size()},
            fault,
            search);
}
} // namespace

void
findSpheres(const TargetScan& scan,
            double diameter,
            unsigned int num_threads,
            TargetSearch& search)
{
  const double radius = 0.5 * diameter;
  const std::vector<std::size_t> seeds = seedsOf(scan, radius);
  std::vector<TargetSearch> results(seeds.size());
  parallelFor(seeds.size(), num_threads, [&](std::size_t k) {
    const Eigen::Vector3d seed = scan.points[seeds[k]].cast<double>();
    const std::vector<std::size_t> near = pointsNear(scan, seed, 0.8 * radius);
    if (near.size() < kLeastPoints / 2)
      return;
    const auto first = linearSphere(scan, near, seed);
    if (!first || first->radius < kLeastRadius * radius ||
        first->radius > kMostRadius * radius || first->centre.norm() <= seed.norm())
      return;
    if (const auto fit = fittedSphere(scan, radius, *first))
      evaluateSphere(scan, radius, *fit, results[k]);
  });
  for (const TargetSearch& one : results) {
    search.found.insert(search.found.end(), one.found.begin(), one.found.end());
    search.rejected.insert(
        search.rejected.end(), one.rejected.begin(), one.rejected.end());
  }
}

} // namespace pcl6d::targets
