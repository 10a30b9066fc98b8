// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/io/plane_mesh_io.h>
#include <pcl6d/scene_interpretation/labelled_files.h>

namespace pcl6d {

std::vector<std::uint32_t>
planeIds(const std::vector<PlaneSegment>& segments, std::size_t num_points)
{
  std::vector<std::uint32_t> ids(num_points, 0);
  std::uint32_t id = 0;
  for (const auto& segment : segments) {
    ++id;
    for (const auto place : segment.points) {
      require(place < num_points,
              "place of a point",
              place,
              "below the number of points, " + std::to_string(num_points));
      ids[place] = id;
    }
  }
  return ids;
}

void
writeLabelledHulls(const std::filesystem::path& path,
                   const std::vector<PlaneSegment>& segments)
{
  std::vector<LabelledPolygon> polygons;
  for (const auto& [plane, points, seen_from, outline] : segments) {
    polygons.push_back({outline, plane.normal, plane.label});
    if (outline.empty())
      polygons.back().rings = {plane.hull};
  }
  writePolygonMesh(path, polygons);
}

void
writeLabelledCloud(const std::filesystem::path& path,
                   const Points& points,
                   const std::vector<PlaneSegment>& segments,
                   const LabelRules& rules)
{
  std::vector<PointLabel> labels(1);
  for (const auto& segment : segments)
    labels.push_back({static_cast<std::uint32_t>(labels.size()),
                      labelNumber(rules, segment.plane.label),
                      segment.plane.label});
  writeLabelledPoints(path, points, planeIds(segments, points.size()), labels);
}

} // namespace pcl6d
