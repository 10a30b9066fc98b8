// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/interrupt.h"
#include "common/output_folder.h"
#include "common/progress_bar.h"
#include "slam6d/run_scans.h"
#include "slam6d/settings.h"

#include <pcl6d/common/trajectory.h>
#include <pcl6d/filters/map_builder.h>
#include <pcl6d/run/run_summary.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <chrono>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \return what pcl_slam6d may do to its output folder */
OutputRules
runFolderRules(const Settings& settings);

/** \brief What a run gathers on its way, for the summary. */
struct RunLog {
  std::vector<std::size_t> dropped; ///< per scan: points that were not finite
  std::vector<RunResult::Stage> stages;
};

/** \brief Adds a stage with its time and memory at the end of its scope. */
class StageTimer {
public:
  StageTimer(const std::string& name, std::vector<RunResult::Stage>& stages);
  ~StageTimer();
  StageTimer(const StageTimer&) = delete;
  StageTimer&
  operator=(const StageTimer&) = delete;

private:
  std::string name_;
  std::vector<RunResult::Stage>& stages_;
  std::chrono::steady_clock::time_point start_;
};

/** \brief Writes the run folder (share/doc/run_folder.md). */
class RunWriter {
public:
  /** Keeps references to all of them. */
  RunWriter(const Settings& settings,
            const RunScans& scans,
            const Slam6DResult& result,
            const OutputFolder& out,
            ProgressBar& bar,
            const Interrupt& interrupt);

  /** \brief Of an interrupted run, be it before (not complete) or now, only poses, history
   * and summary are written. \return the summary, as it stands in the file */
  const RunResult&
  write(bool complete, const RunLog& log);

private:
  Trajectory
  trajectory() const;
  void
  writeHistory() const;
  bool
  writeScansAndMap(MapBuilder& map, MapBuilder* fine_map);
  void
  writePlanesOf(const MapBuilder& map);
  void
  drawTopView(const MapBuilder& map);
  void
  describe(bool complete, const RunLog& log);
  void
  writeReportOf(const std::filesystem::path& path) const;
  void
  warnOfOdometry();
  void
  writeGraph() const;
  void
  describeGraph();

  const Settings& settings_;
  const RunScans& scans_;
  const ScanFolder& folder_;
  const Slam6DResult& result_;
  const OutputFolder& out_;
  ProgressBar& bar_;
  const Interrupt& interrupt_;
  RunResult summary_;
};

} // namespace pcl6d::app
