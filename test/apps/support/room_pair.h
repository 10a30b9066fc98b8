// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/room.h"
#include "support/run_program.h"

#include <pcl6d/io/trajectory_io.h>

#include <sstream>
#include <string>
#include <vector>

namespace pcl6d::test {

/** \brief Runs `pcl_slam6d_evaluate icp`. */
inline Outcome
evaluateIcp(std::vector<std::string> arguments)
{
  arguments.insert(arguments.begin(), "icp");
  return runProgram("pcl_slam6d_evaluate", arguments);
}

/** \brief A folder with two scans of a room, a.xyz and b.xyz, and their odometry. */
struct RoomPair : TempFolder {
  RoomPair()
  {
    Random random(3);
    const PillarRoom room;
    const Eigen::Isometry3d first = planarPose(-1, 0.3, 0.1);
    write("a.xyz", room.scan(first, random, 0.1));
    write("b.xyz", room.scan(first * truth, random, 0.1));
    Trajectory odometry;
    odometry.poses = {first, first * truth * planarPose(0.05, -0.05, 0.02)};
    writeTrajectoryKitti(*this / "odometry.txt", odometry);
  }

  void
  write(const std::string& name, const Points& points) const
  {
    std::ostringstream text;
    for (const auto& p : points)
      text << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    writeText(*this / name, text.str());
  }

  /** \return the two scans and a grid of 27 starts, with more arguments behind */
  std::vector<std::string>
  arguments(const std::vector<std::string>& more = {}) const
  {
    std::vector<std::string> all = {*this / "a.xyz",
                                    *this / "b.xyz",
                                    "--voxel",
                                    "0.2",
                                    "--offset-xy",
                                    "0.2",
                                    "--offset-yaw",
                                    "3",
                                    "--steps-xy",
                                    "3",
                                    "--steps-yaw",
                                    "3"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  Eigen::Isometry3d truth = poseFromEuler({0.4, -0.2, 0.05}, {0.02, -0.01, 0.2});
};

} // namespace pcl6d::test
