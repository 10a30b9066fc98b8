// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/polygon.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

namespace pcl6d {
namespace {
struct RingCorner {
  Eigen::Vector2d at;
  std::uint32_t index = 0;
};

using Ring = std::vector<RingCorner>;

double
signedArea(const Ring& ring)
{
  double sum = 0;
  for (std::size_t i = 2; i < ring.size(); ++i)
    sum += leftTurn(ring[0].at, ring[i - 1].at, ring[i].at);
  return sum / 2;
}

bool
isInTriangle(const Eigen::Vector2d& p,
             const Eigen::Vector2d& a,
             const Eigen::Vector2d& b,
             const Eigen::Vector2d& c)
{
  return leftTurn(a, b, p) >= 0 && leftTurn(b, c, p) >= 0 && leftTurn(c, a, p) >= 0;
}

// Whether the way from a corner to a point starts inside the ring. Among the copies of a corner
// made by a cut, selects the copy on the right side of the cut.
bool
startsInside(const Ring& ring, std::size_t i, const Eigen::Vector2d& point)
{
  const Eigen::Vector2d& a = ring[(i + ring.size() - 1) % ring.size()].at;
  const Eigen::Vector2d& b = ring[i].at;
  const Eigen::Vector2d& c = ring[(i + 1) % ring.size()].at;
  const bool is_left_before = leftTurn(a, b, point) >= 0;
  const bool is_left_after = leftTurn(b, c, point) >= 0;
  return leftTurn(a, b, c) > 0 ? is_left_before && is_left_after
                               : is_left_before || is_left_after;
}

// The corner of the ring that is visible from a point: of the nearest edge to the right, or, if
// another corner is in between, the corner nearest to the level of the point.
std::size_t
visibleCorner(const Ring& ring, const Eigen::Vector2d& point)
{
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t best = ring.size();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d& a = ring[i].at;
    const Eigen::Vector2d& b = ring[(i + 1) % ring.size()].at;
    if (a.y() > point.y() || b.y() < point.y() || a.y() == b.y())
      continue; // edges with the inside on their left go up here
    const double x = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (x < point.x() || x >= nearest)
      continue;
    nearest = x;
    best = a.x() > b.x() ? i : (i + 1) % ring.size();
  }
  if (best == ring.size())
    return 0;
  const Eigen::Vector2d hit(nearest, point.y());
  const Eigen::Vector2d corner = ring[best].at;
  double least = std::numeric_limits<double>::infinity();
  std::size_t chosen = best;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d& p = ring[i].at;
    // A triangle without area contains every point of the line, so the end is tested too.
    if (p.x() > std::max(hit.x(), corner.x()) || !startsInside(ring, i, point) ||
        !(isInTriangle(p, point, hit, corner) || isInTriangle(p, point, corner, hit)))
      continue;
    const Eigen::Vector2d d = p - point;
    const double slope =
        d.x() > 0 ? std::abs(d.y()) / d.x() : std::numeric_limits<double>::infinity();
    if (slope < least) {
      least = slope;
      chosen = i;
    }
  }
  return chosen;
}

// Opens the ring at a corner and inserts the hole.
void
joinHole(Ring& ring, const Ring& hole)
{
  const auto rightmost = std::max_element(
      hole.begin(), hole.end(), [](const RingCorner& a, const RingCorner& b) {
        return a.at.x() < b.at.x();
      });
  const std::size_t corner = visibleCorner(ring, rightmost->at);
  Ring way(rightmost, hole.end());
  way.insert(way.end(), hole.begin(), rightmost + 1);
  way.push_back(ring[corner]);
  ring.insert(
      ring.begin() + static_cast<std::ptrdiff_t>(corner) + 1, way.begin(), way.end());
}

bool
isEar(const Ring& ring, std::size_t i)
{
  const std::size_t n = ring.size();
  const Eigen::Vector2d& a = ring[(i + n - 1) % n].at;
  const Eigen::Vector2d& b = ring[i].at;
  const Eigen::Vector2d& c = ring[(i + 1) % n].at;
  if (leftTurn(a, b, c) <= 0)
    return false;
  const Eigen::Vector2d low = a.cwiseMin(b).cwiseMin(c);
  const Eigen::Vector2d high = a.cwiseMax(b).cwiseMax(c);
  return std::none_of(ring.begin(), ring.end(), [&](const RingCorner& corner) {
    const Eigen::Vector2d& p = corner.at;
    return p.x() >= low.x() && p.x() <= high.x() && p.y() >= low.y() &&
           p.y() <= high.y() && p != a && p != b && p != c && isInTriangle(p, a, b, c);
  });
}

void
clipEars(Ring ring, std::vector<std::array<std::uint32_t, 3>>& triangles)
{
  std::size_t i = 0, tried = 0;
  while (ring.size() >= 3) {
    const std::size_t n = ring.size();
    i %= n;
    // If rounding left no ear, the next corner is cut off regardless.
    if (tried < n && n > 3 && !isEar(ring, i)) {
      ++i;
      ++tried;
      continue;
    }
    triangles.push_back(
        {ring[(i + n - 1) % n].index, ring[i].index, ring[(i + 1) % n].index});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
    tried = 0;
    ++i; // not a fan from one corner
  }
}

void
clipWithHoles(Ring outer,
              std::vector<Ring> holes,
              std::vector<std::array<std::uint32_t, 3>>& triangles)
{
  const auto rightEnd = [](const Ring& ring) {
    double x = -std::numeric_limits<double>::infinity();
    for (const auto& corner : ring)
      x = std::max(x, corner.at.x());
    return x;
  };
  std::stable_sort(holes.begin(), holes.end(), [&](const Ring& a, const Ring& b) {
    return rightEnd(a) > rightEnd(b);
  });
  for (const auto& hole : holes)
    joinHole(outer, hole);
  clipEars(std::move(outer), triangles);
}
} // namespace

std::vector<std::array<std::uint32_t, 3>>
triangulate(const std::vector<std::vector<Eigen::Vector3d>>& rings,
            const Eigen::Vector3d& normal)
{
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  Ring outer;
  std::vector<Ring> holes;
  std::uint32_t index = 0;
  for (const auto& corners : rings) {
    Ring ring;
    for (const auto& corner : corners)
      ring.push_back({{u.dot(corner), v.dot(corner)}, index++});
    if (ring.size() < 3)
      continue;
    if (signedArea(ring) < 0) {
      if (!outer.empty())
        holes.push_back(std::move(ring));
      continue;
    }
    clipWithHoles(std::move(outer), std::move(holes), triangles);
    outer = std::move(ring);
    holes.clear();
  }
  clipWithHoles(std::move(outer), std::move(holes), triangles);
  return triangles;
}

} // namespace pcl6d
