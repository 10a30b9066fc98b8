// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief How much a finding matters. */
enum class Severity {
  kProblem, ///< a result is wrong, or there is none, because of it
  kWarning, ///< a result is worse than it could be, or says more than it knows
  kNote     ///< good to know
};

/** \return "problem", "warning" or "note" */
const char*
toString(Severity severity);

/** \brief What the doctor found on the clouds of the user, and what to do about it. */
struct Finding {
  Severity severity = Severity::kNote;
  std::string what;     ///< one line
  std::string measured; ///< the numbers that say so
  std::string advice;   ///< what to set or do; empty: nothing
};

using Findings = std::vector<Finding>;

} // namespace pcl6d::app
