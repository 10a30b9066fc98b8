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

/** \return per scan whether it was matched, or is the first one */
std::vector<bool>
believedOf(const Slam6DResult& result);

/** \brief Chapter 5 on scans that were matched one by one: closes the loops that are found,
 * then relaxes the network of all scans. A stage that makes the map worse is undone. */
class GraphStage {
public:
  /** Called after each round of relaxation with its number, from 1. \return false to stop
   */
  using Observer = std::function<bool(int)>;

  /** Options, parameters and models are kept by reference.
   * \param[in] icp how scans are matched
   * \param[in] normals how normals are made where the models have none: links are weighed
   * by planes, whatever the metric of matching */
  GraphStage(const Slam6DOptions& options,
             const Slam6DParameters& parameters,
             const IcpOptions& icp,
             const IcpModel::Options& normals,
             const std::deque<IcpModel>& models);

  /** \brief Changes poses, covariances, links, stages, graph and floating of the result.
   * \return false if the observer stopped it: the result is then half changed, and is to be
   * thrown away */
  bool
  run(Slam6DResult& result, const Observer& observer);

private:
  void
  judgeMatching(Slam6DResult& result) const;
  void
  closeLoops(Slam6DResult& result);
  bool
  relax(Slam6DResult& result, const Observer& observer);
  GraphSlamOptions
  graphOptions() const;
  ScanNetwork
  makeNetwork(const Slam6DResult& result) const;
  std::vector<Loop>
  openLoops(const std::vector<ScanLink>& found, const Poses& poses) const;
  std::vector<ScanLink>
  odometryLinks(ScanNetwork& network, const Slam6DResult& result) const;
  static std::vector<PoseLink>
  measuredLinks(const std::vector<ScanLink>& odometry, const Slam6DResult& result);
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
  std::deque<IcpModel> with_normals_; ///< where those of the caller have none
  std::vector<NetworkScan> scans_;
};

} // namespace pcl6d::slam6d
