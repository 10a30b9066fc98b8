// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/interruption.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/line_growth.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/registration/ndt.h>

#include <cmath>
#include <optional>

namespace pcl6d {

namespace {
/** Least ratio of the smaller variances to the largest: planes keep a thickness (Magnusson 2009,
 * 6.2.2: a hundredth, like in PCL). */
constexpr double kLeastVariance = 0.01;
/** Standard deviations of the points of a cell, the second by the first, up to which the points lie
 * on one line, and above which a grown neighbourhood is a surface: the values for normals
 * (share/doc/sampling.md, Normals). */
constexpr double kLineOfCell = 0.3, kSurfaceOfCell = 0.5;
/** The radii of a growing neighbourhood, in sides of a cell: from just above a cell's volume to
 * points in the adjacent cells. */
constexpr double kFirstRadius = 0.75, kLastRadius = 2, kRadiusStep = 0.25;

/** \return whether the points of a neighbourhood spread along a line only
 * \param[in] spread squared spreads, ascending */
bool
isNarrow(const Eigen::Vector3d& spread, double ratio)
{
  return !(spread(1) > ratio * ratio * spread(2));
}

struct Neighbourhood {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  SymmetricEigen<3> covariance;
};

/** \param[in] indices at least 2 */
template <typename Indices>
Neighbourhood
neighbourhoodOf(const Points& points, const Indices& indices)
{
  const auto count = static_cast<double>(indices.size());
  Neighbourhood found;
  for (const auto i : indices)
    found.mean += points[static_cast<std::size_t>(i)].cast<double>() / count;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto i : indices) {
    const Eigen::Vector3d d =
        points[static_cast<std::size_t>(i)].cast<double>() - found.mean;
    scatter += d * d.transpose();
  }
  found.covariance = symmetricEigen<3>(scatter / (count - 1));
  return found;
}

/** \return the covariance of the smallest neighbourhood of a place that is at least half as wide as
 * long, if thin enough for a plane; else empty */
std::optional<SymmetricEigen<3>>
grownPlane(const Eigen::Vector3d& place,
           const Points& points,
           const PointTree& tree,
           double resolution)
{
  for (double r = kFirstRadius; r <= kLastRadius; r += kRadiusStep) {
    const double radius = r * resolution;
    std::vector<int> indices;
    for (const Neighbour& n :
         tree.withinRadius(place.cast<float>(), static_cast<float>(radius * radius)))
      indices.push_back(n.index);
    if (indices.size() < 3)
      continue;
    const auto grown = neighbourhoodOf(points, indices).covariance;
    if (isNarrow(grown.values, kSurfaceOfCell))
      continue;
    if (grown.values(0) > kLeastVariance * grown.values(2))
      break;
    return grown;
  }
  return std::nullopt;
}

/** A cell with its points on one line has no plane: it gets the covariance of the neighbourhood
 * grown across lines, or the variance along the line in every direction.
 * \param[in] tree over the points; null: the cell keeps the covariance of its own points */
std::optional<Distribution>
distributionOf(const Points& points,
               const IndexRange& members,
               const PointTree* tree,
               double resolution)
{
  const Neighbourhood own = neighbourhoodOf(points, members);
  SymmetricEigen<3> eigen = own.covariance;
  const double along = eigen.values(2);
  if (!(along > 0) || !std::isfinite(along))
    return std::nullopt;
  if (tree && isNarrow(eigen.values, kLineOfCell)) {
    if (const auto plane = grownPlane(own.mean, points, *tree, resolution))
      eigen = *plane;
    else
      eigen.values.setConstant(along);
  }
  Distribution found;
  found.mean = own.mean;
  const Eigen::Vector3d variances =
      eigen.values.cwiseMax(kLeastVariance * eigen.values(2));
  const Eigen::Vector3d inverse = variances.cwiseInverse();
  found.information = eigen.vectors * inverse.asDiagonal() * eigen.vectors.transpose();
  const Eigen::Vector3d form =
      (inverse.array() - inverse(2)).matrix() / inverse(0); // the widest is the last
  found.form = eigen.vectors * form.asDiagonal() * eigen.vectors.transpose();
  return found;
}

Points
meansOf(const std::vector<Distribution>& distributions)
{
  Points means;
  for (const auto& d : distributions)
    means.push_back(d.mean.cast<float>());
  return means;
}

std::vector<Distribution>
distributionsOf(const Points& points,
                double resolution,
                std::size_t least_points,
                LineGrowth growth)
{
  require(resolution > 0 && std::isfinite(resolution),
          "resolution",
          resolution,
          "finite and > 0");
  require(least_points >= 3, "least_points", least_points, ">= 3");
  const VoxelGroups groups(points, resolution);
  std::optional<PointTree> tree;
  if (growsAcrossLines(points, Eigen::Vector3f::Zero(), growth))
    tree.emplace(points);
  std::vector<Distribution> found;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    throwIfStopped();
    if (groups.indices(g).size() >= least_points)
      if (const auto distribution = distributionOf(
              points, groups.indices(g), tree ? &*tree : nullptr, resolution))
        found.push_back(*distribution);
  }
  return found;
}
} // namespace

DistributionGrid::DistributionGrid(const Points& points,
                                   double resolution,
                                   std::size_t least_points,
                                   LineGrowth growth)
: resolution_(resolution)
, distributions_(distributionsOf(points, resolution, least_points, growth))
, tree_(meansOf(distributions_))
{}

} // namespace pcl6d
