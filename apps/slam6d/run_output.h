// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/interrupt.h"
#include "common/output_folder.h"
#include "common/progress_bar.h"
#include "slam6d/kept_clouds.h"
#include "slam6d/moving_output.h"
#include "slam6d/settings.h"

#include <pcl6d/common/run_result.h>
#include <pcl6d/filters/map_builder.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/slam6d/slam6d.h>

#include <chrono>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \return what pcl_slam6d may do to its output folder */
OutputRules
runFolderRules(const Settings& settings, const ScanFolder& folder);

/** \return whether a run that was not interrupted is in the folder, or one of which that
 * cannot be told */
bool
holdsCompleteRun(const OutputFolder& out);

/** \brief What a run gathers on its way. */
struct RunLog {
  std::vector<std::size_t> dropped; ///< per scan: points that were not finite
  std::vector<RunResult::Stage> stages;
  std::vector<std::string> warnings;
  std::string joined; ///< which runs were joined, for the verdict; else empty
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

/** \return where the time went, for people: a line for each part of the work, and for each
 * stage that changes poses \param[in] drawing [s] what came after the run */
std::string
timingOf(const RunResult& run, double drawing);

/** \brief All that pcl_slam6d computes, as files: the run folder and planes. Pictures and
 * report are drawn when these are in their place (run_drawing.h). */
class RunOutput {
public:
  /** Keeps references to all of them. */
  RunOutput(const Settings& settings,
            const ScanFolder& folder,
            const Slam6D& slam,
            const OutputFolder& out,
            ProgressBar& bar,
            const Interrupt& interrupt);

  /** \brief Of an interrupted run, be it before (not complete) or now, only poses, history
   * and summary are written.
   * \param[in] clouds the scans as they were registered; given up as they are written
   * \return the run, as its summary tells
   * \throws IoFailed a file cannot be written, or is gone when all are */
  const RunResult&
  write(bool complete, const RunLog& log, KeptClouds& clouds);

private:
  void
  describe(bool complete, const RunLog& log);
  void
  warnOfOdometry();
  bool
  writeScans(KeptClouds& clouds, MapBuilder& map, MapBuilder* fine_map);
  void
  writePlanesOf(const MapBuilder& map);
  void
  requireAllFiles() const;

  const Settings& settings_;
  const ScanFolder& folder_;
  const Slam6DResult& result_;
  MovingOutput moving_;
  const OutputFolder& out_;
  ProgressBar& bar_;
  const Interrupt& interrupt_;
  RunResult run_;
};

} // namespace pcl6d::app
