// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/plane_segmentation/plane_cloud.h>

namespace pcl6d {

namespace {
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
} // namespace

PlaneCloud::PlaneCloud(const Points& points, unsigned int num_threads)
: places_(finitePlaces(points))
, points_(chosenOf(points, places_))
, tree_(points_, num_threads)
, normals_(estimateNormals(points_, tree_, 20, num_threads))
{}

} // namespace pcl6d
