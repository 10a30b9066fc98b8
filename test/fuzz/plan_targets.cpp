// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/fuzz_target.h"
#include "fuzz/targets.h"

#include <pcl6d/common/polygon.h>
#include <pcl6d/io/point_list_io.h>
#include <pcl6d/io/range_lines_io.h>
#include <pcl6d/io/segment_io.h>

#include <cmath>

namespace pcl6d::fuzz {

namespace {
int
readPlanOf(const char* extension, const std::uint8_t* data, std::size_t size)
{
  return readAsFile(extension, data, size, [](const auto& file) {
    const Segments segments = readSegments(file);
    expect(!segments.empty(), "a plan has a segment");
    for (const Segment& segment : segments) {
      expect(segment.a.allFinite() && segment.b.allFinite(), "segments are finite");
      expect(segment.a != segment.b, "segments have a length");
    }
  });
}
} // namespace

int
plan_svg(const std::uint8_t* data, std::size_t size)
{
  return readPlanOf(".svg", data, size);
}

int
plan_geojson(const std::uint8_t* data, std::size_t size)
{
  return readPlanOf(".geojson", data, size);
}

int
plan_csv(const std::uint8_t* data, std::size_t size)
{
  return readPlanOf(".csv", data, size);
}

int
point_list(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(".txt", data, size, [](const auto& file) {
    for (const auto& point : readPointList(file))
      expect(point.allFinite(), "points are finite");
  });
}

int
range_lines(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(".csv", data, size, [](const auto& file) {
    const RangeLines lines = readRangeLines(file);
    expect(!lines.angles.empty(), "there is a line");
    expect(lines.ranges.size() == lines.angles.size() * lines.samples_per_line,
           "as many ranges in each line");
    expect(lines.times.empty() || lines.times.size() == lines.angles.size(),
           "a time per line");
    for (const double range : lines.ranges)
      expect(!(range <= 0) && !std::isinf(range), "ranges are positive, or none");
  });
}

int
polygon(const std::uint8_t* data, std::size_t size)
{
  // Per corner a byte each for x and y; an odd x ends the ring after it. A coarse grid
  // makes corners coincide and lie on lines, which is where such code breaks.
  std::vector<std::vector<Eigen::Vector3d>> rings(1);
  std::vector<Eigen::Vector3d> corners;
  for (std::size_t i = 0; i + 1 < size; i += 2) {
    rings.back().emplace_back(data[i] / 2, data[i + 1], 0);
    corners.push_back(rings.back().back());
    if (data[i] % 2 == 1)
      rings.emplace_back();
  }
  for (const auto& triangle : triangulate(rings, Eigen::Vector3d::UnitZ()))
    for (const auto corner : triangle)
      expect(corner < corners.size(), "triangles are of corners");
  const auto hull = convexHull(corners, Eigen::Vector3d::UnitZ());
  expect(hull.size() <= corners.size(), "a hull is of corners");
  expect(hull.empty() || centreOfArea(hull).allFinite(), "the centre is finite");
  return 0;
}

} // namespace pcl6d::fuzz
