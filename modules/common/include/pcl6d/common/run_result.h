// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What summary.json tells of a run, in plain data. \ingroup common */
struct RunResult {
  static constexpr int kSchemaVersion = 1;

  /** \brief An option and where its value comes from. */
  struct Option {
    std::string name;
    std::string value;
    std::string source; ///< "given", "default" or "derived"
    std::string why;    ///< of a derived value; else empty
  };

  struct Stage {
    std::string name;
    double seconds = 0;
    double peak_memory_mb = 0; ///< largest resident size of the process so far [MB]
  };

  struct ScanEntry {
    std::string file; ///< its name in the folder that it came from
    int index = 0;    ///< NNN of the run's files that belong to it
    Eigen::Isometry3d initial_pose = Eigen::Isometry3d::Identity(); ///< as given
    Eigen::Isometry3d T_world_scan =
        Eigen::Isometry3d::Identity(); ///< full coordinates
    /** of x y z roll pitch yaw [m, rad]; none if not known */
    std::optional<Eigen::Matrix<double, 6, 6>> covariance;
    std::string state;  ///< "fixed", "matched", ...
    std::string status; ///< of ICP
    std::string start;  ///< where ICP started from: "odometry", "overlap", "features"
    std::size_t points = 0;
    std::size_t dropped = 0; ///< points left out because they were not finite
    std::size_t reduced = 0;
    std::size_t pairs = 0;
    double rms = 0; ///< [m]
    double overlap = 0;
    int iterations = 0;
    double correction = 0; ///< [m] from the predicted to the matched position
    std::string reason;    ///< why the match is not believed; else empty
  };

  /** \brief A stage that changes poses, and how the agreement of the scans judged it. */
  struct GraphStage {
    std::string name;    ///< "matching", "loop closing", "relaxation"
    bool undone = false; ///< its poses were not taken
    std::string reason;  ///< why; else empty
    double agreement_before = 0;
    double agreement_after = 0;
    int rounds = 0;
    double seconds = 0;
  };

  std::string generator; ///< the program's name
  std::string version;
  Eigen::Vector3d world_offset = Eigen::Vector3d::Zero(); ///< [m]
  std::string pose_source;
  std::vector<Option> options;
  std::vector<Stage> stages;
  std::vector<ScanEntry> scans;
  std::vector<GraphStage> graph_stages;
  std::size_t links_used = 0;
  std::size_t links_refused = 0;     ///< loop candidates included
  std::vector<std::string> floating; ///< files that no link joins to the first scan
  std::size_t map_points = 0;
  bool complete = true; ///< false: interrupted, part of the scans is not registered
  bool trusted = true;  ///< every scan was matched
  std::vector<std::string> warnings; ///< what went wrong without touching the poses
  std::string verdict; ///< the same in words, naming what is not to be trusted
};

} // namespace pcl6d
