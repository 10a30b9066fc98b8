// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/common/polygon.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/scene_interpretation/scene_plane.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
namespace {
constexpr Named<Measure> kMeasures[] = {{Measure::kArea, "area"},
                                        {Measure::kWidth, "width"},
                                        {Measure::kLength, "length"},
                                        {Measure::kHeight, "height"},
                                        {Measure::kInclination, "inclination"},
                                        {Measure::kBottom, "bottom"},
                                        {Measure::kTop, "top"},
                                        {Measure::kGapToCeiling, "gap_to_ceiling"}};

// Extents along and across the plane's horizontal line.
void
measureUpright(ScenePlane& plane)
{
  const Eigen::Vector3d along =
      Eigen::Vector3d(-plane.normal.y(), plane.normal.x(), 0).normalized();
  plane.width = extentAlong(plane.corners, along);
  plane.length = extentAlong(plane.corners, plane.normal.cross(along));
}

// Sides of the smallest rectangle around the hull; one side lies along an edge of the
// hull.
void
measureLevel(ScenePlane& plane)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < plane.corners.size(); ++i) {
    const Eigen::Vector3d edge =
        plane.corners[(i + 1) % plane.corners.size()] - plane.corners[i];
    if (edge.norm() <= 0)
      continue;
    const Eigen::Vector3d along = edge.normalized();
    const double a = extentAlong(plane.corners, along);
    const double b = extentAlong(plane.corners, plane.normal.cross(along));
    if (a * b >= smallest)
      continue;
    smallest = a * b;
    plane.width = std::min(a, b);
    plane.length = std::max(a, b);
  }
}
} // namespace

ScenePlane
levelledPlane(const Plane& plane,
              const Eigen::Matrix3d& R_level_map,
              const Eigen::Vector3d& seen_from)
{
  constexpr double kLevel = 0.9848; // cos 10 deg
  ScenePlane levelled;
  levelled.normal = R_level_map * plane.normal;
  levelled.side_known = plane.normal.dot(seen_from) != 0;
  if (plane.normal.dot(seen_from) < 0)
    levelled.normal = -levelled.normal;
  for (const auto& corner : plane.hull)
    levelled.corners.push_back(R_level_map * corner);
  if (levelled.corners.empty())
    levelled.corners.push_back(R_level_map * (plane.offset * plane.normal));
  levelled.centre = centreOfArea(levelled.corners);
  levelled.area = plane.area;
  levelled.inclination = portableAcos(std::min(1.0, std::abs(levelled.normal.z())));
  levelled.bottom = levelled.top = levelled.corners.front().z();
  for (const auto& corner : levelled.corners) {
    levelled.bottom = std::min(levelled.bottom, corner.z());
    levelled.top = std::max(levelled.top, corner.z());
  }
  if (std::abs(levelled.normal.z()) > kLevel)
    measureLevel(levelled);
  else
    measureUpright(levelled);
  return levelled;
}

const char*
toString(Measure measure)
{
  return nameOf(kMeasures, measure);
}

std::optional<Measure>
measureFromName(const std::string& name)
{
  return findNamed(kMeasures, name);
}

std::optional<double>
measured(Measure measure, const ScenePlane& plane)
{
  switch (measure) {
  case Measure::kArea:
    return plane.area;
  case Measure::kWidth:
    return plane.width;
  case Measure::kLength:
    return plane.length;
  case Measure::kHeight:
    return plane.top - plane.bottom;
  case Measure::kInclination:
    return plane.inclination;
  case Measure::kBottom:
    if (plane.floor)
      return plane.bottom - *plane.floor;
    break;
  case Measure::kTop:
    if (plane.floor)
      return plane.top - *plane.floor;
    break;
  case Measure::kGapToCeiling:
    if (plane.ceiling)
      return *plane.ceiling - plane.top;
    break;
  }
  return {};
}

bool
overlapInPlan(const ScenePlane& a, const ScenePlane& b, double margin)
{
  return !apartAcrossEdgesOf(a.corners, b.corners, margin) &&
         !apartAcrossEdgesOf(b.corners, a.corners, margin);
}

double
hullDistance(const ScenePlane& a, const ScenePlane& b)
{
  return std::min(hullToHull(a.corners, a.normal, b.corners),
                  hullToHull(b.corners, b.normal, a.corners));
}

} // namespace pcl6d
