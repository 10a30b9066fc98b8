// SPDX-License-Identifier: BSD-3-Clause
#include "planes/plane_moments.h"
#include "surfels/make_surfels.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/search/point_tree.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl6d::plane_segmentation {

namespace {
constexpr std::size_t kBlockSize = 256;    // surfels
constexpr std::size_t kFewNeighbours = 10; // on a strip
constexpr double kLineTolerance = 1e-8;    // of squared spreads
constexpr double kSmooth = 1.5;            // [sigma] rms of neighbours to their plane
/** [rad] between ray and surface; edge-on, a scanner sees only its own scan line. */
constexpr float kLeastIncidence = 0.02f;
constexpr double kLeastSpread = 3; // [rms] less: a line, not a plane

void
groupPoints(const Points& points, double voxel, Surfels& surfels)
{
  const VoxelGroups groups(points, voxel);
  surfels.of_point.resize(points.size());
  surfels.members.reserve(points.size());
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

void
linkByTree(Surfels& surfels, unsigned int num_threads)
{
  const std::size_t size = surfels.size();
  const PointTree tree(surfels.points, num_threads);
  const std::size_t stride = std::min(size, Surfels::kNeighbours);
  surfels.radii.resize(size);
  surfels.links.resize(size * stride);
  parallelBlocks(size, kBlockSize, num_threads, [&](const Block& block) {
    std::array<Neighbour, Surfels::kNeighbours> nearest;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      tree.nearestK(surfels.points[i], stride, nearest.data());
      surfels.radii[i] = std::sqrt(nearest[stride - 1].distance_sq);
      for (std::size_t k = 0; k < stride; ++k)
        surfels.links[i * stride + k] = static_cast<std::uint32_t>(nearest[k].index);
    }
  });
  for (std::size_t i = 0; i <= size; ++i)
    surfels.link_begin.push_back(static_cast<std::uint32_t>(i * stride));
}

/** The plane of the nearest neighbours of a surfel. */
struct Patch {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero(); // zero: none
  float lift = 0; // [m] along the normal, to the plane
  float roughness = 0;
  bool smooth = false;
};

Patch
patchOf(const Surfels& surfels, std::size_t i, std::size_t most)
{
  const std::size_t begin = surfels.link_begin[i];
  const std::size_t size =
      std::min<std::size_t>(most, surfels.link_begin[i + 1] - begin);
  const Eigen::Vector3f& place = surfels.points[i];
  PlaneMoments sums(place.cast<double>());
  for (std::size_t k = begin; k < begin + size; ++k)
    sums.add(surfels.points[surfels.links[k]].cast<double>());
  Patch patch;
  if (size < 3)
    return patch;
  const auto eigen = symmetricEigen<3>(sums.scatter());
  const Eigen::Vector3d squares = eigen.values.cwiseMax(0); // ascending
  if (!(squares[1] > kLineTolerance * squares[2]))
    return patch;
  const auto count = static_cast<double>(size);
  const double roughness = std::sqrt(squares[0] / std::max(1.0, count - 3));
  const Eigen::Vector3d normal = eigen.vectors.col(0);
  patch.normal = normal.cast<float>();
  patch.lift = static_cast<float>(normal.dot(sums.mean() - place.cast<double>()));
  patch.roughness = static_cast<float>(roughness);
  patch.smooth =
      roughness < kSmooth * surfels.noise[i] &&
      squares[1] > count * kLeastSpread * kLeastSpread * roughness * roughness;
  return patch;
}
} // namespace

Surfels
groupSurfels(const Points& points,
             double voxel,
             const PointGrid& grid,
             unsigned int num_threads)
{
  Surfels surfels;
  groupPoints(points, voxel, surfels);
  if (grid.width > 1)
    linkByGrid(surfels, grid, num_threads);
  else
    linkByTree(surfels, num_threads);
  return surfels;
}

void
fitSurfels(Surfels& surfels,
           const std::function<Eigen::Vector3f(std::size_t)>& viewpoint_of,
           unsigned int num_threads)
{
  const std::size_t size = surfels.size();
  surfels.normals.resize(size);
  surfels.roughness.resize(size);
  surfels.smooth.resize(size);
  Points places(size); // moved positions, as later surfels still need the old positions
  parallelBlocks(size, kBlockSize, num_threads, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i) {
      Patch patch = patchOf(surfels, i, Surfels::kNeighbours);
      if (!patch.smooth) {
        const Patch few = patchOf(surfels, i, kFewNeighbours);
        if (few.smooth)
          patch = few;
      }
      const Eigen::Vector3f& place = surfels.points[i];
      const Eigen::Vector3f ray = viewpoint_of(i) - place;
      const float towards = patch.normal.dot(ray);
      patch.smooth &= std::abs(towards) > kLeastIncidence * ray.norm();
      surfels.normals[i] = towards < 0 ? Eigen::Vector3f(-patch.normal) : patch.normal;
      surfels.roughness[i] = patch.roughness;
      surfels.smooth[i] = patch.smooth;
      places[i] =
          patch.smooth ? Eigen::Vector3f(place + patch.lift * patch.normal) : place;
    }
  });
  surfels.points = std::move(places);
}

} // namespace pcl6d::plane_segmentation
