// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/room.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/moving_objects/compared_run.h>
#include <pcl6d/moving_objects/run_changes.h>
#include <pcl6d/verification/prepared_scans.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace pcl6d::test {

inline constexpr double kVoxel = 0.1;    // [m] 16 points of a wall at 4 m
inline constexpr double kNoise = 0.005;  // [m] of ranges
inline constexpr double kRayStep = 0.03; // [rad]

/** \return the scanner's places on a drive through a PillarRoom */
inline std::vector<Eigen::Isometry3d>
driveThrough(double shift, int count = 4)
{
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < count; ++i)
    poses.push_back(poseFromEuler({-2 + 1.8 * i + shift, 0.3 - 0.4 * shift, 0.1},
                                  {0.01, 0, 1.3 * i}));
  return poses;
}

/** \brief A run through a room, with exact poses, ready to be compared. */
struct RoomRun {
  RoomRun(const PillarRoom& room,
          const std::vector<Eigen::Isometry3d>& poses,
          std::uint64_t seed,
          const Eigen::Isometry3d& T_world_room = Eigen::Isometry3d::Identity())
  : prepared(poses.size(), parameters(), 1)
  {
    Random random(seed);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      prepared.set(i, room.scan(poses[i], random, kRayStep, kNoise), "scan");
      const VerifiedScan& scan = prepared.scans()[i];
      ComparedScan compared;
      compared.points = &scan.surfaces().points();
      compared.normals = &scan.surfaces().normals();
      compared.rays = &scan.rays();
      compared.T_world_scan = T_world_room * poses[i];
      run.push_back(compared);
    }
  }

  static ScanParameters
  parameters()
  {
    ScanParameterOptions options;
    options.min_range = 0;
    options.max_range = 100;
    options.voxel = kVoxel;
    return deriveScanParameters(options, {});
  }

  PreparedScans prepared;
  ComparedRun run;
};

inline RunChangesOptions
changesOptions()
{
  RunChangesOptions options;
  options.voxel = kVoxel;
  options.noise = kNoise;
  return options;
}

/** \return all changes in words, for messages */
inline std::string
describe(const RunChanges& found)
{
  std::ostringstream text;
  for (const Change& one : found.changes)
    text << toString(one.kind) << " at "
         << one.box.T_world_box.translation().transpose() << ", size "
         << one.box.size.transpose() << ", " << one.points.size() << " voxels, "
         << one.confidence << ", by " << one.num_observers << "; distance "
         << one.distance << " +- " << one.lod << '\n';
  return text.str();
}

/** \return the changes of a kind */
inline std::vector<Change>
ofKind(const RunChanges& found, ChangeKind kind)
{
  std::vector<Change> chosen;
  std::copy_if(found.changes.begin(),
               found.changes.end(),
               std::back_inserter(chosen),
               [&](const Change& one) { return one.kind == kind; });
  return chosen;
}

/** \return whether all points of a change lie in a box, or by so much beside it [m] */
inline bool
isWithin(const Points& points, const Eigen::AlignedBox3d& box, double beside)
{
  return std::all_of(points.begin(), points.end(), [&](const Eigen::Vector3f& p) {
    return box.exteriorDistance(p.cast<double>().eval()) <= beside;
  });
}

} // namespace pcl6d::test
