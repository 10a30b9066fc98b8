// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/common/plane.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl6d {
namespace {
struct Corner {
  Eigen::Vector2d flat; // in the basis of the plane
  std::size_t index;
};

// Twice the signed area of the triangle; positive if it turns to the left.
double
turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
  const Eigen::Vector2d u = b - a;
  const Eigen::Vector2d v = c - a;
  return u.x() * v.y() - u.y() * v.x();
}

// One side of the hull of sorted corners, its last corner left to the other side.
template <typename Iterator>
void
appendChain(Iterator begin, Iterator end, double tolerance, std::vector<Corner>& hull)
{
  const std::size_t first = hull.size();
  for (auto corner = begin; corner != end; ++corner) {
    while (hull.size() >= first + 2 &&
           turn(hull[hull.size() - 2].flat, hull.back().flat, corner->flat) <=
               tolerance)
      hull.pop_back();
    hull.push_back(*corner);
  }
  hull.pop_back();
}
} // namespace

const char*
toString(PlaneLabel label)
{
  return nameOf(kPlaneLabels, label, "none");
}

void
orientPlane(Plane& plane)
{
  constexpr double kThroughOrigin = 1e-12; // [m]
  bool turned = plane.offset < 0;
  if (std::abs(plane.offset) <= kThroughOrigin) {
    const auto first =
        std::find_if(plane.normal.data(), plane.normal.data() + 3, [](double value) {
          return std::abs(value) > 1e-12;
        });
    turned = first != plane.normal.data() + 3 && *first < 0;
  }
  if (turned) {
    plane.normal = -plane.normal;
    plane.offset = -plane.offset;
    std::reverse(plane.hull.begin(), plane.hull.end());
  }
  plane.normal.array() += 0.0; // no -0
  plane.offset = std::abs(plane.offset);
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

} // namespace pcl6d
