// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/process/interrupt.h"

#include <pcl6d/common/run_result.h>

#include <filesystem>
#include <string>
#include <vector>

/** \file The pictures and the report of a run, drawn after all other files are published: in a
 * separate process, because OpenGL drivers and X servers may end the calling process. */
namespace pcl6d::app {

/** Word that makes pcl_slam6d draw the run in the folder given after it, and exit. */
constexpr const char* kDrawWord = "--draw";

/** \brief Draws the files requested by the options of a finished run: top_view.png, planes.png,
 * report.html, survey.html. Reports failures on stderr, with reasons.
 * \return the exit code: kDoubtful if a file is missing
 * \throws IoFailed the folder has no run */
int
drawRun(const std::filesystem::path& folder);

/** \brief The result of drawing. */
struct Drawing {
  std::vector<std::filesystem::path> drawn;
  std::vector<std::string> warnings; ///< missing files, with reasons and how to draw
                                     ///< them again
  bool is_missing = false;           ///< a requested file is missing
  double seconds = 0;
};

/** \brief drawRun() in a separate process, with limits of time and memory.
 * \param[in] run the run in the folder
 * \param[in] memory [bytes] lower bound of the memory limit */
Drawing
drawApart(const std::filesystem::path& folder,
          const RunResult& run,
          std::size_t memory,
          const Interrupt& interrupt);

} // namespace pcl6d::app
