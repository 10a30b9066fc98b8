// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "judge.h"

#include <chrono>

namespace pcl6d::faults {

struct RunnerOptions {
  std::filesystem::path programs; ///< folder of the programs
  std::filesystem::path samples;  ///< folder of the valid inputs
  std::filesystem::path scratch;  ///< a folder of its own, which is emptied
  std::size_t jobs = 1;           ///< processes at once
  Limits limits;
  /** No case is begun later, but for the first ones, so that some are run in any case. */
  std::chrono::steady_clock::time_point last_start =
      std::chrono::steady_clock::time_point::max();
};

/** \return the command of a case whose files lie in a folder */
Command
commandOf(const Case& one,
          const std::filesystem::path& programs,
          const std::filesystem::path& place);

/** \brief Copies the inputs of a case into the folder and breaks them.
 * \return [B] of its inputs before */
void
prepare(const Case& one,
        const std::filesystem::path& samples,
        const std::filesystem::path& folder);

/** \brief Runs each case in a folder of its own, several at once, and tells how it went.
 * \param[in] told called once for each case that was run, in the order in which they end */
void
runCases(const std::vector<Case>& cases,
         const RunnerOptions& options,
         const std::function<void(const Case&, const Trace&)>& told);

} // namespace pcl6d::faults
