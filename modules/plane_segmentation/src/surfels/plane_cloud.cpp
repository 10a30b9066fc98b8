// SPDX-License-Identifier: BSD-3-Clause
#include "planes/plane_moments.h"
#include "surfels/make_surfels.h"

#include <pcl6d/common/median.h>
#include <pcl6d/common/require.h>
#include <pcl6d/plane_segmentation/plane_cloud.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl6d {
using namespace plane_segmentation;

namespace {
constexpr std::size_t kSamples = 1000; // positions for measuring the sensor's noise
constexpr double kLeastNoise = 5e-4;   // [m]
constexpr double kLargestVoxel = 0.1;  // [m]

std::vector<std::uint32_t>
finitePlaces(const Points& points)
{
  std::vector<std::uint32_t> places;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].allFinite())
      places.push_back(static_cast<std::uint32_t>(i));
  return places;
}

Points
chosenOf(const Points& points, const std::vector<std::uint32_t>& places)
{
  Points chosen;
  chosen.reserve(places.size());
  for (const auto i : places)
    chosen.push_back(points[i]);
  return chosen;
}

std::size_t
strideOfSamples(std::size_t size)
{
  return std::max<std::size_t>(1, size / kSamples);
}

double
medianSpacing(const Points& points, const PointTree& tree)
{
  std::vector<double> distances;
  std::array<Neighbour, 2> two;
  for (std::size_t i = 0; i < points.size(); i += strideOfSamples(points.size()))
    if (tree.nearestK(points[i], 2, two.data()) == 2)
      distances.push_back(std::sqrt(static_cast<double>(two[1].distance_sq)));
  return upperMedian(distances);
}

/** \return rms [m] of points about their plane, unbiased; nullopt without a plane */
std::optional<double>
residualOf(const PlaneMoments& sums)
{
  const auto plane = sums.fit();
  if (!plane || sums.count() < 4)
    return {};
  const auto count = static_cast<double>(sums.count());
  return std::sqrt(plane->mean_square * count / (count - 3));
}

/** First estimate of the noise, independent of range, from the nearest points of a
 * sample. */
double
roughNoise(const Points& points, const PointTree& tree)
{
  std::array<Neighbour, 40> patch;
  std::vector<double> ranges, residuals;
  for (std::size_t i = 0; i < points.size(); i += strideOfSamples(points.size())) {
    const std::size_t size = tree.nearestK(points[i], patch.size(), patch.data());
    PlaneMoments sums(points[i].cast<double>());
    for (std::size_t k = 0; k < size; ++k)
      sums.add(points[static_cast<std::size_t>(patch[k].index)].cast<double>());
    if (const auto residual = residualOf(sums))
      residuals.push_back(*residual);
  }
  return upperMedian(residuals);
}

/** Noise over range, estimated from the points around a sample of surfels. */
NoiseModel
measuredNoise(const PlaneCloud& cloud)
{
  const Surfels& surfels = cloud.surfels();
  std::vector<double> ranges, residuals;
  for (std::size_t i = 0; i < surfels.size(); i += strideOfSamples(surfels.size())) {
    PlaneMoments sums(surfels.points[i].cast<double>());
    for (std::size_t k = surfels.link_begin[i]; k < surfels.link_begin[i + 1]; ++k) {
      const std::uint32_t near = surfels.links[k];
      for (std::size_t m = surfels.begin[near]; m < surfels.begin[near + 1]; ++m)
        sums.add(cloud.points()[surfels.members[m]].cast<double>());
    }
    const auto residual = residualOf(sums);
    if (!residual)
      continue;
    const auto point = surfels.members[surfels.begin[i]];
    ranges.push_back((surfels.points[i] - cloud.viewpoint(point)).norm());
    residuals.push_back(*residual);
  }
  return NoiseModel(ranges, residuals, kLeastNoise);
}

double
medianRange(const PlaneCloud& cloud)
{
  std::vector<double> ranges;
  const std::size_t size = cloud.points().size();
  for (std::size_t i = 0; i < size; i += strideOfSamples(size))
    ranges.push_back((cloud.points()[i] - cloud.viewpoint(i)).norm());
  return upperMedian(ranges);
}

double
length(double a, double b)
{
  return std::sqrt(a * a + b * b);
}

/** Width of a few points, and of a few standard deviations of their noise. */
double
suitableVoxel(double spacing, double noise)
{
  return std::clamp(std::max(1.5 * spacing, 4 * noise), 4 * kLeastNoise, kLargestVoxel);
}
} // namespace

void
PlaneCloudOptions::validate(std::size_t num_points) const
{
  require(viewpoint.allFinite(), "viewpoint", viewpoint.transpose(), "finite");
  require(viewpoints.empty() || viewpoints.size() == num_points,
          "viewpoints",
          viewpoints.size(),
          "empty or equal to the number of points");
  require(width <= 1 || num_points % width == 0,
          "width",
          width,
          "the length of a row, a divisor of the number of points");
  require(!voxel || (*voxel > 0 && std::isfinite(*voxel)),
          "voxel",
          voxel.value_or(0),
          "> 0 and finite");
  require(!noise || (*noise > 0 && std::isfinite(*noise)),
          "noise",
          noise.value_or(0),
          "> 0 and finite");
  require(distortion >= 0 && std::isfinite(distortion),
          "distortion",
          distortion,
          ">= 0 and finite");
}

PlaneCloud::PlaneCloud(const Points& points, const PlaneCloudOptions& options)
: places_((options.validate(points.size()), finitePlaces(points)))
, points_(chosenOf(points, places_))
, viewpoint_(options.viewpoint)
, num_threads_(options.num_threads)
, tree_(points_, options.num_threads)
, spacing_(medianSpacing(points_, tree_))
, distortion_(options.distortion)
{
  if (!options.viewpoints.empty())
    viewpoints_ = chosenOf(options.viewpoints, places_);
  const double voxel = options.voxel.value_or(
      suitableVoxel(spacing_,
                    length(options.noise ? *options.noise : roughNoise(points_, tree_),
                           distortion_ * medianRange(*this))));
  surfels_ = groupSurfels(points_, voxel, {options.width, &places_}, num_threads_);
  noise_ = options.noise ? NoiseModel(*options.noise) : measuredNoise(*this);
  for (std::size_t i = 0; i < surfels_.size(); ++i)
    surfels_.noise.push_back(
        static_cast<float>(noise(surfels_.members[surfels_.begin[i]])));
  fitSurfels(
      surfels_,
      [&](std::size_t i) { return viewpoint(surfels_.members[surfels_.begin[i]]); },
      num_threads_);
  normals_.reserve(points_.size());
  for (const auto surfel : surfels_.of_point)
    normals_.push_back(surfels_.normals[surfel]);
}

PlaneCloud::PlaneCloud(const Points& points, unsigned int num_threads)
: PlaneCloud(points, [&] {
  PlaneCloudOptions options;
  options.num_threads = num_threads;
  return options;
}())
{}

} // namespace pcl6d
