// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../run_verification.h"
#include "any_order/joined_runs.h"
#include "dynamic/moving_stage.h"
#include "graph/graph_stage.h"
#include "graph/online_loops.h"
#include "map.h"
#include "matching/kept_scans.h"
#include "motion/motion_stage.h"
#include "recovery/recovery.h"

#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pcl6d::slam6d {

/** \brief The state of a run. The result owns the poses; all other members refer to scans by
 * index. */
struct SlamState {
  explicit SlamState(const Slam6DOptions& given);
  SlamState(const SlamState&) = delete; // members refer to each other
  SlamState&
  operator=(const SlamState&) = delete;

  /** \return whether the order of the scans does not matter */
  bool
  isWithoutSequence() const
  {
    return options.initial_guess == InitialGuess::kGlobal;
  }

  std::size_t
  size() const
  {
    return result.scans.size();
  }

  /** \return a graph stage without scans \param[in] parameters kept by reference */
  GraphStage
  makeGraphStage(WorkSharing* sharing, const Slam6DParameters& parameters) const;

  /** \brief Sets the pose of a scan to where the odometry leads from the scan before. */
  void
  predict(std::size_t scan)
  {
    result.scans[scan].T_world_scan = predictedPose(result.scans, scan);
  }

  /** \brief Gives the registered poses of planar scans the height, roll and pitch of the first
   * scan. Scans with an initial pose outside the first scan's plane are unchanged. */
  void
  keepInPlane();

  Slam6DOptions options; ///< with the initial_guess of the tried start
  Slam6DResult result;
  KeptScans scans;
  RunVerification verification; ///< keeps the scans as rays and surfaces
  MotionStage motion;
  MovingStage moving;
  Recovery recovery;
  OnlineLoops online_loops;
  std::optional<Map> map; ///< once parameters are derived

  std::vector<std::size_t> groups;    ///< run number of each scan of an earlier run
  std::vector<std::uint64_t> inputs;  ///< for each scan: hash of the scans up to it
  std::size_t num_of_earlier_run = 0; ///< number of scans registered by an earlier run
  std::size_t next = 0;               ///< first unregistered scan
  std::size_t improved = 0;           ///< number of scans at the last relaxation
  std::size_t adjusted = 0; ///< number of scans at the last adjustment to refined links
  bool is_order_tried = false; ///< the order of the scans is only a trial
  KnownPlaces
      pieces; ///< of a trial: poses of lost scans in pieces matched with each other
  KnownPlaces
      beside; ///< poses of scans that stay lost in pieces, matched with each other
  std::size_t breaks = 0; ///< of a trial: scans matched neither with the map nor with a
                          ///< lost scan before
  bool is_second_look =
      false; ///< lost scans are recovered, and all scans relaxed, once more
};

} // namespace pcl6d::slam6d
