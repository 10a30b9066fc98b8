// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/mcl/mcl_map.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/mesh_io.h>
#include <pcl6d/io/plane_io.h>
#include <pcl6d/io/segment_io.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace pcl6d::app {

namespace {
std::string
extensionOf(const std::string& file)
{
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  });
  return extension;
}

MclMap
mapOfPlanes(const std::string& file)
{
  const std::vector<Plane> planes = readPlanes(file);
  MclMap map;
  map.R_map_world = levelOfPlanes(planes);
  map.walls = wallsOf(planes, map.R_map_world);
  map.source = "walls and doors of " + std::to_string(planes.size()) + " planes";
  if (map.walls.empty())
    throw IoFailed(file + ": none of its " + std::to_string(planes.size()) +
                   " planes is a wall or door that was seen");
  return map;
}

MclMap
mapOfMesh(const MclSettings& s)
{
  MeshOptions options;
  options.scale = s.map_scale;
  const double height = (s.slice.low + s.slice.high) / 2;
  MclMap map;
  map.walls = sliceOf(readMesh(s.map, options), height);
  map.source = "cut of a mesh at z = " + std::to_string(height) + " m";
  return map;
}

MclMap
mapOfCloud(const MclSettings& s)
{
  MclMap map;
  map.walls = sliceOf(readScan(s.map).points, s.slice);
  map.source = "upright surfaces of a cloud";
  return map;
}

/** \return whether a PLY file holds faces */
bool
hasFaces(const std::string& file)
{
  const auto left_out = readScanCloud(file).left_out;
  return std::any_of(left_out.begin(), left_out.end(), [](const std::string& what) {
    return what.find("face") != std::string::npos;
  });
}

MclMap
mapOfPlan(const MclSettings& s)
{
  return {readSegments(s.map, {s.map_scale}), Eigen::Matrix3d::Identity(), "plan"};
}
} // namespace

MclMap
readMclMap(const MclSettings& s)
{
  const std::string extension = extensionOf(s.map);
  if (extension == ".csv" || extension == ".geojson" || extension == ".svg")
    return mapOfPlan(s);
  if (extension == ".json")
    return mapOfPlanes(s.map);
  const bool is_mesh = extension == ".obj" || extension == ".stl" ||
                       (extension == ".ply" && hasFaces(s.map));
  if (!is_mesh && extension != ".pcd" && extension != ".ply")
    throw IoFailed(s.map +
                   ": a map must be a file .csv, .geojson, .svg, .json, .pcd, "
                   ".ply, .obj or .stl, not '" +
                   extension + "'");
  MclMap map = is_mesh ? mapOfMesh(s) : mapOfCloud(s);
  if (map.walls.empty())
    throw IoFailed(s.map +
                   ": no upright surface between z = " + std::to_string(s.slice.low) +
                   " m and " + std::to_string(s.slice.high) + " m; see --map-slice");
  return map;
}

} // namespace pcl6d::app
