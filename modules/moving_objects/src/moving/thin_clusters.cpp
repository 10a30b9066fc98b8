// SPDX-License-Identifier: BSD-3-Clause
#include "thin_clusters.h"

#include <pcl6d/search/point_tree.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::moving_objects {

namespace {
/** Least number of places inside of a surface: a patch of sightEvidence(). */
constexpr std::size_t kLeastSolid = 4;

/** One place in this number, at least, is inside of a surface. A pane that returns a share f of the rays
 * surrounds a place with f^8 of chance: 1 / 8 is f = 0.77. */
constexpr std::size_t kSolidShare = 8;

/** [standard deviations] Ranges within this distance are equal, as in RayImage. */
constexpr double kSameRangeSigmas = 3;

/** [tolerances of a range] A surface that ends farther behind is another one: over the cells around
 * a place, the range of one surface changes by up to two tolerances, at an incidence of 50 deg. */
constexpr double kOtherSurface = 3;

using Planar = Eigen::Vector2d;

/** \return [m] ranges within it, of one surface in one cell, are equal */
double
toleranceAt(const TestedPositions& observed, double range)
{
  return kSameRangeSigmas * observed.noise + observed.cell * range;
}

bool
isInsideSurface(const TestedPositions& observed, const RayImage& own, std::size_t place)
{
  const Eigen::Vector3f ray = observed.places[place] - observed.origin;
  const auto behind =
      static_cast<float>(kOtherSurface * toleranceAt(observed, ray.norm()));
  return own.look(observed.places[place] + behind * ray.normalized(), 0).sight ==
         Sight::kBehind;
}

/** \return twice the area of a triangle; positive: c is to the left of the way from a to b */
double
turnOf(const Planar& a, const Planar& b, const Planar& c)
{
  const Planar ab = b - a, ac = c - a;
  return ab.x() * ac.y() - ab.y() * ac.x();
}

/** \return the convex hull, counterclockwise (A. M. Andrew 1979) */
std::vector<Planar>
convexHull(std::vector<Planar> points)
{
  std::sort(points.begin(), points.end(), [](const Planar& a, const Planar& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  std::vector<Planar> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Planar& p : points) {
      while (hull.size() >= first + 2 &&
             turnOf(hull[hull.size() - 2], hull.back(), p) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

bool
isWithin(const std::vector<Planar>& hull, const Planar& p)
{
  for (std::size_t k = 0; k < hull.size(); ++k)
    if (turnOf(hull[k], hull[(k + 1) % hull.size()], p) <= 0)
      return false;
  return true;
}

/** \return the number of places that an observer hit; 0 if it missed as many */
std::size_t
hitsBy(const ObserverVotes& votes,
       std::size_t observer,
       const std::vector<std::size_t>& cluster)
{
  std::size_t hit = 0, missed = 0;
  for (const std::size_t place : cluster) {
    hit += votes.votes()[place].hits >> observer & 1U;
    missed += votes.votes()[place].misses >> observer & 1U;
  }
  return hit > missed ? hit : 0;
}
/** \return the mean cosine of the angle between the normals at places and the rays from an origin */
double
steepnessFrom(const Eigen::Vector3f& origin,
              const TestedPositions& observed,
              const ObserverVotes& votes,
              const std::vector<std::size_t>& cluster)
{
  double sum = 0;
  for (const std::size_t place : cluster) {
    const Eigen::Vector3f& p = observed.places[place];
    sum += std::abs(normalOf(votes.observed(), p).dot((p - origin).normalized()));
  }
  return sum / static_cast<double>(cluster.size());
}
} // namespace

bool
hasSolidPart(const TestedPositions& observed,
             const RayImage& own,
             const std::vector<std::size_t>& cluster)
{
  std::size_t solid = 0;
  for (const std::size_t place : cluster) {
    solid += isInsideSurface(observed, own, place) ? 1 : 0;
  }
  return solid >= std::max(kLeastSolid, cluster.size() / kSolidShare);
}

bool
isPorous(const TestedPositions& observed, const std::vector<std::size_t>& cluster)
{
  const Eigen::Vector3d ahead =
      (middleOf(observed, cluster) - observed.origin.cast<double>()).normalized();
  const Eigen::Vector3d x = ahead.unitOrthogonal(), y = ahead.cross(x);
  const auto seenAt = [&](const Eigen::Vector3d& way) {
    return Planar(x.dot(way) / ahead.dot(way), y.dot(way) / ahead.dot(way));
  };
  std::vector<Planar> at;
  Points directions;
  double narrowest = 1; // cosine of the cone around the cluster
  for (const std::size_t place : cluster) {
    directions.push_back(observed.directionOf(place));
    const Eigen::Vector3d way = directions.back().cast<double>();
    at.push_back(seenAt(way));
    narrowest = std::min(narrowest, ahead.dot(way));
  }
  if (narrowest <= 0) // around the scanner
    return false;
  const PointTree tree(directions, 1);
  const std::vector<Planar> hull = convexHull(std::move(at));
  std::size_t passed = 0;
  for (const Eigen::Vector3f& place : observed.places) {
    const Eigen::Vector3f ray = place - observed.origin;
    const double range = ray.norm(), along = ahead.dot(ray.cast<double>());
    if (along < narrowest * range || !isWithin(hull, seenAt(ray.cast<double>())))
      continue;
    const auto next =
        static_cast<std::size_t>(tree.nearestK(ray / ray.norm(), 1)[0].index);
    const double met = (observed.places[cluster[next]] - observed.origin).norm();
    passed += range > met + kOtherSurface * toleranceAt(observed, met) ? 1 : 0;
  }
  return passed >= cluster.size();
}

bool
isHitByOthers(const ObserverVotes& votes, const std::vector<std::size_t>& cluster)
{
  std::size_t hits = 0;
  for (std::size_t j = 0; j < votes.observers().size(); ++j)
    hits += hitsBy(votes, j, cluster);
  return kHitInMisses * hits >= static_cast<std::size_t>(kLeastMisses);
}

std::uint16_t
observersAsFine(const TestedPositions& observed,
                const ObserverVotes& votes,
                const std::vector<std::size_t>& cluster)
{
  const Eigen::Vector3f middle = middleOf(observed, cluster).cast<float>();
  const double cell = std::max(votes.observed().rays->cellAt(middle), observed.cell);
  double gap = cell * (middle - observed.origin).norm();
  double steep = steepnessFrom(observed.origin, observed, votes, cluster);
  const auto steepness = [&](std::size_t j) {
    return steepnessFrom(
        votes.observers()[j].originInObserved(), observed, votes, cluster);
  };
  for (std::size_t j = 0; j < votes.observers().size(); ++j)
    if (2 * hitsBy(votes, j, cluster) > cluster.size()) {
      gap = std::max(gap, votes.observers()[j].gapAt(middle));
      steep = std::min(steep, steepness(j));
    }
  const bool is_porous = isPorous(observed, cluster);
  unsigned as_fine = 0;
  for (std::size_t j = 0; j < votes.observers().size(); ++j)
    as_fine |= votes.observers()[j].gapAt(middle) <= gap &&
                       (!is_porous || steepness(j) >= steep)
                   ? 1U << j
                   : 0U;
  return static_cast<std::uint16_t>(as_fine);
}

} // namespace pcl6d::moving_objects
