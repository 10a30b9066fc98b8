// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/filters/point_normals.h>
#include <pcl6d/registration/pcl/correspondence_rejector_overlap.h>
#include <pcl6d/registration/pcl/impl/blob_points.h>
#include <pcl6d/search/pcl/core_search.h>

#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl6d {
using namespace registration;

namespace {
constexpr double kFullTurn = 6.283185307179586;

/** \return the largest gap between directions, once around [rad] \param[in] angles > 0 */
double
largestGap(std::vector<double> angles)
{
  std::sort(angles.begin(), angles.end());
  double gap = kFullTurn - (angles.back() - angles.front());
  for (std::size_t i = 1; i < angles.size(); ++i)
    gap = std::max(gap, angles[i] - angles[i - 1]);
  return gap;
}
} // namespace

void
CorrespondenceRejectorOverlap::setBoundaryAngle(double angle)
{
  require(angle > 0 && angle < kFullTurn, "boundary angle", angle, "in (0, 2 pi)");
  angle_ = angle;
  forget();
}

void
CorrespondenceRejectorOverlap::setKSearch(int neighbours)
{
  require(neighbours > 2, "neighbours", neighbours, "> 2");
  neighbours_ = neighbours;
  forget();
}

void
CorrespondenceRejectorOverlap::setRadiusSearch(double radius)
{
  require(radius >= 0, "radius", radius, ">= 0");
  radius_ = radius;
  forget();
}

void
CorrespondenceRejectorOverlap::setTargetPoints(pcl::PCLPointCloud2::ConstPtr cloud)
{
  setTarget(toPoints(*cloudOfBlob<pcl::PointXYZ>(cloud, "x")));
}

void
CorrespondenceRejectorOverlap::setTarget(Points points)
{
  const Eigen::Vector3f origin = localOrigin(points);
  for (auto& p : points)
    p -= origin;
  if (tree_ && points == target_)
    return; // pipelines pass one target for every source: results stay valid
  target_ = std::move(points);
  tree_ = std::make_shared<const PointTree>(target_, num_threads_);
  forget();
}

void
CorrespondenceRejectorOverlap::forget()
{
  places_.assign(target_.size(), Place::kUnknown);
}

CorrespondenceRejectorOverlap::Place
CorrespondenceRejectorOverlap::placeOf(const Eigen::Vector3f& point) const
{
  const auto nearest =
      radius_ > 0 ? tree_->withinRadius(point, squaredLimit(radius_))
                  : tree_->nearestK(point, static_cast<std::size_t>(neighbours_));
  const Eigen::Vector3f normal = normalOf(point, nearest, target_);
  if (normal.isZero(0))
    return Place::kBoundary; // too few, or on one line
  const Eigen::Vector3d n = normal.cast<double>();
  const Eigen::Vector3d u = n.unitOrthogonal(), v = n.cross(u);
  std::vector<double> angles;
  for (const auto& near : nearest) {
    const Eigen::Vector3d d =
        (target_[static_cast<std::size_t>(near.index)] - point).cast<double>();
    const double x = u.dot(d), y = v.dot(d);
    if (x != 0 || y != 0)
      angles.push_back(portableAtan2(y, x));
  }
  return angles.empty() || largestGap(std::move(angles)) > angle_ ? Place::kBoundary
                                                                  : Place::kInside;
}

/** Tests the points not tested yet. */
void
CorrespondenceRejectorOverlap::evaluate(std::vector<int> indices)
{
  const auto is_known = [this](int i) {
    return places_[static_cast<std::size_t>(i)] != Place::kUnknown;
  };
  indices.erase(std::remove_if(indices.begin(), indices.end(), is_known),
                indices.end());
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  constexpr std::size_t kPoints = 64;
  parallelBlocks(indices.size(), kPoints, num_threads_, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const auto index = static_cast<std::size_t>(indices[i]);
      places_[index] = placeOf(target_[index]);
    }
  });
}

bool
CorrespondenceRejectorOverlap::isBoundary(int index)
{
  requireIndices({index}, target_.size());
  evaluate({index});
  return places_[static_cast<std::size_t>(index)] == Place::kBoundary;
}

pcl::Correspondences
CorrespondenceRejectorOverlap::select(const pcl::Correspondences& original)
{
  if (!tree_)
    throw BadArgument(this->rejection_name_ + ": no target is set");
  const pcl::Correspondences pairs = usablePairs(original);
  std::vector<int> partners;
  for (const auto& pair : pairs)
    partners.push_back(pair.index_match);
  requireIndices(partners, target_.size());
  evaluate(partners);
  pcl::Correspondences kept;
  for (const auto& pair : pairs)
    if (places_[static_cast<std::size_t>(pair.index_match)] == Place::kInside)
      kept.push_back(pair);
  return kept;
}

} // namespace pcl6d
