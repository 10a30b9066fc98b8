// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/suite/map_truth.h"
#include "evaluate/suite/suite_report.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/run/run_summary.h>

#include <algorithm>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

TrustCall
callOf(const RunRecord& record, const RunResult& run)
{
  if (!record.hasResult())
    return TrustCall::kNone;
  if (record.end.exit_code != 0)
    return TrustCall::kDoubted;
  return run.verification && run.verification->trust == MapTrust::kGood
             ? TrustCall::kGood
             : TrustCall::kUnverified;
}

/** \return the lines of a verdict that doubt the map, joined */
std::string
doubtsIn(const std::string& verdict)
{
  std::string text;
  for (std::size_t begin = 0; begin < verdict.size();) {
    const std::size_t end = std::min(verdict.find('\n', begin), verdict.size());
    const std::string line = verdict.substr(begin, end - begin);
    if (line.rfind("NOT TO BE TRUSTED: ", 0) == 0)
      text += (text.empty() ? "" : "; ") + line.substr(line.find(' ', 14) + 1);
    begin = end + 1;
  }
  return text;
}

TrustRun
evaluateRun(const Suite& suite, const SuiteFolder& folder, const SuiteRun& run)
{
  const SuiteData& data = suite.data[run.data];
  const SuiteMethod& method = suite.methods[run.method];
  const fs::path place = folder.runOf(data, method, run.repetition);
  TrustRun evaluated;
  evaluated.data = data.entry;
  evaluated.damage = data.damage.name;
  evaluated.method = method.name;
  evaluated.name = place.lexically_relative(folder.folder).string();
  evaluated.message = run.no_data;
  if (!run.record)
    return evaluated;
  evaluated.message = run.record->hasResult() ? "" : run.record->verdict();
  if (!run.record->message.empty())
    evaluated.message += ": " + run.record->message;
  if (!run.record->hasResult())
    return evaluated;
  const RunResult summary = readRunSummary(place / "result" / "summary.json");
  evaluated.call = callOf(*run.record, summary);
  evaluated.doubted_by_matching = evaluated.call == TrustCall::kDoubted &&
                                  summary.verification &&
                                  summary.verification->trusted();
  evaluated.message = doubtsIn(summary.verdict);
  const fs::path truth = folder.truthOf(data);
  if (!truth.empty() && fs::exists(truth))
    evaluated.scans = compareWithTruth(
        summary, namedScans(summary), readTrajectory(truth).poses, data.damage.foreign);
  return evaluated;
}
} // namespace

std::vector<TrustRun>
evaluateSuite(const Suite& suite,
              const SuiteFolder& folder,
              const std::vector<SuiteRun>& runs)
{
  std::vector<TrustRun> evaluated;
  for (const SuiteRun& run : runs) {
    try {
      evaluated.push_back(evaluateRun(suite, folder, run));
    } catch (const pcl::PCLException& error) {
      TrustRun broken;
      broken.data = suite.data[run.data].entry;
      broken.damage = suite.data[run.data].damage.name;
      broken.method = suite.methods[run.method].name;
      broken.message = error.what();
      evaluated.push_back(broken);
    }
  }
  return evaluated;
}

} // namespace pcl6d::app
