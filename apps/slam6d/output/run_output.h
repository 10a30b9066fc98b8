// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/output/output_folder.h"
#include "common/process/interrupt.h"
#include "common/progress_bar.h"
#include "slam6d/input/kept_clouds.h"
#include "slam6d/input/run_input.h"
#include "slam6d/options/moving_output.h"
#include "slam6d/options/settings.h"
#include "slam6d/stage_timer.h"

#include <pcl6d/common/run_result.h>
#include <pcl6d/filters/map_builder.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/slam6d/slam6d.h>

#include <string>
#include <vector>

namespace pcl6d::app {

/** \return the rules for changes of the output folder by pcl_slam6d */
OutputRules
runFolderRules(const Settings& settings, const ScanFolder& folder);

/** \return whether the folder contains a complete run, or a run of unknown state */
bool
holdsCompleteRun(const OutputFolder& out);

/** \brief Data gathered during a run. */
struct RunLog {
  std::vector<std::size_t> dropped; ///< number of non-finite points of each scan
  std::vector<RunResult::Stage> stages;
  std::vector<std::string> warnings;
  std::string joined; ///< joined runs, for the verdict; else empty
};

/** \return the timing for people: a line for each part of the work, and for each stage that changes
 * poses \param[in] drawing [s] time of drawing after the run */
std::string
timingOf(const RunResult& run, double drawing);

/** \brief Writes all results of pcl_slam6d to files: the run folder and planes. Pictures and report
 * are drawn after publishing (run_drawing.h). */
class RunOutput {
public:
  /** All arguments are kept by reference. */
  RunOutput(const Settings& settings,
            const RunInput& input,
            const Slam6D& slam,
            const OutputFolder& out,
            ProgressBar& bar,
            const Interrupt& interrupt);

  /** \brief Writes a run. For an interrupted run (not complete, or interrupted while writing), only
   * poses, history and summary are written.
   * \param[in] clouds the registered scans; dropped as they are written
   * \return the run, equal to its summary
   * \throws IoFailed a file cannot be written, or is missing at the end */
  const RunResult&
  write(bool complete, const RunLog& log, KeptClouds& clouds);

private:
  void
  describe(bool complete, const RunLog& log);
  void
  describeDrive();
  void
  warnOfOdometry();
  void
  warnOfMissingPoses();
  void
  warnOfBoundedRecovery();
  bool
  writeScans(KeptClouds& clouds, MapBuilder& map, MapBuilder* fine_map);
  void
  writePlanesOf(const MapBuilder& map);
  void
  requireAllFiles() const;

  const Settings& settings_;
  const RunInput& input_;
  const ScanFolder& folder_;
  const Slam6DResult& result_;
  MovingOutput moving_;
  const OutputFolder& out_;
  ProgressBar& bar_;
  const Interrupt& interrupt_;
  RunResult run_;
};

} // namespace pcl6d::app
