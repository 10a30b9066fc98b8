// SPDX-License-Identifier: BSD-3-Clause
#include "sample_texts.h"

namespace pcl6d::faults {

namespace {
constexpr const char* kScene = R"({
 "name": "yard", "scans": 3, "max_range": 30,
 "materials": {"brick": {"reflectance": 0.5, "label": "wall"}},
 "bodies": [
  {"type": "box", "centre": [0, 0, -0.5], "size": [30, 30, 1]},
  {"type": "box", "material": "brick", "centre": [8, 4, 2], "size": [4, 12, 4]},
  {"type": "wall", "material": "brick", "from": [-8, 8], "to": [8, 8], "top": 3},
  {"type": "ramp", "from": [10, 0], "to": [14, 0], "width": 2, "to_height": 1},
  {"type": "stairs", "from": [10, 4], "to": [12, 4], "width": 1, "to_height": 1.2, "steps": 4},
  {"type": "cylinder", "foot": [-9, 0, 0], "radius": 0.3, "height": 4},
  {"type": "revolved", "foot": [-9, 4, 0], "profile": [[1, 0], [0.2, 2]], "segments": 9},
  {"type": "terrain", "low": [-20, -20], "high": [20, 20], "amplitude": 1},
  {"type": "model", "file": "cube.obj", "position": [-5, -4, 0], "yaw": 1.2}],
 "objects": [{"class": "box", "file": "cube.obj", "position": [2, 2, 0], "yaw": 0.5}],
 "waypoints": [[0, 0, 0], [2, 0.5, 0], [4, 0, 0]]
}
)";

constexpr const char* kSitePtx = R"(2
2
0 0 0
1 0 0
0 1 0
0 0 1
1 0 0 0
0 1 0 0
0 0 1 0
0 0 0 1
0 0 0 0.5
1 0 1 0.2
1 0 2 0.3
0 1 0 0.4
1
2
4 5 6
0 1 0
-1 0 0
0 0 1
0 1 0 0
-1 0 0 0
0 0 1 0
4 5 6 1
7 8 9 0.25 255 128 1
1 2 3 0.5 7 8 9
)";

constexpr const char* kObjects = R"({
 "schema_version": 1, "seconds": 0.5,
 "objects": [
  {"class": "box",
   "T_world_object": [1, 0, 0, 1.5, 0, 1, 0, -0.5, 0, 0, 1, -0.9, 0, 0, 0, 1],
   "covariance": null,
   "box_min": [-0.2, -0.3, 0], "box_max": [0.2, 0.3, 0.45],
   "score": 0.9, "visible_fraction": 0.5, "rms": 0.01, "symmetry": 2, "moves": false,
   "points": 40, "scans": [0, 1]}]
}
)";

constexpr const char* kCube = R"(# a cube
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
)";

constexpr const char* kPlanSvg = R"svg(<?xml version="1.0"?>
<svg xmlns="http://www.w3.org/2000/svg" viewBox="-20 -20 40 40">
 <g>
  <line x1="-3" y1="-2" x2="3" y2="-2"/>
  <polyline points="3,-2 3,2 -3,2"/>
  <path d="M -3 2 L -3 -2 h 1 v 2 z"/>
  <rect x="5" y="5" width="2" height="3"/>
 </g>
</svg>
)svg";

constexpr const char* kPlanGeoJson = R"({
 "type": "FeatureCollection",
 "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}},
 "features": [
  {"type": "Feature", "properties": {},
   "geometry": {"type": "LineString", "coordinates": [[-3, -2], [3, -2], [3, 2]]}},
  {"type": "Feature", "properties": {},
   "geometry": {"type": "Polygon", "coordinates": [[[300, 200], [-3, 2], [-3, -2], [300, 200]]]}}]
}
)";

constexpr const char* kCalibration = R"(%YAML:1.0
---
M1: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 100., 0., 79.5, 0., 100., 59.5, 0., 0., 1. ]
D1: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [ -0.01, 0.001, 0., 0., 0. ]
M2: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 100., 0., 79.5, 0., 100., 59.5, 0., 0., 1. ]
D2: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [ -0.01, 0.001, 0., 0., 0. ]
R: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 1., 0., 0., 0., 1., 0., 0., 0., 1. ]
T: !!opencv-matrix
   rows: 3
   cols: 1
   dt: d
   data: [ -0.12, 0., 0. ]
)";

constexpr const char* kCameraXml = R"(<?xml version="1.0"?>
<opencv_storage>
<M1 type_id="opencv-matrix">
  <rows>3</rows>
  <cols>3</cols>
  <dt>d</dt>
  <data>100. 0. 31.5 0. 100. 23.5 0. 0. 1.</data></M1>
<D1 type_id="opencv-matrix">
  <rows>1</rows>
  <cols>5</cols>
  <dt>d</dt>
  <data>0. 0. 0. 0. 0.</data></D1>
</opencv_storage>
)";

constexpr const char* kCameraJson = R"({
 "M1": {"type_id": "opencv-matrix", "rows": 3, "cols": 3, "dt": "d",
        "data": [100.0, 0.0, 31.5, 0.0, 100.0, 23.5, 0.0, 0.0, 1.0]},
 "D1": {"type_id": "opencv-matrix", "rows": 1, "cols": 5, "dt": "d",
        "data": [0.0, 0.0, 0.0, 0.0, 0.0]}
}
)";

constexpr const char* kSuite = R"({
 "schema_version": 1,
 "title": "small",
 "description": "two scans",
 "time_limit": 8,
 "repetitions": 1,
 "defaults": {"relaxation": "none", "loop-closing": "none", "no-verification": true},
 "data": {"yard": {"folder": "scans", "reference": "path.kitti", "options": {"last": 1}}},
 "methods": {"point": {"metric": "point", "metascan": 1}}
}
)";

/** KITTI rows of a drive around a square of 10 m, back to its start. */
std::string
drive(const char* step)
{
  std::string rows;
  for (int i = 0; i <= 40; ++i) {
    const int side = i / 10 % 4, along = i % 10;
    const int x = side == 0 ? along : side == 1 ? 10 : side == 2 ? 10 - along : 0;
    const int y = side == 0 ? 0 : side == 1 ? along : side == 2 ? 10 : 10 - along;
    rows += "1 0 0 " + std::to_string(x) + step + " 0 1 0 " + std::to_string(y) +
            " 0 0 1 0\n";
  }
  return rows;
}

/** Nine lines of a 2D scanner that sees a wall. */
std::string
scannerLines(bool angles)
{
  std::string rows =
      angles ? "angle,range,range,range,range,range,range,range,range,range\n" : "";
  for (int line = -4; line <= 4; ++line) {
    if (angles)
      rows += std::to_string(5 * line);
    for (int beam = 0; beam < 9; ++beam)
      rows +=
          (beam > 0 || angles ? "," : "") + std::string("2.0") + std::to_string(beam);
    rows += '\n';
  }
  return rows;
}

std::string
trustedRows()
{
  std::string rows = "scan,trusted\n";
  for (int i = 0; i <= 40; ++i)
    rows += std::to_string(i) + "," + (i % 7 == 3 ? "0" : "1") + "\n";
  return rows;
}
} // namespace

const std::vector<std::pair<std::string, std::string>>&
sampleTexts()
{
  static const std::vector<std::pair<std::string, std::string>> texts = {
      {"scene.json", kScene},
      {"objects.json", kObjects},
      {"cube.obj", kCube},
      {"plan.svg", kPlanSvg},
      {"plan.geojson", kPlanGeoJson},
      {"plan.csv", "x1,y1,x2,y2\n-3,-2,3,-2\n3,-2,3,2\n3,2,-3,2\n-3,2,-3,-2\n"},
      {"stereo.yml", kCalibration},
      {"camera.xml", kCameraXml},
      {"camera.json", kCameraJson},
      {"suite.json", kSuite},
      {"drive.kitti", drive("")},
      {"drive_estimate.kitti", drive(".01")},
      {"loops.txt", "# start and half way\n0 20\n0 40\n"},
      {"trusted.csv", trustedRows()},
      {"lengths.txt", "4.1 4.0\n8.2 8.1\n0 0 0 3 4 0 5.1\n0 0 0 1 0 0 0 0 0 2 0 0\n"},
      {"lines.csv", scannerLines(true)},
      {"ranges.csv", scannerLines(false)},
      {"angles.csv",
       "-20,0\n-15,0.1\n-10,0.2\n-5,0.3\n0,0.4\n5,0.5\n10,0.6\n15,0.7\n20,0.8\n"},
      {"waypoints.txt", "1 1 0\n3 1 0\n3 4 0\n"},
      {"scan.csv",
       "\xEF\xBB\xBFTime;X;Y;Z;R;G;B\n1,5;1,25;0;3;1;2;3\n1,6;2;0,5;-3;4;5;6\n1,7;0;1;"
       "2;7;8;9\n"},
      {"scan.pts", "3\n1 2 3 -1035 97 59 38\n4 5 6 12 0 0 255\n7 8 9 1 2 3 4\n"},
      {"site.ptx", kSitePtx},
      {"indices.txt", "0\n1\n2\n5\n7\n11\n13\n17\n19\n23\n"},
      {"guess.txt", "0.1 0.2 0 0 0 5\n"},
      {"links.txt", "0 1\n1 2\n0 3\n"},
      {"run.cfg",
       "# a comment\nmetric = point\nmax-distance = 0.5\nvoxel = 0.1\n"
       "relaxation = none\nloop-closing = none\nno-picture = yes\n"},
      {"graph.cfg",
       "method = levenberg-marquardt\nrobust = huber\nrobust-width = 3\n"
       "iterations = 10\nthreads = 1\n"}};
  return texts;
}

} // namespace pcl6d::faults
