// SPDX-License-Identifier: BSD-3-Clause
#include "planes/contour.h"
#include "planes/plane_outline.h"

#include <pcl6d/common/polygon.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl6d::plane_segmentation {

namespace {
constexpr double kCellsPerRadius = 4;
constexpr double kMostCells = 800; // along an edge; a wider plane has wider cells

/** Points on a plane in a raster with room for discs around them. */
class FlatMap {
public:
  FlatMap(const Eigen::Vector3d& origin,
          const Eigen::Vector3d& normal,
          const std::vector<Eigen::Vector3d>& places,
          double radius)
  : origin_(origin), u_(normal.unitOrthogonal()), v_(normal.cross(u_))
  {
    Eigen::Vector2d low = flat(places[0]), high = low;
    for (const auto& p : places) {
      low = low.cwiseMin(flat(p));
      high = high.cwiseMax(flat(p));
    }
    cell_ = std::max(radius / kCellsPerRadius, (high - low).maxCoeff() / kMostCells);
    radius_ = std::max(radius, 2 * cell_) / cell_;
    const double margin = std::ceil(radius_) + 2;
    low_ = low - Eigen::Vector2d::Constant(margin * cell_);
    const Eigen::Vector2d size = (high - low) / cell_;
    width_ = static_cast<std::size_t>(size.x() + 2 * margin) + 1;
    height_ = static_cast<std::size_t>(size.y() + 2 * margin) + 1;
    Raster<char> occupied(width_, height_, 0);
    for (const auto& p : places) {
      const Eigen::Vector2d at = (flat(p) - low_) / cell_;
      occupied.at(static_cast<std::size_t>(at.x() + 0.5),
                  static_cast<std::size_t>(at.y() + 0.5)) = 1;
    }
    Raster<char> outside(width_, height_, 0);
    const Raster<float> to_points = distanceField(occupied);
    for (std::size_t i = 0; i < outside.cells.size(); ++i)
      outside.cells[i] = to_points.cells[i] > radius_;
    depth_ = distanceField(outside).cells;
  }

  /** \return the rings around the points. \param[in] rim [m] extent of the surface
   * beyond the outermost points */
  std::vector<Ring>
  rings(double rim) const
  {
    constexpr double kHalfCell = 0.5; // from the last centre inside to the boundary
    const double level = std::max(1.0, radius_ + kHalfCell - rim / cell_);
    Raster<float> field(width_, height_, 0);
    field.cells = depth_;
    std::vector<Ring> all;
    for (const auto& ring : contours(field, static_cast<float>(level))) {
      Ring corners = simplified(ring, kHalfCell);
      if (corners.size() >= 3)
        all.push_back(std::move(corners));
    }
    return nested(std::move(all));
  }

  double
  areaOf(const std::vector<Ring>& rings) const
  {
    double cells = 0;
    for (const auto& ring : rings)
      cells += signedArea(ring);
    return cells * cell_ * cell_;
  }

  Eigen::Vector3d
  place(const Eigen::Vector2d& corner) const
  {
    const Eigen::Vector2d p = low_ + cell_ * corner;
    return origin_ + p.x() * u_ + p.y() * v_;
  }

private:
  Eigen::Vector2d
  flat(const Eigen::Vector3d& p) const
  {
    return {u_.dot(p - origin_), v_.dot(p - origin_)};
  }

  Eigen::Vector3d origin_, u_, v_;
  Eigen::Vector2d low_;
  double cell_ = 1;   // [m]
  double radius_ = 1; // [cells]
  std::size_t width_ = 0, height_ = 0;
  std::vector<float> depth_; // [cells] of each inside the union of the discs
};
} // namespace

void
addHulls(PlaneSegment& segment,
         const std::vector<Eigen::Vector3d>& places,
         double radius)
{
  const Eigen::Vector3d& normal = segment.plane.normal;
  std::vector<Eigen::Vector3d> on_plane;
  on_plane.reserve(places.size());
  for (const auto& p : places)
    on_plane.push_back(p - (normal.dot(p) - segment.plane.offset) * normal);
  segment.plane.hull = convexHull(on_plane, normal);
  const FlatMap map(segment.plane.hull.front(), normal, on_plane, radius);
  const double first_area = map.areaOf(map.rings(0));
  const double spacing =
      std::sqrt(std::max(0.0, first_area) / static_cast<double>(places.size()));
  const auto rings = map.rings(std::min(spacing / 2, radius / 2));
  segment.plane.area = map.areaOf(rings);
  segment.outline.clear();
  for (const auto& ring : rings) {
    segment.outline.emplace_back();
    for (const auto& corner : ring)
      segment.outline.back().push_back(map.place(corner));
  }
}

} // namespace pcl6d::plane_segmentation
