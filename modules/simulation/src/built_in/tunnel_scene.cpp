// SPDX-License-Identifier: BSD-3-Clause
#include "built_in/built_in_scenes.h"

#include <pcl6d/common/portable_math.h>

namespace pcl6d::simulation {
namespace tunnel {
namespace {
// A straight road tunnel along x with a constant profile. Its open ends are beyond the
// range of the scanner, so scans do not determine the position along x. The robot goes
// there on one lane and back on the other. Profile, y to the right, z up; the walkway
// is on the left side seen along x:
//
//              ...-----...         5
//           .-             -.
//          |                 |     3
//          |                 |
//          |              +--+     0.25
//          +--------------+        0
//         -4              3  4
constexpr double kHalfLength = 65; // [m]
constexpr double kTurn = 28;       // [m] from the middle: turning point of the robot
constexpr double kHalfWidth = 4;
constexpr double kWall = 3; // [m] height at which the vault starts
constexpr double kRise = 2; // [m] of the vault
constexpr double kKerb = 0.25;
constexpr double kWalkway = 3; // [m] beginning of the walkway
constexpr double kLane = 1.5;  // [m] from the middle of the road
constexpr double kRoad = -0.5; // y of the middle of the road

const Surface kAsphalt{"road", 0.25, PlaneLabel::kFloor};
const Surface kKerbstone{"kerb", 0.5};
const Surface kPaving{"walkway", 0.4, PlaneLabel::kFloor};
const Surface kLining{"lining", 0.55, PlaneLabel::kWall};
const Surface kVault{"vault", 0.55};

// An edge from a corner of the profile (y, z) to the next corner.
struct Edge {
  Eigen::Vector2d from;
  Surface surface;
};

// Around the free space, counter-clockwise with y to the right; a surface may have
// several edges in a row.
std::vector<Edge>
profile()
{
  std::vector<Edge> edges = {{{-kHalfWidth, 0}, kAsphalt},
                             {{kWalkway, 0}, kKerbstone},
                             {{kWalkway, kKerb}, kPaving},
                             {{kHalfWidth, kKerb}, kLining}};
  constexpr int kArch = 16;
  for (int i = 0; i < kArch; ++i) {
    const SinCos turn = portableSinCos(M_PI * i / kArch);
    edges.push_back({{kHalfWidth * turn.cos, kWall + kRise * turn.sin}, kVault});
  }
  edges.push_back({{-kHalfWidth, kWall}, kLining});
  return edges;
}

void
extrude(TriangleScene& scene, const std::vector<Edge>& edges)
{
  const auto count = static_cast<std::uint32_t>(edges.size());
  for (const double x : {-kHalfLength, kHalfLength})
    for (const auto& edge : edges)
      scene.vertices.emplace_back(x, edge.from.x(), edge.from.y());
  std::uint32_t surface = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i == 0 || edges[i].surface.name != edges[i - 1].surface.name)
      surface = scene.addSurface(edges[i].surface);
    const std::uint32_t next = (i + 1) % count;
    scene.addQuad({i, count + i, count + next, next}, surface);
  }
}

std::vector<Eigen::Vector3d>
waypoints()
{
  std::vector<Eigen::Vector3d> way;
  for (double x = -kTurn + 4; x <= kTurn; x += 4)
    way.emplace_back(x, kRoad - kLane, 0);
  for (double x = kTurn; x > -kTurn; x -= 4)
    way.emplace_back(x, kRoad + kLane, 0);
  way.emplace_back(-kTurn, kRoad + kLane, 0);
  way.emplace_back(-kTurn, kRoad - kLane, 0);
  return way;
}

SimulationScene
make()
{
  SimulationScene scene;
  scene.name = "tunnel";
  scene.num_scans = 50;
  scene.max_range = 30;
  extrude(scene.geometry, profile());
  scene.waypoints = waypoints();
  return scene;
}
} // namespace
} // namespace tunnel

SimulationScene
tunnelScene(std::uint64_t)
{
  return tunnel::make();
}

} // namespace pcl6d::simulation
