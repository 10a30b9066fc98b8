// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/point_normals.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl6d {

namespace {
constexpr std::size_t kMostNeighbours = 64;
constexpr std::size_t kBlockSize = 256; // points
/** Ratio of squared spreads below which points count as lying on a line. */
constexpr double kLineTolerance = 1e-8;

using Patch = std::array<Neighbour, kMostNeighbours>;

/** \return sum of (p - place) (p - place)^T about the mean of the patch */
Eigen::Matrix3d
scatterOf(const Patch& patch,
          std::size_t size,
          const Points& points,
          const Eigen::Vector3f& place)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < size; ++i) {
    const Eigen::Vector3d d = (points[patch[i].index] - place).cast<double>();
    sum += d;
    squares += d * d.transpose();
  }
  return squares - sum * sum.transpose() / static_cast<double>(size);
}

/** The direction of least spread; zero for points on a line. The smallest root of the
 * characteristic polynomial is found by Newton's method from zero, where it is increasing
 * and concave, so that no step goes too far; the direction is orthogonal to two rows of S -
 * root. Several times as fast as a general solver, which is left what this cannot decide:
 * patches that are nearly as thick as they are wide in some direction. */
Eigen::Vector3d
leastSpread(const Eigen::Matrix3d& scatter)
{
  const double trace = scatter.trace();
  if (!(trace > 0))
    return Eigen::Vector3d::Zero();
  const Eigen::Matrix3d S = scatter / trace;
  const double c1 = S(0, 0) * S(1, 1) - S(0, 1) * S(0, 1) + S(0, 0) * S(2, 2) -
                    S(0, 2) * S(0, 2) + S(1, 1) * S(2, 2) - S(1, 2) * S(1, 2);
  const double c0 = S.determinant();
  double root = 0, step = 1;
  for (int i = 0; i < 40 && step > 1e-15; ++i) {
    const double value = ((root - 1) * root + c1) * root - c0;
    const double slope = (3 * root - 2) * root + c1;
    step = slope > 0 ? std::max(0.0, -value / slope) : 0;
    root += step;
  }
  const double others = 1 - root, product = c1 - root * others;
  const double largest =
      (others + std::sqrt(std::max(0.0, others * others - 4 * product))) / 2;
  if (!(product > kLineTolerance * largest * largest))
    return Eigen::Vector3d::Zero();
  const Eigen::Matrix3d rest = S - root * Eigen::Matrix3d::Identity();
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d direction = rest.row(i).cross(rest.row((i + 1) % 3));
    if (direction.squaredNorm() > best.squaredNorm())
      best = direction;
  }
  if (best.squaredNorm() > 1e-8)
    return best.normalized();
  return symmetricEigen(S).vectors.col(0);
}

void
requireNeighbours(std::size_t neighbours)
{
  require(neighbours >= 3 && neighbours <= kMostNeighbours,
          "neighbours",
          neighbours,
          "in [3, 64]");
}

Eigen::Vector3f
normalOfPatch(const Eigen::Vector3f& place,
              const Patch& patch,
              std::size_t size,
              const Points& points)
{
  if (size < 3)
    return Eigen::Vector3f::Zero();
  const Eigen::Vector3f normal =
      leastSpread(scatterOf(patch, size, points, place)).cast<float>();
  return normal.dot(place) > 0 ? Eigen::Vector3f(-normal) : normal;
}
} // namespace

Eigen::Vector3f
normalAt(const Eigen::Vector3f& place,
         const PointTree& tree,
         const Points& points,
         std::size_t neighbours)
{
  requireNeighbours(neighbours);
  Patch patch;
  const std::size_t size = tree.nearestK(place, neighbours, patch.data());
  return normalOfPatch(place, patch, size, points);
}

Eigen::Vector3f
normalOf(const Eigen::Vector3f& place,
         const std::vector<Neighbour>& nearest,
         const Points& points)
{
  Patch patch;
  const std::size_t size = std::min(nearest.size(), patch.size());
  std::copy_n(nearest.begin(), size, patch.begin());
  return normalOfPatch(place, patch, size, points);
}

Normals
estimateNormals(const Points& places,
                const Points& points,
                const PointTree& tree,
                std::size_t neighbours,
                unsigned int num_threads)
{
  requireNeighbours(neighbours);
  Normals normals(places.size());
  parallelBlocks(places.size(), kBlockSize, num_threads, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i)
      normals[i] = normalAt(places[i], tree, points, neighbours);
  });
  return normals;
}

} // namespace pcl6d
