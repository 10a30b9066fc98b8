// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>
#include <pcl6d/search/point_tree.h>
#include <pcl6d/visibility/range_noise.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace pcl6d {

namespace {
/** Neighbours of a patch: the first number covers several lines of most scans; the number grows
 * until the patch is wider than a line and than its noise. */
constexpr std::array<std::size_t, 3> kNeighbours{48, 192, 768};
constexpr std::size_t kPatches = 100; ///< number of sampled patches
/** The largest number of points used: the first ones, because the noise is similar in every part of
 * a scan. Every n-th point would be too far from the next, across the bends of the surface. */
constexpr std::size_t kMostPoints = 200000;
/** Least ratio of the second to the first side of a patch: below, the patch is a single line of the
 * scan, without information about the surface beside it. */
constexpr double kLeastWidth = 0.1;
/** A patch may still be a single line, as wide as the noise: its points lie in a plane with the
 * scanner. Then its third side is tiny compared with the second; the test is stricter for longish
 * patches. */
constexpr double kLongish = 0.5;
constexpr double kTiny = 0.01;
constexpr double kTinyOfLongish = 0.1;
/** Largest ratio of the third to the second side: above, the patch is a ball of noise
 * thicker than the patch. (Or no surface: then it belongs to the rough half.) */
constexpr double kThick = 0.3;

/** A patch of points about a position. */
struct Patch {
  double variance = 0; ///< across its plane [m^2], by the degrees of freedom
  bool line = false;
  bool large_enough = false; ///< to estimate the noise
};

Patch
patchOf(const Points& points, const std::vector<Neighbour>& neighbours)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Neighbour& n : neighbours)
    mean += points[static_cast<std::size_t>(n.index)].cast<double>();
  mean /= static_cast<double>(neighbours.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Neighbour& n : neighbours) {
    const Eigen::Vector3d d =
        points[static_cast<std::size_t>(n.index)].cast<double>() - mean;
    scatter += d * d.transpose();
  }
  const double freedom =
      static_cast<double>(neighbours.size()) - 3; // a plane has three parameters
  const Eigen::Vector3d values = symmetricEigenvalues<3>(scatter).cwiseMax(0.0);
  const Eigen::Vector3d sides = values.cwiseSqrt(); // ascending
  Patch patch;
  patch.variance = values(0) / freedom;
  patch.line = sides(1) < kLeastWidth * sides(2);
  const double tiny = sides(1) < kLongish * sides(2) ? kTinyOfLongish : kTiny;
  const bool may_be_line = sides(0) < tiny * sides(1);
  patch.large_enough = !patch.line && !may_be_line && sides(0) <= kThick * sides(1);
  return patch;
}

/** \return the smallest sufficiently large patch about the position; else the smallest patch other
 * than a line; else a line */
Patch
patchAt(const Points& points, const PointTree& tree, const Eigen::Vector3f& place)
{
  Patch best;
  best.line = true;
  for (const std::size_t count : kNeighbours) {
    const Patch patch = patchOf(points, tree.nearestK(place, count));
    if (patch.large_enough)
      return patch;
    if (best.line)
      best = patch;
  }
  return best;
}
} // namespace

double
rangeNoise(const Points& measured)
{
  Points points;
  for (const auto& p : measured)
    if (p.allFinite() && points.size() < kMostPoints)
      points.push_back(p);
  if (points.size() < kNeighbours.front())
    return 0;
  const PointTree tree(points);
  std::vector<double> variances;
  for (std::size_t i = 0; i < points.size();
       i += std::max<std::size_t>(1, points.size() / kPatches)) {
    const Patch patch = patchAt(points, tree, points[i]);
    if (!patch.line)
      variances.push_back(patch.variance);
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
