// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/interrupt.h"

#include <pcl6d/common/run_result.h>

#include <filesystem>
#include <string>
#include <vector>

/** \file The pictures and the report of a run, drawn when all else is in its place: by a
 * process of their own, as OpenGL drivers and X servers end the one that calls them. */
namespace pcl6d::app {

/** The only word before the folder with which pcl_slam6d draws and does nothing else. */
constexpr const char* kDrawWord = "--draw";

/** \brief Draws what the options of a finished run ask for: top_view.png, planes.png,
 * report.html. Tells on stderr what cannot be drawn, and why.
 * \return the exit code: kDoubtful if something is missing
 * \throws IoFailed there is no run in the folder */
int
drawRun(const std::filesystem::path& folder);

/** \brief What became of the pictures. */
struct Drawing {
  std::vector<std::filesystem::path> drawn;
  std::vector<std::string> warnings; ///< what is missing, why, and how to draw it again
  bool is_missing = false;           ///< something that was asked for
  double seconds = 0;
};

/** \brief The same by a process of its own, with limits of time and memory.
 * \param[in] run what is in the folder
 * \param[in] memory [bytes] that it may take at least */
Drawing
drawApart(const std::filesystem::path& folder,
          const RunResult& run,
          std::size_t memory,
          const Interrupt& interrupt);

} // namespace pcl6d::app
