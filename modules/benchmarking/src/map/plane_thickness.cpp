// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/benchmarking/plane_thickness.h>
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/median.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/polygon.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d {
namespace {
/** \brief A bounded plane, seen from one side, with a test for its points. */
class PlanePatch {
public:
  /** \param[in] segment with a hull of at least 3 corners
   * \param[in] gate [m] \param[in] max_angle [rad] between normals */
  PlanePatch(const PlaneSegment& segment, double gate, double max_angle);

  /** \return the signed distance to the plane [m] */
  double
  distanceOf(const Eigen::Vector3f& p) const
  {
    return normal_.dot(p.cast<double>()) - offset_;
  }

  /** \return whether the middle of another patch lies within the hull and the gate, and
   * both normals point the same way */
  bool
  covers(const PlanePatch& other) const;

  /** \return the points over the outline, within the gate, with normals on the patch's
   * side; ascending */
  std::vector<std::size_t>
  membersOf(const MapPoints& map) const;

  /** \brief Lays the plane through points by least squares; hull and outline stay. */
  void
  fit(const Points& points, const std::vector<std::size_t>& members);

  /** \return the plane, oriented by orientPlane(), with the hull projected onto the plane */
  Plane
  plane() const;

private:
  using Ring = std::vector<Eigen::Vector2d>;
  using Rings = std::vector<Ring>;

  Eigen::Vector2d
  onPlane(const Eigen::Vector3d& p) const
  {
    return axes_ * (p - centre_);
  }
  bool
  isNear(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

  Plane given_;
  double gate_;
  double min_cosine_;
  Eigen::Vector3d normal_; ///< towards its observer
  double offset_;
  Eigen::Vector3d centre_;           ///< mean of the hull's corners [m]
  double radius_ = 0;                ///< [m] of the hull about its centre
  Eigen::Matrix<double, 2, 3> axes_; ///< of the given plane
  Rings hull_;                       ///< one ring
  Rings outline_;                    ///< outer rings and holes
};

PlanePatch::PlanePatch(const PlaneSegment& segment, double gate, double max_angle)
: given_(segment.plane)
, gate_(gate)
, min_cosine_(portableSinCos(max_angle).cos)
, centre_(Eigen::Vector3d::Zero())
{
  const double side = segment.seen_from.dot(given_.normal) < 0 ? -1 : 1;
  normal_ = side * given_.normal;
  offset_ = side * given_.offset;
  axes_.row(0) = normal_.unitOrthogonal();
  axes_.row(1) = normal_.cross(axes_.row(0).transpose());
  for (const auto& corner : given_.hull)
    centre_ += corner / static_cast<double>(given_.hull.size());
  const auto flat = [&](const std::vector<Eigen::Vector3d>& corners) {
    Ring ring;
    for (const auto& corner : corners)
      ring.push_back(onPlane(corner));
    return ring;
  };
  hull_.push_back(flat(given_.hull));
  for (const auto& corner : hull_.front())
    radius_ = std::max(radius_, corner.norm());
  for (const auto& ring : segment.outline)
    outline_.push_back(flat(ring));
  if (outline_.empty())
    outline_ = hull_;
}

bool
PlanePatch::isNear(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const
{
  return std::abs(normal_.dot(point) - offset_) <= gate_ &&
         normal_.dot(normal) >= min_cosine_;
}

bool
PlanePatch::covers(const PlanePatch& other) const
{
  return isNear(other.centre_, other.normal_) &&
         isInside(hull_, onPlane(other.centre_));
}

std::vector<std::size_t>
PlanePatch::membersOf(const MapPoints& map) const
{
  const double reach = radius_ + gate_;
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const Eigen::Vector3d p = map.points[i].cast<double>();
    if ((p - centre_).squaredNorm() <= reach * reach &&
        isNear(p, map.normals[i].cast<double>()) && isInside(outline_, onPlane(p)))
      members.push_back(i);
  }
  return members;
}

void
PlanePatch::fit(const Points& points, const std::vector<std::size_t>& members)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const std::size_t i : members)
    mean += (points[i].cast<double>() - centre_) / static_cast<double>(members.size());
  mean += centre_;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const std::size_t i : members) {
    const Eigen::Vector3d d = points[i].cast<double>() - mean;
    scatter += d * d.transpose();
  }
  const Eigen::Vector3d normal = symmetricEigen<3>(scatter).vectors.col(0);
  normal_ = normal.dot(normal_) < 0 ? Eigen::Vector3d(-normal) : normal;
  offset_ = normal_.dot(mean);
}

Plane
PlanePatch::plane() const
{
  Plane plane = given_;
  plane.normal = normal_;
  plane.offset = offset_;
  for (auto& corner : plane.hull)
    corner -= (normal_.dot(corner) - offset_) * normal_;
  orientPlane(plane);
  return plane;
}

/** The points of one plane, and their contribution to each scan. */
struct Collected {
  ThickPlane plane;
  std::vector<double> sum_sq; ///< [m^2] per scan
  std::vector<std::size_t> count;
};

void
checkMap(const MapPoints& map, std::size_t num_scans)
{
  require(map.normals.size() == map.points.size(),
          "normals",
          map.normals.size(),
          "one per point");
  require(map.scans.size() == map.points.size(),
          "scans",
          map.scans.size(),
          "one per point");
  for (const std::uint32_t scan : map.scans)
    require(scan < num_scans, "scan of a point", scan, "one of the scans");
}

/** Largest first, without patches on the surface of a larger patch. */
std::vector<PlanePatch>
differentPatches(const std::vector<PlaneSegment>& planes,
                 const PlaneThicknessOptions& options)
{
  std::vector<const PlaneSegment*> by_area;
  for (const PlaneSegment& segment : planes)
    if (segment.plane.area >= options.min_area && segment.plane.hull.size() >= 3)
      by_area.push_back(&segment);
  std::stable_sort(by_area.begin(), by_area.end(), [](const auto* a, const auto* b) {
    return a->plane.area > b->plane.area;
  });
  std::vector<PlanePatch> patches;
  for (const PlaneSegment* segment : by_area) {
    if (patches.size() == options.max_planes)
      break;
    const PlanePatch patch(*segment, options.gate, options.max_angle);
    const bool known =
        std::any_of(patches.begin(), patches.end(), [&](const PlanePatch& larger) {
          return larger.covers(patch);
        });
    if (!known)
      patches.push_back(patch);
  }
  return patches;
}

Collected
collect(PlanePatch patch,
        const MapPoints& map,
        std::size_t num_scans,
        const PlaneThicknessOptions& options)
{
  std::vector<std::size_t> members = patch.membersOf(map);
  for (int round = 0; round < 2 && members.size() >= options.min_points; ++round) {
    patch.fit(map.points, members);
    members = patch.membersOf(map);
  }
  Collected result;
  result.sum_sq.assign(num_scans, 0);
  result.count.assign(num_scans, 0);
  if (members.size() < options.min_points)
    return result;
  double sum_sq = 0;
  for (const std::size_t i : members) {
    const double distance = patch.distanceOf(map.points[i]);
    sum_sq += distance * distance;
    result.sum_sq[map.scans[i]] += distance * distance;
    ++result.count[map.scans[i]];
  }
  ThickPlane& thick = result.plane;
  thick.plane = patch.plane();
  thick.plane.inliers = members.size();
  thick.thickness = std::sqrt(sum_sq / static_cast<double>(members.size()));
  thick.plane.rms = thick.thickness;
  for (const std::size_t count : result.count)
    thick.scans += count > 0;
  return result;
}

PlaneThickness
summedUp(const std::vector<Collected>& collected, std::size_t num_scans)
{
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const auto rmsOf = [&](double sum_sq, std::size_t count) {
    return count > 0 ? std::sqrt(sum_sq / static_cast<double>(count)) : nothing;
  };
  std::vector<double> sum_sq(num_scans, 0), thicknesses;
  std::vector<std::size_t> count(num_scans, 0);
  PlaneThickness result;
  double all_sq = 0;
  std::size_t all = 0;
  for (const Collected& one : collected) {
    if (one.plane.scans < 2)
      continue;
    result.planes.push_back(one.plane);
    thicknesses.push_back(one.plane.thickness);
    for (std::size_t scan = 0; scan < num_scans; ++scan) {
      sum_sq[scan] += one.sum_sq[scan];
      count[scan] += one.count[scan];
    }
  }
  for (std::size_t scan = 0; scan < num_scans; ++scan) {
    result.scans.push_back(rmsOf(sum_sq[scan], count[scan]));
    all_sq += sum_sq[scan];
    all += count[scan];
  }
  result.rms = rmsOf(all_sq, all);
  result.median = thicknesses.empty() ? nothing : upperMedian(thicknesses);
  return result;
}
} // namespace

void
PlaneThicknessOptions::validate() const
{
  require(std::isfinite(gate) && gate > 0, "gate", gate, "finite and > 0");
  require(
      max_angle > 0 && max_angle < M_PI / 2, "max_angle", max_angle, "in (0, pi/2)");
  require(std::isfinite(min_area) && min_area >= 0,
          "min_area",
          min_area,
          "finite and >= 0");
  require(min_points >= 4, "min_points", min_points, ">= 4");
  require(max_planes >= 1, "max_planes", max_planes, ">= 1");
}

PlaneThickness
planeThickness(const std::vector<PlaneSegment>& planes,
               const MapPoints& map,
               std::size_t num_scans,
               const PlaneThicknessOptions& options)
{
  options.validate();
  checkMap(map, num_scans);
  const std::vector<PlanePatch> patches = differentPatches(planes, options);
  std::vector<Collected> collected(patches.size());
  parallelFor(patches.size(), options.num_threads, [&](std::size_t k) {
    collected[k] = collect(patches[k], map, num_scans, options);
  });
  return summedUp(collected, num_scans);
}

} // namespace pcl6d
