// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/process/interrupt.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <string>

namespace pcl6d::app {

/** \brief End of a run in a process of its own. */
enum class RunEnd {
  kDone,
  kThrew,       ///< an exception: words
  kCrashed,     ///< a signal: words
  kTimeOut,     ///< killed at the time limit
  kInterrupted, ///< killed after a signal to this process
};

/** \brief Result of a run in a process of its own. */
struct LimitedRun {
  RunEnd end = RunEnd::kDone;
  nlohmann::json result; ///< of kDone
  std::string words;     ///< message of the exception, or name of the signal
  std::string said;      ///< printed text, without colours, shortened
  std::string stage;     ///< last stage entered; may be empty
};

/** \brief Within a run: announces the next stage, in case the run ends there. */
void
enterStage(const char* name);

/** \brief Computes in a child process, a copy of this process. Memory errors and
 * endless loops of the work do not harm this process. Warnings and errors of PCL are
 * captured.
 * \param[in] seconds time limit, > 0
 * \throws IoFailed the child process cannot be made */
LimitedRun
runLimited(double seconds,
           const Interrupt& interrupt,
           const std::function<nlohmann::json()>& work);

} // namespace pcl6d::app
