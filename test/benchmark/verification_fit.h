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
  std::string kind; ///< of TestedLink
  double off = 0;   ///< [m]
  double turn = 0;  ///< [rad]
  LinkEvidence evidence;
  LinkTrust trust = LinkTrust::kWeak;
};

/** \brief A table by set: right links good, weak and wrong; other places (minima, folds,
 * scans apart) called good; shifts and turns by more than 5 cm and three stated deviations
 * called good. */
void
printVerdicts(const std::vector<EvaluatedLink>& links, std::ostream& out);

/** \brief Fits the constants of contradictions (calibration.h) anew for each set from all
 * others, and judges the set by them: a table of the constants and of its links. Beside it
 * what overlap and rms would call good, with the limit that doubts 3 % of the right links of
 * the others. */
void
printLeaveOneOut(const std::vector<EvaluatedLink>& links, std::ostream& out);

} // namespace pcl6d::bench
