// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "graph_stage.h"
#include "kept_scans.h"
#include "motion_stage.h"
#include "moving_stage.h"
#include "online_loops.h"
#include "recovery.h"
#include "run_verification.h"
#include "sequence_matcher.h"

#include <pcl6d/common/progress.h>
#include <pcl6d/common/work_sharing.h>
#include <pcl6d/slam6d/slam6d.h>

#include <atomic>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pcl6d::slam6d {

/** \brief What Slam6D does: the stages of a run one after the other, what they hand on, and what
 * is kept between calls. */
class SlamRun {
public:
  explicit SlamRun(const Slam6DOptions& options);

  /** \param[in] scan with the initial pose, and all else if it is registered */
  void
  addScan(const Points& points, ScanResult scan, const std::string& given_name);

  /** The same, behind scans whose motion is not known yet. */
  void
  addStill(const Points& points, const ScanResult& scan, const std::string& given_name);

  /** A scan whose motion is to be found. */
  void
  addMoving(const Points& points,
            const ScanTimes& times,
            const Eigen::Isometry3d& pose,
            const std::string& given_name);

  void
  addRegistered(const Points& points,
                ScanResult earlier,
                const std::string& name,
                std::size_t group);

  bool
  optimize();

  std::vector<PointMotion>
  motionOf(std::size_t scan, const Points& points) const
  {
    return moving_.motionOf(scan, points);
  }

  void
  setSharing(WorkSharing* with);

  ProgressCallback progress;
  Slam6D::Observer observer;
  WorkSharing* sharing = nullptr;
  TaskMemory* memory = nullptr;
  std::atomic<bool> cancelled_{false};
  Slam6DResult result_;

private:
  /** Scan after scan. \return false if cancelled */
  bool
  optimizeInOrder();

  /** Scans that were lost are looked for once more, by all others. \return false if cancelled */
  bool
  recoverLost();

  /** A map that its scans contradict is taken apart where they do, and put together anew: kept
   * if more scans are tied then. \return false if cancelled */
  bool
  lookAgain();

  bool
  isWithoutSequence() const
  {
    return options_.initial_guess == InitialGuess::kGlobal;
  }

  /** Scans in any order. \return false if cancelled: no scan is registered then */
  bool
  optimizeWithoutPoses();

  /** \return false if cancelled */
  bool
  registerAll();

  /** Takes over what the first process has registered. */
  void
  takeRegistered();

  void
  takeResult();

  /** \return the name of a scan that is about to be added */
  std::string
  nameOf(const std::string& given) const
  {
    return given.empty()
               ? "scan " + std::to_string(result_.scans.size() + motion_.numWaiting())
               : given;
  }

  /** Scans of which is known how they moved. \param[in] all none is to follow */
  void
  addUndone(bool all);

  /** The motion within scans, of all at once. */
  void
  relaxMotions();

  void
  takeInRegistered();

  /** Carries the odometry's motion over from the scan before. */
  void
  predict(std::size_t i)
  {
    result_.scans[i].T_world_scan = predictedPose(result_.scans, i);
  }

  /** Those that wait; parameters follow from the first ones. */
  void
  prepareScans();

  /** Goes on to the next one also if the result cannot be kept. */
  void
  registerScan(std::size_t i);

  /** Chapter 5, when all scans are matched. \return false if cancelled */
  bool
  improve();

  GraphStage
  makeGraphStage(WorkSharing* with, const Slam6DParameters& parameters) const;

  /** A loop that a scan closes is closed before the next one is matched. */
  void
  closeLoopsOnline(std::size_t scan);

  /** Matching goes on behind the first scans, where they are. */
  void
  startAnew(std::size_t count);

  /** \return false if cancelled */
  bool
  runGraphStage();

  /** What moved is found, and takes no part in a last round of relaxation and in the verdict.
   * \return false if cancelled */
  bool
  leaveOutMoving();

  /** \return what a graph stage asks after each round */
  GraphStage::Observer
  relaxing();

  Slam6DOptions options_;
  std::vector<std::uint64_t> inputs_; ///< of each scan: what it and those before are
  KeptScans scans_;
  MotionStage motion_;
  std::size_t num_relaxed_ =
      0; ///< so many scans were there when their motion was relaxed
  std::deque<std::pair<Points, Eigen::Isometry3d>>
      last_still_;                  ///< registered or without times
  std::vector<std::size_t> groups_; ///< of each registered scan: the number of its run
  RunVerification verification_;
  MovingStage moving_;
  Recovery recovery_;
  std::optional<SequenceMatcher> matcher_;
  OnlineLoops online_loops_;
  std::size_t num_registered_ =
      0;                     ///< so many first scans an earlier run has registered
  std::size_t next_ = 0;     ///< first scan that is not registered
  std::size_t improved_ = 0; ///< so many scans went through the graph stage
};

} // namespace pcl6d::slam6d
