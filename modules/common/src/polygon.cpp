// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/plane.h>
#include <pcl6d/common/polygon.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d {
namespace {
constexpr double kUnbounded = std::numeric_limits<double>::infinity();

struct Interval {
  double low = kUnbounded;
  double high = -kUnbounded;
};

Interval
intervalAlong(const std::vector<Eigen::Vector3d>& corners,
              const Eigen::Vector3d& direction)
{
  Interval interval;
  for (const auto& corner : corners) {
    interval.low = std::min(interval.low, corner.dot(direction));
    interval.high = std::max(interval.high, corner.dot(direction));
  }
  return interval;
}

bool
apartAlong(const std::vector<Eigen::Vector3d>& a,
           const std::vector<Eigen::Vector3d>& b,
           const Eigen::Vector3d& direction,
           double margin)
{
  const Interval of_a = intervalAlong(a, direction);
  const Interval of_b = intervalAlong(b, direction);
  return of_a.low > of_b.high + margin || of_b.low > of_a.high + margin;
}

// Distance of the segments p + s u and q + t v, s and t in [0, 1].
double
segmentDistance(const Eigen::Vector3d& p,
                const Eigen::Vector3d& u,
                const Eigen::Vector3d& q,
                const Eigen::Vector3d& v)
{
  const Eigen::Vector3d w = p - q;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v);
  const double determinant = uu * vv - uv * uv;
  double s = determinant > 1e-12 * uu * vv
                 ? std::clamp((uv * v.dot(w) - vv * u.dot(w)) / determinant, 0.0, 1.0)
                 : 0.0;
  const double t = vv > 0 ? std::clamp((v.dot(w) + s * uv) / vv, 0.0, 1.0) : 0.0;
  s = uu > 0 ? std::clamp((t * uv - u.dot(w)) / uu, 0.0, 1.0) : 0.0;
  return (w + s * u - t * v).norm();
}

// Whether the edge crosses the inside of the polygon.
bool
crosses(const std::vector<Eigen::Vector3d>& polygon,
        const Eigen::Vector3d& normal,
        const Eigen::Vector3d& from,
        const Eigen::Vector3d& to)
{
  const double a = normal.dot(from - polygon.front());
  const double b = normal.dot(to - polygon.front());
  if (a * b > 0 || a == b)
    return false;
  return isInside(polygon, normal, from + a / (a - b) * (to - from), 0);
}

double
distanceToInside(const std::vector<Eigen::Vector3d>& polygon,
                 const Eigen::Vector3d& normal,
                 const Eigen::Vector3d& point)
{
  return isInside(polygon, normal, point, 0)
             ? std::abs(normal.dot(point - polygon.front()))
             : kUnbounded;
}
struct Corner {
  Eigen::Vector2d flat; // in the basis of the plane
  std::size_t index;
};

// One side of the hull of sorted corners; the last corner belongs to the opposite side.
template <typename Iterator>
void
appendChain(Iterator begin, Iterator end, double tolerance, std::vector<Corner>& hull)
{
  const std::size_t first = hull.size();
  for (auto corner = begin; corner != end; ++corner) {
    while (hull.size() >= first + 2 &&
           leftTurn(hull[hull.size() - 2].flat, hull.back().flat, corner->flat) <=
               tolerance)
      hull.pop_back();
    hull.push_back(*corner);
  }
  hull.pop_back();
}
} // namespace

double
signedArea(const std::vector<Eigen::Vector2d>& ring)
{
  double twice = 0;
  for (std::size_t i = 2; i < ring.size(); ++i)
    twice += leftTurn(ring[0], ring[i - 1], ring[i]);
  return twice / 2;
}

bool
isInside(const std::vector<Eigen::Vector2d>& ring, const Eigen::Vector2d& p)
{
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() - a.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()))
      inside = !inside;
  }
  return inside;
}

bool
isInside(const std::vector<std::vector<Eigen::Vector2d>>& rings,
         const Eigen::Vector2d& p)
{
  return std::count_if(rings.begin(),
                       rings.end(),
                       [&](const auto& ring) { return isInside(ring, p); }) %
             2 !=
         0;
}

double
extentAlong(const std::vector<Eigen::Vector3d>& corners,
            const Eigen::Vector3d& direction)
{
  const Interval interval = intervalAlong(corners, direction);
  return corners.empty() ? 0 : interval.high - interval.low;
}

Eigen::Vector3d
centreOfArea(const std::vector<Eigen::Vector3d>& corners)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d weighted = Eigen::Vector3d::Zero();
  double sum = 0;
  for (const auto& corner : corners)
    mean += corner / static_cast<double>(corners.size());
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Eigen::Vector3d u = corners[i - 1] - corners[0], v = corners[i] - corners[0];
    const double area = u.cross(v).norm();
    sum += area;
    weighted += area * (u + v) / 3;
  }
  return sum > 0 ? Eigen::Vector3d(corners[0] + weighted / sum) : mean;
}

bool
apartAcrossEdgesOf(const std::vector<Eigen::Vector3d>& a,
                   const std::vector<Eigen::Vector3d>& b,
                   double margin)
{
  for (std::size_t i = 0; i < a.size(); ++i) {
    Eigen::Vector3d along = a[(i + 1) % a.size()] - a[i];
    along.z() = 0;
    if (along.norm() <= 1e-9)
      continue;
    along.normalize();
    if (apartAlong(a, b, along, margin) ||
        apartAlong(a, b, {-along.y(), along.x(), 0}, margin))
      return true;
  }
  return false;
}

double
hullToHull(const std::vector<Eigen::Vector3d>& a,
           const Eigen::Vector3d& normal,
           const std::vector<Eigen::Vector3d>& b)
{
  double smallest = kUnbounded;
  for (std::size_t j = 0; j < b.size(); ++j) {
    const Eigen::Vector3d& to = b[(j + 1) % b.size()];
    if (crosses(a, normal, b[j], to))
      return 0;
    smallest = std::min(smallest, distanceToInside(a, normal, b[j]));
    for (std::size_t i = 0; i < a.size(); ++i)
      smallest = std::min(
          smallest,
          segmentDistance(a[i], a[(i + 1) % a.size()] - a[i], b[j], to - b[j]));
  }
  return smallest;
}

bool
isInside(const std::vector<Eigen::Vector3d>& polygon,
         const Eigen::Vector3d& normal,
         const Eigen::Vector3d& point,
         double margin)
{
  bool is_left = true, is_right = true; // of all edges
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (edge.norm() <= 0)
      continue;
    const double side = normal.cross(edge.normalized()).dot(point - polygon[i]);
    is_left = is_left && side >= -margin;
    is_right = is_right && side <= margin;
  }
  return polygon.size() > 2 && (is_left || is_right);
}

std::vector<Eigen::Vector3d>
convexHull(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& normal)
{
  if (points.empty())
    return {};
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  std::vector<Corner> corners;
  double size = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p = points[i] - points[0];
    corners.push_back({{u.dot(p), v.dot(p)}, i});
    size = std::max(size, p.norm());
  }
  std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
    return a.flat.x() != b.flat.x() ? a.flat.x() < b.flat.x() : a.flat.y() < b.flat.y();
  });
  const double tolerance = 1e-12 * size * size; // of rounding
  std::vector<Corner> hull;
  appendChain(corners.begin(), corners.end(), tolerance, hull);
  appendChain(corners.rbegin(), corners.rend(), tolerance, hull);
  std::vector<Eigen::Vector3d> result;
  for (const auto& corner : hull)
    result.push_back(points[corner.index]);
  return result;
}

HullPrism::HullPrism(const Plane& plane)
{
  for (std::size_t i = 0; i < plane.hull.size(); ++i) {
    const Eigen::Vector3d& corner = plane.hull[i];
    const Eigen::Vector3d edge = plane.hull[(i + 1) % plane.hull.size()] - corner;
    const Eigen::Vector3d out = edge.cross(plane.normal);
    if (out.norm() > 0)
      sides_.emplace_back() << out.normalized(), -out.normalized().dot(corner);
  }
}

} // namespace pcl6d
