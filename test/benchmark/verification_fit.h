// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/verification/link_evidence.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace pcl6d::bench {

/** \brief A link of a set with the result of its verification. */
struct EvaluatedLink {
  std::string set;
  std::string group; ///< left out together: the set itself, or its sensor
  std::string kind;  ///< of TestedLink
  double off = 0;    ///< [m]
  double turn = 0;   ///< [rad]
  LinkEvidence evidence;
  LinkTrust trust = LinkTrust::kWeak;
};

/** \brief A table by group: right links good, weak and wrong; other places (minima, folds,
 * scans apart) called good; shifts and turns by more than 5 cm and three stated deviations
 * called good. */
void
printVerdicts(const std::vector<EvaluatedLink>& links, std::ostream& out);

/** \brief Fits the constants of contradictions (calibration.h) anew for each group from all
 * others, and tests the links of the group with the fitted constants and with the constants in use:
 * right links doubted, and other places called good, by rays alone. Beside them the number of other
 * places that overlap and rms would call good, with the limit that doubts 3 % of the right links of
 * the others. */
void
printLeaveOneOut(const std::vector<EvaluatedLink>& links, std::ostream& out);

/** \brief The same for the shift that surfaces require: a limit that 0.5 % of the right links of
 * all other groups exceed, and the limits in use; right links of the group above, and its wrong
 * shifts and turns below. */
void
printShiftLimits(const std::vector<EvaluatedLink>& links, std::ostream& out);

} // namespace pcl6d::bench
