// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief How much a finding matters. */
enum class Severity {
  kProblem, ///< causes a wrong or missing result
  kWarning, ///< causes a worse or overconfident result
  kNote     ///< good to know
};

/** \return "problem", "warning" or "note" */
const char*
toString(Severity severity);

/** \brief A finding on the clouds of the user, with advice. */
struct Finding {
  Severity severity = Severity::kNote;
  std::string what;     ///< one line
  std::string measured; ///< supporting numbers
  std::string advice;   ///< recommended action; may be empty
};

using Findings = std::vector<Finding>;

} // namespace pcl6d::app
