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

/** \brief Loops that were closed while scans were matched. */
struct ClosedLoops {
  std::vector<ScanLink> links; ///< all candidates, with their verdicts
  std::vector<StageResult> stages;
};

/** \brief Chapter 5 on scans that were matched one by one: closes the loops that are found,
 * then relaxes the network of all scans. A stage that makes the map worse is undone. */
class GraphStage {
public:
  /** Called after each round of relaxation with its number, from 1. \return false to stop
   */
  using Observer = std::function<bool(int)>;

  /** Options and parameters are kept by reference.
   * \param[in] icp how scans are matched
   * \param[in] normals how normals are made where the models have none: links are weighed
   * by planes, whatever the metric of matching
   * \param[in] sharing of the work between processes; null: this one does all */
  GraphStage(const Slam6DOptions& options,
             const Slam6DParameters& parameters,
             const IcpOptions& icp,
             const IcpModel::Options& normals,
             WorkSharing* sharing);

  /** \brief The next scan. Kept by reference. */
  void
  add(const IcpModel& model);

  /** \return the number of scans that were added */
  std::size_t
  size() const
  {
    return scans_.size();
  }

  /** \brief Looks for loops that the last scan closes, and closes them: for loops that are
   * closed while scans are still matched. Changes poses, links and stages of the result.
   * \param[in,out] result whose first scans are those that were added
   * \return whether poses have changed */
  bool
  closeLoopsOfLast(Slam6DResult& result);

  /** \brief Changes poses, covariances, links, stages, graph and floating of the result, whose
   * scans are those that were added. \param[in] online loops that were closed before
   * \return false if the observer stopped it: the result is then half changed, and is to be
   * thrown away */
  bool
  run(Slam6DResult& result, const ClosedLoops& online, const Observer& observer);

  /** \brief One more round of relaxation, with the scans that were added now in place of those that
   * the result was made of: without what moved. Nothing is done if the options relax nothing.
   * \return as run() */
  bool
  relaxAgain(Slam6DResult& result, const Observer& observer);

private:
  bool
  isSequence() const;
  void
  judgeMatching(Slam6DResult& result) const;
  bool
  closeLoops(Slam6DResult& result, std::size_t first);
  LoopDetectionOptions
  detectionOptions(const Slam6DResult& result, std::size_t first) const;
  bool
  relax(Slam6DResult& result, int rounds, const Observer& observer);
  bool
  matchSimultaneously(Slam6DResult& result, const Observer& observer);
  GraphSlamOptions
  graphOptions(int rounds) const;
  ScanNetwork
  makeNetwork(const Slam6DResult& result) const;
  std::vector<ScanLink>
  odometryLinks(ScanNetwork& network, const Slam6DResult& result) const;
  void
  take(const GraphSlamResult& relaxed,
       bool undone,
       std::vector<ScanLink> links,
       const std::vector<ScanLink>& odometry,
       Slam6DResult& result) const;
  StageResult
  judged(StageKind kind,
         const Poses& before,
         const Poses& after,
         const std::vector<bool>& counted) const;

  const Slam6DOptions& options_;
  const Slam6DParameters& parameters_;
  IcpOptions icp_;
  IcpModel::Options normals_;
  WorkSharing* sharing_;
  std::deque<IcpModel> with_normals_; ///< where those of the caller have none
  std::vector<NetworkScan> scans_;
};

} // namespace pcl6d::slam6d
