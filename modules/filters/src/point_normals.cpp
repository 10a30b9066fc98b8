// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/point_normals.h>

#include <Eigen/Eigenvalues>

#include <array>

namespace pcl6d {

namespace {
constexpr std::size_t kMostNeighbours = 64;
constexpr std::size_t kBlockSize = 256; // points
/** Ratio of squared spreads below which points count as lying on a line. */
constexpr double kLineTolerance = 1e-9;

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

void
requireNeighbours(std::size_t neighbours)
{
  require(neighbours >= 3 && neighbours <= kMostNeighbours,
          "neighbours",
          neighbours,
          "in [3, 64]");
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
  if (size < 3)
    return Eigen::Vector3f::Zero();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      scatterOf(patch, size, points, place));
  if (!(solver.eigenvalues()(1) > kLineTolerance * solver.eigenvalues()(2)))
    return Eigen::Vector3f::Zero();
  const Eigen::Vector3f normal = solver.eigenvectors().col(0).cast<float>();
  return normal.dot(place) > 0 ? Eigen::Vector3f(-normal) : normal;
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
