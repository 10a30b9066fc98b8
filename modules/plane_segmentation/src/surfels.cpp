// SPDX-License-Identifier: BSD-3-Clause
#include "plane_sums.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/plane_segmentation/surfels.h>
#include <pcl6d/search/point_tree.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl6d {

namespace {
constexpr std::size_t kBlockSize = 256; // surfels
constexpr double kLineTolerance = 1e-8; // of squared spreads
using Patch = std::array<Neighbour, Surfels::kNeighbours>;

void
groupPoints(const Points& points, double voxel, Surfels& surfels)
{
  const VoxelGroups groups(points, voxel);
  surfels.of_point.resize(points.size());
  surfels.begin.push_back(0);
  for (std::size_t group = 0; group < groups.size(); ++group) {
    surfels.points.push_back(meanOf(points, groups.indices(group)).cast<float>());
    for (const auto index : groups.indices(group)) {
      surfels.of_point[static_cast<std::size_t>(index)] =
          static_cast<std::uint32_t>(group);
      surfels.members.push_back(static_cast<std::uint32_t>(index));
    }
    surfels.begin.push_back(static_cast<std::uint32_t>(surfels.members.size()));
  }
}

/** The plane of a surfel's neighbours. */
void
fitNeighbours(std::size_t i,
              const Patch& patch,
              std::size_t size,
              const Eigen::Vector3f& viewpoint,
              Surfels& surfels)
{
  surfels.normals[i].setZero();
  surfels.radii[i] = size == 0 ? 0 : std::sqrt(patch[size - 1].distance_sq);
  if (size < 3)
    return;
  const Eigen::Vector3f& place = surfels.points[i];
  PlaneSums sums(place.cast<double>());
  for (std::size_t k = 0; k < size; ++k)
    sums.add(surfels.points[static_cast<std::size_t>(patch[k].index)].cast<double>());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sums.scatter());
  const Eigen::Vector3d squares = solver.eigenvalues().cwiseMax(0); // ascending
  const double free = std::max(1.0, static_cast<double>(size) - 3);
  surfels.roughness[i] = static_cast<float>(std::sqrt(squares[0] / free));
  surfels.spread[i] =
      static_cast<float>(std::sqrt(squares[1] / static_cast<double>(size)));
  if (!(squares[1] > kLineTolerance * squares[2]))
    return;
  const Eigen::Vector3f normal = solver.eigenvectors().col(0).cast<float>();
  surfels.normals[i] =
      normal.dot(viewpoint - place) < 0 ? Eigen::Vector3f(-normal) : normal;
}
} // namespace

Surfels
makeSurfels(const Points& points,
            double voxel,
            const Eigen::Vector3f& viewpoint,
            const Points& viewpoints,
            unsigned int num_threads)
{
  Surfels surfels;
  groupPoints(points, voxel, surfels);
  const std::size_t size = surfels.size();
  const PointTree tree(surfels.points, num_threads);
  const std::size_t stride = std::min(size, Surfels::kNeighbours);
  surfels.normals.resize(size);
  surfels.radii.resize(size);
  surfels.roughness.resize(size);
  surfels.spread.resize(size);
  surfels.links.resize(size * stride);
  parallelBlocks(size, kBlockSize, num_threads, [&](const Block& block) {
    Patch patch;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const std::size_t found = tree.nearestK(surfels.points[i], stride, patch.data());
      const Eigen::Vector3f& seen_from =
          viewpoints.empty() ? viewpoint
                             : viewpoints[surfels.members[surfels.begin[i]]];
      fitNeighbours(i, patch, found, seen_from, surfels);
      for (std::size_t k = 0; k < stride; ++k)
        surfels.links[i * stride + k] = static_cast<std::uint32_t>(patch[k].index);
    }
  });
  for (std::size_t i = 0; i <= size; ++i)
    surfels.link_begin.push_back(static_cast<std::uint32_t>(i * stride));
  return surfels;
}

} // namespace pcl6d
