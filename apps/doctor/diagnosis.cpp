// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/checks.h"
#include "doctor/diagnosis.h"

#include <pcl6d/io/text.h>

#include <algorithm>
#include <iterator>

namespace pcl6d::app {

namespace {
void
verifyAll(const DoctorSettings& s, const Interrupt& interrupt, Diagnosis& d)
{
  evaluate(d.pair, s.time_limit, d.rows, interrupt);
  d.best = bestOf(d.pair, d.rows, false);
  d.best_of_ours = bestOf(d.pair, d.rows, true);
}

void
append(const Findings& more, Findings& findings)
{
  findings.insert(findings.end(), more.begin(), more.end());
}
} // namespace

Diagnosis
diagnose(const DoctorSettings& s, ProgressBar& bar, const Interrupt& interrupt)
{
  Diagnosis d;
  d.pair = loadPair(s);
  bar.say(text::counted(d.pair.of_source.points, "point") + " on " +
          std::to_string(d.pair.of_target.points));
  d.rows = runExperiments(d.pair, s.time_limit, bar, interrupt);
  verifyAll(s, interrupt, d);
  if (!d.isVerified() && d.pair.canBeMatched()) {
    const auto more = runCoarseStarts(d.pair, s.time_limit, bar, interrupt);
    std::copy(more.begin(), more.end(), std::back_inserter(d.rows));
    verifyAll(s, interrupt, d);
  }
  append(checkClouds(d.pair), d.findings);
  append(checkStart(d.pair), d.findings);
  append(checkRuns(d.pair, d.rows, d.best), d.findings);
  std::stable_sort(
      d.findings.begin(), d.findings.end(), [](const Finding& a, const Finding& b) {
        return a.severity < b.severity;
      });
  d.advice = adviceFor(d);
  return d;
}

std::string
conclusionOf(const Diagnosis& d)
{
  if (!d.pair.canBeMatched())
    return "registration is impossible: a cloud has fewer than 3 valid points";
  if (!d.best_of_ours)
    return "no class of pcl6d found a pose";
  const Experiment& ours = d.rows[*d.best_of_ours];
  const std::string by = std::string(toString(ours.method)) + ", " + ours.setting_words;
  const PoseVerdict& verdict = ours.verdict;
  if (verdict.isGood())
    return "verified: points and rays of both clouds confirm the pose of " + by;
  const std::string why = verdict.reason.empty() ? "" : ": " + verdict.reason;
  if (verdict.trust.empty())
    return "not verified" + why;
  return "not to be trusted: the pose of " + by + " is " + verdict.trust + why;
}

} // namespace pcl6d::app
