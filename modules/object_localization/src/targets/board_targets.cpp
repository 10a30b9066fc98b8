// SPDX-License-Identifier: BSD-3-Clause
#include "targets/target_parts.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/median.h>
#include <pcl6d/common/parallel.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace pcl6d::targets {

namespace {
/** Nine points for each quarter. */
constexpr std::size_t kLeastOfBoard = 36;
/** Points about a seed for fitting the first pattern. */
constexpr std::size_t kMostSpots = 300;
/** Largest standard deviation of the brightness of a colour, where the colours are -1 and 1: prints
 * are even, other edges separate surfaces of any brightness. */
constexpr double kMostUneven = 0.35;
/** Largest rms of the plane, as a share of the edge: noise of 5 mm on boards of 150
 * mm. */
constexpr double kFlattest = 0.035;
/** Least share of points with the colour of their quarter: points at edges see both. */
constexpr double kLeastAgreement = 0.9, kLeastAtBorder = 0.8;

/** A point of a board in the axes of its plane, with its brightness: -1 dark, 1 light. */
struct Spot {
  Eigen::Vector2d place;
  double brightness;
};

struct BoardPlane {
  Eigen::Vector3d middle, right, up, normal;
  double rms = 0;
  std::vector<Spot> spots;
};

/** \return the point in the axes of the pattern */
Eigen::Vector2d
inPattern(const Eigen::Vector3d& pattern, const Eigen::Vector2d& place)
{
  return Eigen::Rotation2Dd(-pattern.z()) * (place - pattern.head<2>());
}

/** \return nullopt if the points near a place are not flat, or of one colour */
std::optional<BoardPlane>
planeAt(const TargetScan& scan, const Eigen::Vector3d& place, double reach, double size)
{
  const std::vector<std::size_t> near = pointsNear(scan, place, reach);
  if (near.size() < kLeastOfBoard)
    return std::nullopt;
  BoardPlane plane;
  plane.middle.setZero();
  for (const std::size_t i : near)
    plane.middle += scan.points[i].cast<double>();
  plane.middle /= static_cast<double>(near.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  std::vector<double> brightness;
  for (const std::size_t i : near) {
    const Eigen::Vector3d p = scan.points[i].cast<double>() - plane.middle;
    scatter += p * p.transpose();
    brightness.push_back(scan.intensity[i]);
  }
  const SymmetricEigen<3> eigen = symmetricEigen<3>(scatter);
  plane.rms =
      std::sqrt(std::max(0.0, eigen.values(0)) / static_cast<double>(near.size()));
  std::sort(brightness.begin(), brightness.end());
  const double dark = brightness[near.size() / 10];
  const double light = brightness[near.size() - 1 - near.size() / 10];
  // Black and white differ by more than half of the light, unlike noise and wood.
  if (plane.rms > kFlattest * size || !(light - dark > 0.5 * std::abs(light)))
    return std::nullopt;
  plane.normal = eigen.vectors.col(0);
  plane.right = plane.normal.unitOrthogonal();
  plane.up = plane.normal.cross(plane.right);
  for (const std::size_t i : near) {
    const Eigen::Vector3d p = scan.points[i].cast<double>() - plane.middle;
    const double bright = (2 * scan.intensity[i] - light - dark) / (light - dark);
    plane.spots.push_back(
        {{p.dot(plane.right), p.dot(plane.up)}, std::clamp(bright, -2.0, 2.0)});
  }
  return plane;
}

/** \return the brightness of the pattern at a position, with a soft edge [m] */
double
modelAt(const Eigen::Vector3d& pattern, const Eigen::Vector2d& place, double edge)
{
  const Eigen::Vector2d p = inPattern(pattern, place) / edge;
  return std::tanh(p.x()) * std::tanh(p.y());
}

/** \return the mean product of brightness and pattern within the square, in [-1, 1]; -1 for too
 * few points */
double
scoreOf(const BoardPlane& plane, const Eigen::Vector3d& pattern, double size)
{
  double sum = 0;
  std::size_t count = 0;
  const std::size_t stride = 1 + plane.spots.size() / kMostSpots;
  for (std::size_t k = 0; k < plane.spots.size(); k += stride) {
    const Spot& spot = plane.spots[k];
    const Eigen::Vector2d p = inPattern(pattern, spot.place);
    if (p.cwiseAbs().maxCoeff() > 0.5 * size)
      continue;
    sum += (p.x() * p.y() > 0 ? 1 : -1) * spot.brightness;
    ++count;
  }
  return count < kLeastOfBoard / 2 ? -1 : sum / static_cast<double>(count);
}

/** \return the best of a grid of positions and turns */
Eigen::Vector3d
coarsePattern(const BoardPlane& plane, double size)
{
  constexpr int kSteps = 4, kTurns = 18; // an eighth of the half edge, 10 degrees
  constexpr double kPi = 3.14159265358979323846;
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  double most = -1;
  for (int x = -kSteps; x <= kSteps; ++x)
    for (int y = -kSteps; y <= kSteps; ++y)
      for (int turn = 0; turn < kTurns; ++turn) {
        const Eigen::Vector3d pattern(
            size * x / (4 * kSteps), size * y / (4 * kSteps), kPi * turn / kTurns);
        const double score = scoreOf(plane, pattern, size);
        if (score > most) {
          most = score;
          best = pattern;
        }
      }
  return best;
}

/** Least squares by Gauss and Newton with differences in place of derivatives.
 * \param[out] sigma [m] standard deviation along an axis of the plane \return nullopt
 * where the pattern has too few points */
std::optional<Eigen::Vector3d>
refinedPattern(const BoardPlane& plane,
               Eigen::Vector3d pattern,
               double size,
               double edge,
               double& sigma)
{
  constexpr int kSteps = 12;
  const Eigen::Vector3d delta(0.01 * edge, 0.01 * edge, 0.01 * edge / size);
  for (int step = 0; step < kSteps; ++step) {
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    double sum = 0;
    std::size_t count = 0;
    for (const Spot& spot : plane.spots) {
      if (inPattern(pattern, spot.place).cwiseAbs().maxCoeff() > 0.45 * size)
        continue;
      const double residual = modelAt(pattern, spot.place, edge) - spot.brightness;
      Eigen::Vector3d j;
      for (int k = 0; k < 3; ++k) {
        Eigen::Vector3d moved = pattern;
        moved(k) += delta(k);
        j(k) =
            (modelAt(moved, spot.place, edge) - spot.brightness - residual) / delta(k);
      }
      H += j * j.transpose();
      g += residual * j;
      sum += residual * residual;
      ++count;
    }
    if (count < kLeastOfBoard)
      return std::nullopt;
    const SymmetricEigen<3> eigen = symmetricEigen<3>(H);
    if (!(eigen.values(0) > 0))
      return std::nullopt;
    const Eigen::Matrix3d inverse = eigen.vectors *
                                    eigen.values.cwiseInverse().asDiagonal() *
                                    eigen.vectors.transpose();
    Eigen::Vector3d x = -inverse * g;
    const double way = x.head<2>().norm();
    if (way > edge)
      x *= edge / way;
    pattern += x;
    sigma = std::sqrt(0.5 * inverse.topLeftCorner<2, 2>().trace() * sum /
                      static_cast<double>(count - 3));
  }
  return pattern;
}

/** Agreement of the spots within the square with the pattern. */
struct Agreement {
  std::size_t points = 0;
  double all = 0, border = 0;
  double uneven = 0; ///< standard deviation of the brightness of a colour
  bool has_quarters = false;
};

Agreement
agreementOf(const BoardPlane& plane,
            const Eigen::Vector3d& pattern,
            double size,
            double edge)
{
  std::array<std::size_t, 4> quarters{};
  std::size_t right = 0, tested = 0, at_border = 0, right_at_border = 0;
  Agreement found;
  for (const Spot& spot : plane.spots) {
    const Eigen::Vector2d p = inPattern(pattern, spot.place);
    const double out = p.cwiseAbs().maxCoeff();
    if (out > 0.48 * size)
      continue;
    ++found.points;
    ++quarters[(p.x() > 0 ? 1U : 0U) + (p.y() > 0 ? 2U : 0U)];
    if (p.cwiseAbs().minCoeff() < edge) // may see both colours
      continue;
    const bool is_right = p.x() * p.y() * spot.brightness > 0;
    const double off = spot.brightness - (p.x() * p.y() > 0 ? 1 : -1);
    found.uneven += off * off;
    ++tested;
    right += is_right ? 1 : 0;
    at_border += out > 0.36 * size ? 1 : 0;
    right_at_border += out > 0.36 * size && is_right ? 1 : 0;
  }
  const auto shareOf = [](std::size_t part, std::size_t all) {
    return all == 0 ? 0 : static_cast<double>(part) / static_cast<double>(all);
  };
  found.uneven =
      std::sqrt(found.uneven / static_cast<double>(std::max<std::size_t>(1, tested)));
  found.all = shareOf(right, tested);
  found.border = shareOf(right_at_border, at_border);
  found.has_quarters = *std::min_element(quarters.begin(), quarters.end()) >= 3;
  return found;
}

/** \return [m] the median distance of points to their nearest neighbour, at least a
 * fiftieth of the edge */
double
spacingOf(const BoardPlane& plane, double size)
{
  std::vector<double> spacings;
  for (const Spot& a : plane.spots) {
    double nearest = size;
    for (const Spot& b : plane.spots)
      if (&a != &b)
        nearest = std::min(nearest, (a.place - b.place).norm());
    spacings.push_back(nearest);
    if (spacings.size() == 50)
      break;
  }
  std::sort(spacings.begin(), spacings.end());
  return std::max(spacings[spacings.size() / 2], 0.02 * size);
}

void
testBoard(const TargetScan& scan,
          const Eigen::Vector3d& seed,
          double size,
          TargetSearch& search)
{
  // The square about any seed within its middle, first at the seed, then at the pattern.
  auto plane = planeAt(scan, seed, 0.75 * size, size);
  if (!plane)
    return;
  Eigen::Vector3d pattern = coarsePattern(*plane, size);
  const auto placeOf = [&] {
    return Eigen::Vector3d(plane->middle + pattern.x() * plane->right +
                           pattern.y() * plane->up);
  };
  plane = planeAt(scan, placeOf(), 0.71 * size, size);
  if (!plane)
    return;
  pattern = coarsePattern(*plane, size);
  const double edge = 0.5 * spacingOf(*plane, size);
  double sigma = 0;
  const auto refined = refinedPattern(*plane, pattern, size, edge, sigma);
  if (!refined || (*refined - pattern).head<2>().norm() > 0.25 * size)
    return;
  pattern = *refined;
  const Agreement agreement = agreementOf(*plane, pattern, size, edge);
  if (agreement.points < kLeastOfBoard || !agreement.has_quarters ||
      agreement.all < kLeastAgreement || agreement.uneven > kMostUneven)
    return;
  const Eigen::Vector3d centre = placeOf();
  // An edge lies anywhere between two points of a row (variance of a uniform
  // distribution); each row across the edge is an independent measurement.
  const double spacing = size / std::sqrt(static_cast<double>(agreement.points));
  sigma = std::hypot(sigma, spacing / std::sqrt(12 * size / spacing));
  const double across = plane->rms / std::sqrt(static_cast<double>(agreement.points));
  const double cosine = std::abs(plane->normal.dot(centre.normalized()));
  std::optional<MeasuredFault> fault;
  if (cosine < kGrazing)
    fault = {TargetFault::kGrazingAngle, std::acos(cosine)};
  else if (agreement.border < kLeastAtBorder)
    fault = {TargetFault::kSmallerBoard, agreement.border};
  addTarget({TargetKind::kBoard,
             size,
             centre,
             std::sqrt((2 * sigma * sigma + across * across) / 3),
             agreement.all,
             agreement.points},
            fault,
            search);
}
} // namespace

void
findBoards(const TargetScan& scan,
           double size,
           unsigned int num_threads,
           TargetSearch& search)
{
  const std::vector<std::size_t> seeds = seedsOf(scan, 0.4 * size);
  std::vector<TargetSearch> results(seeds.size());
  parallelFor(seeds.size(), num_threads, [&](std::size_t k) {
    testBoard(scan, scan.points[seeds[k]].cast<double>(), size, results[k]);
  });
  for (const TargetSearch& one : results) {
    search.found.insert(search.found.end(), one.found.begin(), one.found.end());
    search.rejected.insert(
        search.rejected.end(), one.rejected.begin(), one.rejected.end());
  }
}

} // namespace pcl6d::targets
