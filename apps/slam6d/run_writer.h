// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/output_folder.h"
#include "common/progress_bar.h"
#include "slam6d/settings.h"

#include <pcl6d/io/run_summary.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <chrono>
#include <string>
#include <vector>

namespace pcl6d::app {

/** The file that every run leaves in its folder. */
constexpr const char* kRunMarker = "summary.json";

/** \brief What a run gathers on its way, for the summary. */
struct Run {
  std::vector<std::size_t> dropped; ///< per scan: points that were not finite
  RunSummary summary;
};

/** \brief Adds a stage with its time and memory to the summary at the end of its scope. */
class StageTimer {
public:
  StageTimer(const std::string& name, Run& run);
  ~StageTimer();
  StageTimer(const StageTimer&) = delete;
  StageTimer&
  operator=(const StageTimer&) = delete;

private:
  std::string name_;
  Run& run_;
  std::chrono::steady_clock::time_point start_;
};

/** \brief Writes the run folder (run_folder.md). Of an interrupted run only poses, history
 * and summary are written.
 * \param[in,out] run its summary is completed */
void
writeRun(const Settings& settings,
         const ScanFolder& folder,
         const Slam6DResult& result,
         bool complete,
         ProgressBar& bar,
         const OutputFolder& out,
         Run& run);

/** \return the last lines of a run: the verdict and the files that were written */
std::string
closingText(const RunSummary& summary, const OutputFolder& out);

} // namespace pcl6d::app
