// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/interrupt.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <string>

namespace pcl6d::app {

/** \brief How a run in a process of its own ended. */
enum class RunEnd {
  kDone,
  kThrew,       ///< an exception: words
  kCrashed,     ///< a signal: words
  kTimeOut,     ///< it was ended because its time was over
  kInterrupted, ///< so was it because a signal came to this process
};

/** \brief What a run in a process of its own came to. */
struct LimitedRun {
  RunEnd end = RunEnd::kDone;
  nlohmann::json result; ///< of kDone
  std::string words;     ///< what was thrown, or which signal it was
  std::string said;      ///< what it printed, without colours, shortened
  std::string stage;     ///< that it entered last; empty: none
};

/** \brief Within a run: tells what is done next, in case that it is the last thing. */
void
enterStage(const char* name);

/** \brief Computes in a process of its own, a copy of this one: whatever it does to memory,
 * however long it takes, this process goes on. PCL's warnings and errors are heard.
 * \param[in] seconds time limit, > 0
 * \throws IoFailed no process can be made */
LimitedRun
runLimited(double seconds,
           const Interrupt& interrupt,
           const std::function<nlohmann::json()>& work);

} // namespace pcl6d::app
