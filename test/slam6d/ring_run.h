// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "registered_run.h"

namespace pcl6d::test {

/** \return a run along a path in a room, with odometry that drifts */
inline DriftingRun
makeRunAlong(const std::vector<Eigen::Isometry3d>& path, const PillarRoom& room)
{
  Random random(7);
  const Eigen::Isometry3d drift =
      poseFromEuler({0.04, -0.02, 0.02}, {0.006, -0.006, 0.015});
  DriftingRun run;
  run.truth = path;
  for (std::size_t i = 0; i < path.size(); ++i) {
    run.scans.push_back(room.scan(path[i], random, 0.06, 0.02));
    run.odometry.push_back(i == 0 ? path[0]
                                  : run.odometry[i - 1] * path[i - 1].inverse() *
                                        path[i] * drift);
  }
  return run;
}

/** \return a run once around in a room */
inline DriftingRun
makeRingRun(std::size_t count)
{
  std::vector<Eigen::Isometry3d> path;
  for (std::size_t i = 0; i < count; ++i) {
    const double turn =
        2 * M_PI * static_cast<double>(i) / static_cast<double>(count - 1);
    path.push_back(poseFromEuler({0.5 + 3 * std::cos(turn), 1.2 * std::sin(turn), 0},
                                 {0.02 * std::sin(turn), 0.03 * std::cos(turn), turn}));
  }
  return makeRunAlong(path, {});
}

/** \return a run in half a turn around the end of a wall of 0.1 m, which begins and ends
 * on its two sides */
inline DriftingRun
makeRunAroundWall(std::size_t count)
{
  PillarRoom room;
  room.pillars.emplace_back(Eigen::Vector3d(0.45, -4, -1), Eigen::Vector3d(0.55, 1, 2));
  std::vector<Eigen::Isometry3d> path;
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = M_PI * static_cast<double>(i) / static_cast<double>(count - 1);
    path.push_back(poseFromEuler(
        {0.5 - 2 * std::cos(turn), -1.5 + 4.2 * std::sin(turn), 0}, {0, 0, -turn}));
  }
  return makeRunAlong(path, room);
}

/** \return options under which errors add up from scan to scan, for relaxation to find */
inline Slam6DOptions
pairwise()
{
  Slam6DOptions options;
  options.metascan = 1;
  return options;
}

/** \return the root mean square [m] of the errors of the positions */
inline double
positionRms(const Slam6DResult& result, const DriftingRun& run)
{
  double sum_sq = 0;
  for (std::size_t i = 0; i < result.scans.size(); ++i)
    sum_sq += (result.scans[i].T_world_scan.translation() - run.truth[i].translation())
                  .squaredNorm();
  return std::sqrt(sum_sq / static_cast<double>(result.scans.size()));
}

/** \return the stage of that name, none if it was not reached */
inline const StageResult*
stageOf(const Slam6DResult& result, const std::string& name)
{
  for (const StageResult& stage : result.stages)
    if (stage.name == name)
      return &stage;
  return nullptr;
}

} // namespace pcl6d::test
