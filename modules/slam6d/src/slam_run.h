// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/pipeline.h"

#include <pcl6d/slam6d/slam6d.h>

#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace pcl6d::slam6d {

/** \brief Implementation of Slam6D: takes scans, and runs the stages of pipeline.cpp. */
class SlamRun {
public:
  explicit SlamRun(const Slam6DOptions& options)
  : state_(options), given_links_(options.given_links)
  {}

  /** Adds a static scan after the scans that wait for their motion.
   * \param[in] scan with the initial pose; a registered scan with its complete result
   * \param[in] drive see Slam6D::addScan() */
  void
  addStill(const Points& points,
           const ScanResult& scan,
           const std::string& given_name,
           const DriveContext& drive = {});

  /** Adds a scan with unknown motion. */
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

  void
  addStage(std::shared_ptr<SlamStage> stage, SlamStage::Place place);

  /** \return false if cancelled */
  bool
  optimize();

  std::vector<PointMotion>
  motionOf(std::size_t scan, const Points& points) const
  {
    return state_.moving.motionOf(scan, points);
  }

  const Slam6DResult&
  result() const
  {
    return state_.result;
  }

  void
  setSharing(WorkSharing* with);

  SlamContext context;

private:
  void
  addScan(const Points& points,
          ScanResult scan,
          const std::string& given_name,
          const DriveContext& drive);

  /** Adds the scans with known motion. \param[in] all no further scans are expected */
  void
  addUndone(bool all);

  /** \return the name of the scan added next */
  std::string
  nameOf(const std::string& given) const
  {
    return given.empty()
               ? "scan " + std::to_string(state_.size() + state_.motion.numWaiting())
               : given;
  }

  SlamState state_;
  std::vector<ScanPair> given_links_;
  AddedStages added_;
  StageList stages_; ///< created at the first run
  std::deque<std::pair<Points, Eigen::Isometry3d>>
      last_still_; ///< registered or without times
};

} // namespace pcl6d::slam6d
