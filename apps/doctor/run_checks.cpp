// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/checks.h"
#include "doctor/report/run_words.h"
#include "doctor/report/words.h"

#include <pcl6d/io/text.h>

#include <algorithm>
#include <cstddef>

namespace pcl6d::app {

namespace {
/** Common input of the checks of runs. */
struct Runs {
  const DoctorPair& pair;
  const std::vector<Experiment>& rows;
  const std::optional<std::size_t>& best;
};

/** One finding common to several runs: a line for each run. */
class Gathered {
public:
  Gathered(const std::string& what, const std::string& advice)
  {
    finding_.what = what;
    finding_.advice = advice;
  }

  void
  add(Severity severity, const std::string& line)
  {
    finding_.severity =
        is_empty_ ? severity : std::min(finding_.severity, severity); // worst first
    finding_.measured += (is_empty_ ? "" : "\n") + line;
    is_empty_ = false;
  }

  void
  moveTo(Findings& findings)
  {
    if (!is_empty_)
      findings.push_back(finding_);
  }

private:
  Finding finding_;
  bool is_empty_ = true;
};

void
checkEnds(const Runs& runs, Findings& findings)
{
  Gathered bad("classes did not come to an end",
               "the further findings on the clouds; --time-limit for slow classes");
  for (const Experiment& row : runs.rows)
    if (row.outcome.end != RunEnd::kDone)
      bad.add(row.outcome.end == RunEnd::kTimeOut ? Severity::kWarning
                                                  : Severity::kProblem,
              row.name() + ": " + endWords(row.outcome));
  bad.moveTo(findings);
}

void
checkFinite(const Runs& runs, Findings& findings)
{
  Gathered bad("success is reported without a pose",
               "check getFinalTransformation() before use, or use the class of pcl6d, "
               "with hasConverged() false in this case");
  for (const Experiment& row : runs.rows)
    if (row.outcome.end == RunEnd::kDone && row.outcome.converged &&
        !row.outcome.is_rigid)
      bad.add(Severity::kProblem,
              row.name() +
                  ": hasConverged() is true, and the matrix is no rigid motion");
  bad.moveTo(findings);
}

/** Messages of runs that ended normally: easily lost in the output of a program. */
void
checkSaid(const Runs& runs, Findings& findings)
{
  Gathered said("classes only print warnings", "");
  for (const Experiment& row : runs.rows)
    if (row.outcome.end == RunEnd::kDone && !row.outcome.said.empty())
      said.add(row.outcome.converged ? Severity::kWarning : Severity::kNote,
               row.name() + ": \"" + row.outcome.said + "\"; hasConverged() is " +
                   (row.outcome.converged ? "true" : "false"));
  said.moveTo(findings);
}

/** \return the difference between the pose of another run and the pose of a row, in words */
std::string
besideWords(const Runs& runs, const Experiment& row, const ClassOutcome& other)
{
  const auto d = runs.pair.between(row.outcome.pose, other.pose);
  return motionText(d.translation, d.rotation);
}

bool
isElsewhere(const Runs& runs, const ClassOutcome& a, const ClassOutcome& b)
{
  if (a.hasPose() != b.hasPose())
    return true;
  return a.hasPose() && runs.pair.between(a.pose, b.pose).shift > runs.pair.tolerance();
}

void
checkLimit(const Runs& runs, Findings& findings)
{
  Gathered counted("the iteration limit is counted as convergence",
                   "setMaximumIterations() of the longer run; hasConverged() of "
                   "pcl6d's classes is false at the limit");
  for (const Experiment& row : runs.rows) {
    const ClassOutcome& out = row.outcome;
    if (!isPcl(row.method) || !out.hasPose() || !out.converged || !out.at_limit)
      continue;
    std::string line = row.name() + ": hasConverged() is true after " +
                       std::to_string(out.iterations) + " of " +
                       std::to_string(out.limit) + " iterations";
    bool goes_on = false;
    if (row.longer && row.longer->hasPose()) {
      goes_on = isElsewhere(runs, out, *row.longer);
      line += "; with up to " + std::to_string(row.longer->limit) + " it takes " +
              std::to_string(row.longer->iterations) + " and ends " +
              besideWords(runs, row, *row.longer) + " from there";
    }
    else if (row.longer)
      line += "; a longer run: " + briefWords(*row.longer);
    counted.add(goes_on ? Severity::kWarning : Severity::kNote, line);
  }
  counted.moveTo(findings);
}

void
checkEarlyStop(const Runs& runs, Findings& findings)
{
  Gathered early("classes stop before they are at rest",
                 "setTransformationEpsilon() of pcl::NormalDistributionsTransform is "
                 "compared with a squared length: (" +
                     metres(0.1 * runs.pair.tolerance()) +
                     ")^2 there, the length itself for "
                     "pcl::GeneralizedIterativeClosestPoint");
  for (const Experiment& row : runs.rows) {
    const ClassOutcome& out = row.outcome;
    if (out.at_limit || !row.longer || !row.longer->hasPose() ||
        !isElsewhere(runs, out, *row.longer))
      continue;
    early.add(Severity::kWarning,
              row.name() + ": hasConverged() is true after " +
                  text::counted(static_cast<std::size_t>(out.iterations), "iteration") +
                  "; with a small epsilon " + "it takes " +
                  std::to_string(row.longer->iterations) + " and ends " +
                  besideWords(runs, row, *row.longer) + " from there");
  }
  early.moveTo(findings);
}

/** One change of the input. */
struct Change {
  std::optional<ClassOutcome> Experiment::*probe;
  const char* what;   ///< of the finding
  const char* with;   ///< "without the rows of NaN"
  std::string advice; ///< of the finding
};

/** Checks whether a class keeps its result on a better input. */
void
checkChange(const Runs& runs, const Change& change, Findings& findings)
{
  Gathered changed(change.what, change.advice);
  for (const Experiment& row : runs.rows) {
    const auto& probe = row.*change.probe;
    if (!probe || !isElsewhere(runs, row.outcome, *probe))
      continue;
    std::string line = row.name() + ": " + briefWords(row.outcome);
    line += std::string("; ") + change.with + " " + briefWords(*probe);
    if (row.outcome.hasPose() && probe->hasPose())
      line += ", " + besideWords(runs, row, *probe) + " from there";
    const bool is_silent = row.outcome.hasPose() && row.outcome.converged;
    const bool is_lost = !row.outcome.hasPose() && probe->hasPose();
    changed.add(is_silent || is_lost ? Severity::kProblem : Severity::kWarning, line);
  }
  changed.moveTo(findings);
}

void
checkIndices(const Runs& runs, Findings& findings)
{
  Gathered ignored(
      "setIndices() is not honoured",
      "pcl::ExtractIndices, and register the extracted cloud, without indices");
  for (const Experiment& row : runs.rows) {
    // NaN may hide the effect of indices: the three compared runs are without NaN.
    const ClassOutcome& with = row.without_nan ? *row.without_nan : row.outcome;
    if (!row.extracted || !row.whole || !isElsewhere(runs, with, *row.extracted))
      continue;
    const bool is_whole = row.whole->hasPose() && !isElsewhere(runs, with, *row.whole);
    std::string line = row.name() + ": " + briefWords(with);
    if (is_whole)
      line += ", as without indices";
    line += "; with the points extracted " + briefWords(*row.extracted);
    if (with.hasPose() && row.extracted->hasPose()) {
      const auto d = runs.pair.between(with.pose, row.extracted->pose);
      line += ", " + motionText(d.translation, d.rotation) + " from there";
    }
    ignored.add(Severity::kProblem, line);
  }
  ignored.moveTo(findings);
}

/** Checks the results with default settings. */
void
checkDefaults(const Runs& runs, Findings& findings)
{
  Gathered worse("the defaults do not suit these clouds",
                 "the settings in the rows of the table");
  for (std::size_t i = 0; i + 1 < runs.rows.size(); ++i) {
    const Experiment& a = runs.rows[i];
    const Experiment& b = runs.rows[i + 1];
    const bool is_pair = a.method == b.method && a.setting_words == "as it is";
    if (!is_pair || !a.outcome.hasPose() || !b.outcome.hasPose() ||
        !isElsewhere(runs, a.outcome, b.outcome))
      continue;
    const double more = a.verdict.fit.misfit - b.verdict.fit.misfit;
    if (more > 0.1 * b.verdict.fit.misfit)
      worse.add(Severity::kWarning,
                a.name() + ": " + besideWords(runs, a, b.outcome) + " from where " +
                    b.setting_words + " leads; misfit " + metres(a.verdict.fit.misfit) +
                    " instead of " + metres(b.verdict.fit.misfit));
  }
  worse.moveTo(findings);
}

void
checkTrust(const Runs& runs, Findings& findings)
{
  Gathered wrong(
      "success is reported for doubtful poses",
      "do not rely on hasConverged() and fitness: use pcl6d::RegistrationVerifier");
  const bool has_truth = runs.best && runs.rows[*runs.best].verdict.isGood();
  for (const Experiment& row : runs.rows) {
    if (!row.outcome.hasPose() || !row.outcome.converged || row.verdict.isGood())
      continue;
    const bool is_wrong = row.verdict.trust == "wrong";
    const bool is_off =
        has_truth && isElsewhere(runs, row.outcome, runs.rows[*runs.best].outcome);
    if (!is_wrong && !is_off)
      continue;
    std::string line = row.name() + ": hasConverged() is true, fitness " +
                       shortNumber(row.outcome.fitness) + " m^2; " + row.verdict.trust +
                       ": " + row.verdict.reason;
    if (has_truth)
      line += "; " + besideWords(runs, row, runs.rows[*runs.best].outcome) +
              " from the verified pose";
    wrong.add(is_wrong ? Severity::kProblem : Severity::kWarning, line);
  }
  wrong.moveTo(findings);
}
} // namespace

Findings
checkRuns(const DoctorPair& pair,
          const std::vector<Experiment>& experiments,
          const std::optional<std::size_t>& best)
{
  const Runs runs{pair, experiments, best};
  Findings findings;
  checkEnds(runs, findings);
  checkFinite(runs, findings);
  checkTrust(runs, findings);
  checkLimit(runs, findings);
  checkEarlyStop(runs, findings);
  checkChange(runs,
              {&Experiment::without_nan,
               "rows of NaN change the result",
               "without them",
               "pcl::removeNaNFromPointCloud() before align()"},
              findings);
  checkIndices(runs, findings);
  checkChange(runs,
              {&Experiment::local,
               "digits are lost far from 0",
               "moved near 0",
               "take (" + vectorText(pair.target.offset) +
                   ") off in double; T = T(offset) T_local T(-offset)"},
              findings);
  checkChange(runs,
              {&Experiment::own_normals,
               "the normals of the file change the result",
               "with normals estimated from 20 neighbours",
               "compare both rows; normals of the file may come from another filter"},
              findings);
  checkDefaults(runs, findings);
  checkSaid(runs, findings);
  return findings;
}

} // namespace pcl6d::app
