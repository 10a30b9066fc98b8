// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/object_localization/scene_surface.h>
#include <pcl6d/plane_segmentation/segment_planes.h>

#include <cmath>

namespace pcl6d {

namespace {
/** Smallest length and area of a large plane, in diameters. */
constexpr double kLargeLength = 1.3;
constexpr double kLargeArea = 0.5;
/** Surfel size for plane segmentation, in elements; larger surfels average the
 * noise. */
constexpr double kPlaneSurfel = 4;

PlaneCloudOptions
cloudOptions(double voxel, unsigned int num_threads)
{
  PlaneCloudOptions options;
  options.voxel = voxel;
  options.num_threads = num_threads;
  return options;
}

Points
directionsTo(const Points& points)
{
  Points directions;
  for (const auto& p : points)
    directions.push_back(p.normalized()); // the origin stays
  return directions;
}

std::vector<float>
noiseOf(const Surfels& surfels)
{
  std::vector<float> noise;
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    const auto members = static_cast<float>(surfels.begin[i + 1] - surfels.begin[i]);
    noise.push_back(2 * surfels.noise[i] / std::sqrt(members));
  }
  return noise;
}

bool
isLarge(const Plane& plane, double diameter)
{
  Eigen::AlignedBox3d box;
  for (const auto& corner : plane.hull)
    box.extend(corner);
  return box.diagonal().norm() > kLargeLength * diameter &&
         plane.area > kLargeArea * diameter * diameter;
}
} // namespace

SceneSurface::SceneSurface(const Points& points,
                           double voxel,
                           double diameter,
                           unsigned int num_threads)
: cloud(points, cloudOptions(voxel, num_threads))
, elements{cloud.surfels().points, cloud.surfels().normals}
, tree(elements.points, num_threads)
, directions(directionsTo(elements.points), num_threads)
, noise(noiseOf(cloud.surfels()))
, large(elements.size(), 0)
{
  if (elements.size() < 3)
    return;
  PlaneSegmentationOptions options;
  options.planes.min_area = kLargeArea * diameter * diameter;
  const PlaneCloud coarse(elements.points,
                          cloudOptions(kPlaneSurfel * voxel, num_threads));
  for (const auto& segment :
       segmentPlanes(coarse, PlaneMethod::kRegionGrowing, options).planes)
    if (isLarge(segment.plane, diameter))
      for (const auto element : segment.points)
        large[element] = 1;
}

OrientedPoints
SceneSurface::withoutLargePlanes() const
{
  OrientedPoints rest;
  for (std::size_t i = 0; i < elements.size(); ++i)
    if (!large[i]) {
      rest.points.push_back(elements.points[i]);
      rest.normals.push_back(elements.normals[i]);
    }
  return rest;
}

} // namespace pcl6d
