// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/graph_relaxation/graph_slam.h>
#include <pcl6d/graph_relaxation/loop_detection.h>
#include <pcl6d/graph_relaxation/network_scan.h>
#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <deque>
#include <functional>

namespace pcl6d::slam6d {

/** \return T_world_scan of all scans */
Poses
posesOf(const Slam6DResult& result);

/** \brief Loops closed during matching. */
struct ClosedLoops {
  std::vector<ScanLink> links; ///< all candidates, accepted or rejected
  std::vector<StageResult> stages;
};

/** \brief Loop closing and relaxation of matched scans (chapter 5): closes the detected loops, then
 * relaxes the network of all scans. A stage that makes the map worse is reverted. */
class GraphStage {
public:
  /** Called after each round of relaxation with its number, from 1. May throw, which ends the
   * stage: the result is then inconsistent and must be discarded. */
  using Observer = std::function<void(int)>;

  /** Options and parameters are kept by reference.
   * \param[in] icp options of matching
   * \param[in] normals options for models without normals: links are weighted by planes for every
   * metric
   * \param[in] sharing of the work between processes; null: a single process */
  GraphStage(const Slam6DOptions& options,
             const Slam6DParameters& parameters,
             const IcpOptions& icp,
             const IcpModel::Options& normals,
             WorkSharing* sharing);

  /** \brief The next scan. Kept by reference. */
  void
  add(const IcpModel& model);

  /** \return the number of added scans */
  std::size_t
  size() const
  {
    return scans_.size();
  }

  /** \brief Detects and closes loops that end at the last scan, during matching. Changes poses,
   * links and stages of the result.
   * \param[in,out] result whose first scans are the added scans
   * \return whether poses have changed */
  bool
  closeLoopsOfLast(Slam6DResult& result);

  /** \brief Changes poses, covariances, links, stages, graph and floating of the result, whose
   * scans are the added scans. \param[in] online loops closed before */
  void
  run(Slam6DResult& result, const ClosedLoops& online, const Observer& observer);

  /** \brief Runs another round of relaxation, and a last one with many pairs, with the scans added to
   * this stage, from which the dynamic points were removed. No effect without relaxation in the options. */
  void
  relaxAgain(Slam6DResult& result, const Observer& observer);

private:
  /** \return whether scans are in the order of their acquisition */
  bool
  isSequence() const
  {
    return options_.initial_guess != InitialGuess::kGlobal;
  }
  void
  compareMatching(Slam6DResult& result) const;
  bool
  closeLoops(Slam6DResult& result, std::size_t first);
  LoopDetectionOptions
  detectionOptions(const Slam6DResult& result, std::size_t first) const;
  void
  relax(Slam6DResult& result, int rounds, const Observer& observer);
  void
  matchSimultaneously(Slam6DResult& result, const Observer& observer);
  GraphSlamOptions
  graphOptions(int rounds) const;
  ScanNetwork
  makeNetwork(const Slam6DResult& result) const;
  std::vector<ScanLink>
  odometryLinks(ScanNetwork& network, const Slam6DResult& result) const;
  void
  take(const GraphSlamResult& relaxed,
       bool reverted,
       std::vector<ScanLink> links,
       const std::vector<ScanLink>& odometry,
       Slam6DResult& result) const;
  StageResult
  evaluated(StageKind kind,
            const Poses& before,
            const Poses& after,
            const std::vector<bool>& counted,
            const Rejection& failure = {}) const;

  const Slam6DOptions& options_;
  const Slam6DParameters& parameters_;
  IcpOptions icp_;
  IcpModel::Options normals_;
  WorkSharing* sharing_;
  std::deque<IcpModel> with_normals_; ///< for models without normals
  std::vector<NetworkScan> scans_;
};

} // namespace pcl6d::slam6d
