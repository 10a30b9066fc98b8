// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>
#include <pcl6d/search/point_tree.h>
#include <pcl6d/visibility/range_noise.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl6d {

namespace {
constexpr std::size_t kNeighbours = 48; ///< of a patch, so that it holds several lines
constexpr std::size_t kPatches = 200;   ///< that are looked at
/** So many points are enough: the first ones, as a part of a scan is as noisy as another,
 * but every n-th point would be as far from the next as the surface bends. */
constexpr std::size_t kMostPoints = 200000;
/** A patch whose second side is a smaller part of the first is one line of the scan, and
 * shows nothing of the surface beside it. */
constexpr double kLeastWidth = 0.1;

/** \return variance across the plane of the patch [m^2], of its own degrees of freedom;
 * negative if the patch is a line */
double
varianceAcross(const Points& points, const std::array<Neighbour, kNeighbours>& patch)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Neighbour& n : patch)
    mean += points[static_cast<std::size_t>(n.index)].cast<double>() / kNeighbours;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Neighbour& n : patch) {
    const Eigen::Vector3d d =
        points[static_cast<std::size_t>(n.index)].cast<double>() - mean;
    scatter += d * d.transpose();
  }
  constexpr double kFreedom = kNeighbours - 3; // a plane takes three
  const Eigen::Vector3d values = symmetricEigenvalues<3>(scatter);
  if (values(1) < kLeastWidth * kLeastWidth * values(2))
    return -1;
  return std::max(values(0), 0.0) / kFreedom;
}
} // namespace

double
rangeNoise(const Points& measured)
{
  const PointTree tree(measured.size() <= kMostPoints
                           ? measured
                           : Points(measured.begin(), measured.begin() + kMostPoints));
  if (tree.size() < kNeighbours)
    return 0;
  const std::size_t count = std::min(measured.size(), kMostPoints);
  const std::size_t stride = std::max<std::size_t>(1, count / kPatches);
  std::vector<double> variances;
  std::array<Neighbour, kNeighbours> patch;
  for (std::size_t i = 0; i < count; i += stride)
    if (tree.nearestK(measured[i], kNeighbours, patch.data()) == kNeighbours) {
      const double variance = varianceAcross(measured, patch);
      if (variance >= 0)
        variances.push_back(variance);
    }
  if (variances.empty())
    return 0;
  const auto quarter =
      variances.begin() +
      static_cast<std::vector<double>::difference_type>(variances.size() / 4);
  std::nth_element(variances.begin(), quarter, variances.end());
  return std::sqrt(*quarter);
}

} // namespace pcl6d
