// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/median.h>
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

/** \return the mean direction of points; its length is near 1 for a narrow view and
 * near 0 for a view all around */
Eigen::Vector3d
meanDirection(const Points& points)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& p : points)
    if (p.squaredNorm() > 0)
      sum += p.cast<double>().normalized();
  return sum / static_cast<double>(points.size());
}

/** Cells one to two angular spacings wide. Noise is taken from the surface at the
 * query. */
RayImageOptions
imageOptions(double angular_spacing)
{
  RayImageOptions options;
  options.noise = 0;
  options.finest = std::max(0.001, angular_spacing);
  options.coarsest = 2 * options.finest;
  return options;
}

constexpr double kNarrow = 0.5; // length of the mean direction
} // namespace

LocalizationScene::LocalizationScene(const Points& points, unsigned int num_threads)
: points_(finiteOf(points))
, tree_(points_, num_threads)
, angular_spacing_(angularSpacingOf(points_, tree_))
, rays_(points_, imageOptions(angular_spacing_))
, is_narrow_(meanDirection(points_).norm() >= kNarrow)
{}

} // namespace pcl6d
