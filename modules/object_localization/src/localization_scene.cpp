// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/median.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/object_localization/localization_scene.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
Points
finiteOf(const Points& points)
{
  Points finite;
  for (const auto& p : points)
    if (p.allFinite())
      finite.push_back(p);
  require(finite.size() >= 10, "finite points of the scan", finite.size(), ">= 10");
  return finite;
}

double
angularSpacingOf(const Points& points, const PointTree& tree)
{
  constexpr std::size_t kSamples = 2000;
  const std::size_t stride = std::max<std::size_t>(points.size() / kSamples, 1);
  std::vector<double> spacings;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    Neighbour near[2];
    const double range = points[i].norm();
    if (range > 0 && tree.nearestK(points[i], 2, near) == 2 && near[1].distance_sq > 0)
      spacings.push_back(std::sqrt(double{near[1].distance_sq}) / range);
  }
  constexpr double kCoarsest = 0.05; // [rad]
  return spacings.empty() ? kCoarsest
                          : std::min(upperMedian(std::move(spacings)), kCoarsest);
}

/** \return the mean of the directions to points; its length is 1 in a narrow view and 0 all
 * around */
Eigen::Vector3d
meanDirection(const Points& points)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& p : points)
    if (p.squaredNorm() > 0)
      sum += p.cast<double>().normalized();
  return sum / static_cast<double>(points.size());
}

constexpr double kNarrow = 0.5; // length of the mean direction

/** A frame that looks along x to the middle of a narrow view, such as that of a depth
 * camera, whose own z axis may point forwards; the scan's own frame for a wide one. */
Eigen::Matrix3d
lookAlong(const Eigen::Vector3d& direction)
{
  if (direction.norm() < kNarrow)
    return Eigen::Matrix3d::Identity();
  const Eigen::Vector3d x = direction.normalized();
  const Eigen::Vector3d up =
      std::abs(x.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
  Eigen::Matrix3d R;
  R.col(0) = x;
  R.col(1) = up.cross(x).normalized();
  R.col(2) = x.cross(R.col(1));
  return R;
}

/** The part of the sphere that has points, in pixels of an angle. */
ImageView
viewOf(const Points& points, double pixel)
{
  ImageView view;
  view.T_scan_view.linear() = lookAlong(meanDirection(points));
  const Eigen::Matrix3d R_view_scan = view.T_scan_view.linear().transpose();
  Eigen::AlignedBox2d angles;
  for (const auto& point : points) {
    const Eigen::Vector3d p = R_view_scan * point.cast<double>();
    const double across = std::sqrt(p.x() * p.x() + p.y() * p.y());
    angles.extend(
        Eigen::Vector2d(portableAtan2(p.y(), p.x()), portableAtan2(p.z(), across)));
  }
  const Eigen::Vector2d limit(M_PI, 0.5 * M_PI);
  const Eigen::Vector2d rim = Eigen::Vector2d::Constant(2 * pixel);
  const Eigen::Vector2d low = (angles.min() - rim).cwiseMax(-limit);
  const Eigen::Vector2d high = (angles.max() + rim).cwiseMin(limit);
  constexpr double kMostPixels = 4e6;
  const double count = (high - low).prod() / (pixel * pixel);
  if (count > kMostPixels)
    pixel *= std::sqrt(count / kMostPixels);
  view.left = high.x();
  view.right = low.x();
  view.top = high.y();
  view.bottom = low.y();
  view.cols = std::max(static_cast<int>((high - low).x() / pixel), 1);
  view.rows = std::max(static_cast<int>((high - low).y() / pixel), 1);
  return view;
}
} // namespace

LocalizationScene::LocalizationScene(const Points& points, unsigned int num_threads)
: points_(finiteOf(points))
, tree_(points_, num_threads)
, angular_spacing_(angularSpacingOf(points_, tree_))
, is_narrow_(meanDirection(points_).norm() >= kNarrow)
{
  RangeImageOptions options;
  options.num_threads = num_threads;
  ranges_ = std::make_unique<const RangeImage>(RangeImage::project(
      points_,
      std::make_shared<SphericalProjection>(viewOf(points_, 2 * angular_spacing_)),
      options));
}

} // namespace pcl6d
