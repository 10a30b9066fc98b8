// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/simulation/path_check.h>

#include <cmath>
#include <cstdio>

namespace pcl6d {
namespace {
constexpr double kStep = 0.1; // [m]

const Surface&
surfaceOf(const RayCaster& caster, const RayHit& hit)
{
  const TriangleScene& scene = caster.scene();
  return scene.surfaces[scene.triangles[hit.triangle].surface];
}

[[noreturn]] void
fail(int scan, const char* what, const Surface& surface, const Eigen::Vector3d& place)
{
  char text[128];
  std::snprintf(text,
                sizeof text,
                "x = %.2f, y = %.2f, z = %.2f m",
                place.x(),
                place.y(),
                place.z());
  throw ComputeFailed("scan " + std::to_string(scan) + ": " + what + " '" +
                      surface.name + "' at " + text + " of the scene");
}

Eigen::Isometry3d
poseAt(const RayCaster& caster, const RobotPath& path, double way, int scan)
{
  try {
    return path.sensorPose(caster, way);
  } catch (const ComputeFailed& e) { // no floor
    throw ComputeFailed("scan " + std::to_string(scan) +
                        " or the path after it: " + e.what());
  }
}

// A ray leaves a closed body only through the back of a face.
void
requireOutside(const RayCaster& caster, const Eigen::Vector3d& place, int scan)
{
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      const Eigen::Vector3d direction = sign * Eigen::Vector3d::Unit(axis);
      const auto hit = caster.cast({place, direction});
      if (hit && surfaceOf(caster, *hit).is_solid &&
          caster.scene().normal(hit->triangle).dot(direction) > 0)
        fail(scan, "the sensor is inside", surfaceOf(caster, *hit), place);
    }
}

void
requireFree(const RayCaster& caster,
            const Eigen::Vector3d& from,
            const Eigen::Vector3d& to,
            int scan)
{
  const double way = (to - from).norm();
  if (!(way > 0))
    return;
  const auto hit = caster.cast({from, (to - from) / way}, way);
  if (hit)
    fail(scan, "the path after it leads through", surfaceOf(caster, *hit), from);
}
} // namespace

void
requireFreePath(const RayCaster& caster, const RobotPath& path, int num_scans)
{
  const double half = -path.sensorHeight() / 2;
  for (int scan = 0; scan < num_scans; ++scan) {
    const double way = path.length() * scan / num_scans;
    requireOutside(caster, poseAt(caster, path, way, scan).translation(), scan);
  }
  const int steps = static_cast<int>(std::ceil(path.length() / kStep));
  Eigen::Isometry3d before = poseAt(caster, path, 0, 0);
  for (int i = 1; i <= steps; ++i) {
    const int scan = static_cast<int>(std::floor(num_scans * ((i - 1.0) / steps)));
    const Eigen::Isometry3d pose =
        poseAt(caster, path, path.length() * i / steps, scan);
    for (const double height : {0.0, half}) {
      const Eigen::Vector3d mast(0, 0, height);
      requireFree(caster, before * mast, pose * mast, scan);
    }
    before = pose;
  }
}

} // namespace pcl6d
