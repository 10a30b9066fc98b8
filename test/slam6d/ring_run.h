// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "corridor_drive.h"
#include "registered_run.h"

namespace pcl6d::test {

/** \return a run along a path in a room, with odometry that drifts */
inline DriftingRun
makeRunAlong(const std::vector<Eigen::Isometry3d>& path,
             const PillarRoom& room,
             double step = 0.06)
{
  Random random(7);
  const Eigen::Isometry3d drift =
      poseFromEuler({0.04, -0.02, 0.02}, {0.006, -0.006, 0.015});
  DriftingRun run;
  run.truth = path;
  for (std::size_t i = 0; i < path.size(); ++i) {
    run.scans.push_back(room.scan(path[i], random, step, 0.02));
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

/** \return a run around a block in corridors of 4 m, which ends where it began */
inline DriftingRun
makeRunAroundBlock(std::size_t count)
{
  PillarRoom room;
  room.walls = {Eigen::Vector3d(-8, -8, -1), Eigen::Vector3d(8, 8, 2)};
  room.pillars = {{Eigen::Vector3d(-4, -4, -1), Eigen::Vector3d(4, 4, 2)}};
  for (int k = -2; k <= 2; ++k) {
    const double s = 2.9 * k, d = 0.15 * k; // closets along all outer walls
    room.pillars.emplace_back(Eigen::Vector3d(s, 7.2 + d, -1),
                              Eigen::Vector3d(s + 0.7, 8, 1 + d));
    room.pillars.emplace_back(Eigen::Vector3d(s + 0.3, -8, -1),
                              Eigen::Vector3d(s + 1.2, -7.3 + d, 0.5 + d));
    room.pillars.emplace_back(Eigen::Vector3d(7.4 + d, s - 0.2, -1),
                              Eigen::Vector3d(8, s + 0.8, 0.9 + d));
    room.pillars.emplace_back(Eigen::Vector3d(-8, s + 0.1, -1),
                              Eigen::Vector3d(-7.3 + d, s + 0.7, 1.2 + d));
  }
  std::vector<Eigen::Isometry3d> path;
  for (std::size_t i = 0; i < count; ++i) {
    const double turn =
        2 * M_PI * static_cast<double>(i) / static_cast<double>(count - 1);
    const double c = std::cos(turn), s = std::sin(turn);
    const double reach = 5.8 / std::max(std::abs(c), std::abs(s));
    path.push_back(poseFromEuler({reach * c, reach * s, 0}, {0, 0, turn}));
  }
  return makeRunAlong(path, room, 0.045);
}

/** \return options under which errors add up from scan to scan, for relaxation to find */
inline Slam6DOptions
pairwise()
{
  Slam6DOptions options;
  options.metascan = 1;
  options.loop_closing = LoopClosing::kElch;
  options.relaxation = Relaxation::kHelix;
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
    if (toString(stage.kind) == name)
      return &stage;
  return nullptr;
}

inline const DriftingRun&
ring()
{
  static const DriftingRun run = makeRingRun(13);
  return run;
}

} // namespace pcl6d::test
