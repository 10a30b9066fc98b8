// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apps/support/room_pair.h"
#include "support/bits.h"

#include <pcl6d/common/random.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace pcl6d::test {

/** \return a room that is like itself from one side only: closets stand in two corners */
inline PillarRoom
closetRoom()
{
  PillarRoom room;
  room.pillars.emplace_back(Eigen::Vector3d(3.5, 1, -1), Eigen::Vector3d(7, 4, 2));
  room.pillars.emplace_back(Eigen::Vector3d(-5, -4, -1), Eigen::Vector3d(-3, -2.6, 2));
  return room;
}

/** \return where the i-th scan of the room was taken, 0.7 m and 11 deg from the one before */
inline Eigen::Isometry3d
placeInRoom(int i)
{
  return poseFromEuler({-2 + 0.7 * i, 0.4 * std::sin(i), 0.1}, {0.01 * i, 0, 0.2 * i});
}

/** \brief Runs of pcl_slam6d over scans of rooms, each in a world of its own. */
struct JoinedRooms : TempFolder {
  /** A drive through a room, whose scans are named scan000.xyz and so on. */
  struct Drive {
    std::vector<int> places;        ///< see placeInRoom()
    Eigen::Isometry3d T_world_room; ///< of its odometry
    double step = 0.03;             ///< [rad] between rays
    std::string name = "scan";      ///< of its files
    PillarRoom room = closetRoom();
    double unit = 1; ///< in which its files are written [m]
    std::uint64_t seed = 3;
  };

  /** Makes the folder NAME.scans. */
  void
  writeScans(const std::string& name, const Drive& drive) const
  {
    std::filesystem::create_directory(*this / (name + ".scans"));
    Random random(drive.seed);
    Trajectory odometry;
    for (std::size_t k = 0; k < drive.places.size(); ++k) {
      const Eigen::Isometry3d T_room_scan = placeInRoom(drive.places[k]);
      std::ostringstream text;
      for (const auto& p : drive.room.scan(T_room_scan, random, drive.step))
        text << p.x() / drive.unit << ' ' << p.y() / drive.unit << ' '
             << p.z() / drive.unit << '\n';
      writeText(*this /
                    (name + ".scans/" + drive.name + "00" + std::to_string(k) + ".xyz"),
                text.str());
      odometry.poses.push_back(drive.T_world_room * T_room_scan *
                               planarPose(0.02, -0.02, 0.01)); // it drifts
      odometry.poses.back().translation() /= drive.unit;
    }
    writeTrajectoryKitti(*this / (name + ".scans/odometry.txt"), odometry);
  }

  /** Makes the folder NAME, a finished run over such scans. */
  Outcome
  run(const std::string& name,
      const Drive& drive,
      std::vector<std::string> options = {}) const
  {
    writeScans(name, drive);
    options.insert(options.begin(),
                   {(*this / (name + ".scans")).string(),
                    "-o",
                    (*this / name).string(),
                    "--no-picture",
                    "--quiet"});
    const Outcome outcome = runProgram("pcl_slam6d", options);
    EXPECT_EQ(outcome.exit_code, 0) << name << ": " << outcome.err;
    return outcome;
  }

  /** Joins runs into the folder OUT. */
  Outcome
  join(const std::vector<std::string>& runs,
       const std::string& out,
       const std::vector<std::string>& options = {"--no-picture"}) const
  {
    std::vector<std::string> all{"--join"};
    for (const auto& run : runs)
      all.push_back(*this / run);
    all.insert(all.end(), {"-o", (*this / out).string()});
    all.insert(all.end(), options.begin(), options.end());
    return runProgram("pcl_slam6d", all);
  }

  nlohmann::json
  summary(const std::string& run) const
  {
    return nlohmann::json::parse(readText(*this / (run + "/summary.json")));
  }
  std::vector<Eigen::Isometry3d>
  poses(const std::string& run) const
  {
    return readTrajectory(*this / (run + "/trajectory.kitti")).poses;
  }
};

// A quarter of the voxels that are joined, and the turn that moves walls 5 m away by as much.
inline constexpr double kPlaceTol = 0.05, kTurnTol = 0.01;

inline const Eigen::Isometry3d kMonday = poseFromEuler({20, -3, 1}, {0.1, -0.2, 2});
inline const Eigen::Isometry3d kTuesday = poseFromEuler({-7, 40, 2}, {-0.3, 0.1, -1});

/** Two drives through one room, the second one in other places, backwards, with another
 * scanner. */
class Join : public testing::Test {
protected:
  static void
  SetUpTestSuite()
  {
    rooms_ = new JoinedRooms;
    rooms_->run("monday", {{0, 2, 4}, kMonday});
    JoinedRooms::Drive tuesday{{5, 3, 1}, kTuesday, 0.04};
    tuesday.seed = 8;
    rooms_->run("tuesday", tuesday);
  }
  static void
  TearDownTestSuite()
  {
    delete rooms_;
    rooms_ = nullptr;
  }

  static const JoinedRooms&
  rooms()
  {
    return *rooms_;
  }

  /** \param[in] places of the scans of a run, in their order */
  static void
  expectPlaces(const std::string& run,
               const std::vector<int>& places,
               const Eigen::Isometry3d& T_world_room)
  {
    const auto poses = rooms().poses(run);
    ASSERT_EQ(poses.size(), places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      SCOPED_TRACE("scan " + std::to_string(i));
      // The odometry has moved the world by as much as its first scan.
      const Eigen::Isometry3d T_moved_room =
          poses[0] * placeInRoom(places[0]).inverse();
      const MotionSize off =
          distanceBetween(T_moved_room * placeInRoom(places[i]), poses[i]);
      EXPECT_LT(off.translation, kPlaceTol);
      EXPECT_LT(off.rotation, kTurnTol);
    }
    EXPECT_LT(
        distanceBetween(T_world_room * placeInRoom(places[0]), poses[0]).translation,
        kPlaceTol);
  }

  /** Joining is refused with these words, and leaves everything as it was. */
  static void
  expectRefused(const std::vector<std::string>& runs,
                const std::string& out,
                int exit_code,
                const std::vector<std::string>& words)
  {
    const auto before = contentOf(rooms().path());
    expectError(rooms().join(runs, out), "pcl_slam6d", exit_code, words);
    EXPECT_EQ(contentOf(rooms().path()), before);
  }

  static JoinedRooms* rooms_;
};
inline JoinedRooms* Join::rooms_ = nullptr;

} // namespace pcl6d::test
