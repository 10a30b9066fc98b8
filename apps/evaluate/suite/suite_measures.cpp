// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/suite/suite_report.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/run/run_summary.h>

#include <algorithm>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

double
medianOf(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half]
                                : 0.5 * (values[half - 1] + values[half]);
}

/** \return the agreement of the final poses; empty without a result */
std::optional<double>
agreementOf(const RunResult& summary)
{
  std::optional<double> agreement;
  for (const auto& stage : summary.graph_stages)
    agreement = stage.reverted ? stage.agreement_before : stage.agreement_after;
  return agreement;
}

/** Measures one data set. */
class Measurer {
public:
  Measurer(const Suite& suite, const SuiteFolder& folder, const SuiteData& data)
  : suite_(suite), folder_(folder), data_(data)
  {
    results_.data = data.name;
    const fs::path reference = folder.truthOf(data);
    if (!reference.empty() && fs::exists(reference))
      results_.reference = readTrajectory(reference);
  }

  /** Adds a method with its repetitions. */
  void
  add(const std::vector<const SuiteRun*>& runs)
  {
    SuiteResult result;
    result.row.data = data_.name;
    result.row.method = suite_.methods[runs.front()->method].name;
    if (!runs.front()->record) {
      result.row.verdict = "not run";
      result.row.message = runs.front()->no_data;
      results_.results.push_back(result);
      return;
    }
    addEffort(runs, result.row);
    const RunRecord& record = *runs.front()->record;
    if (record.hasResult())
      addResult(folder_.runOf(data_, suite_.methods[runs.front()->method], 1) /
                    "result",
                result);
    results_.results.push_back(result);
  }

  DataResults
  take()
  {
    return std::move(results_);
  }

private:
  /** Times and memory; the verdict comes from the first run, unless a later verdict is
   * worse. */
  static void
  addEffort(const std::vector<const SuiteRun*>& runs, SuiteRow& row)
  {
    std::vector<double> seconds, cpu_seconds;
    double memory = 0;
    for (const SuiteRun* run : runs) {
      const RunRecord& record = *run->record;
      seconds.push_back(record.end.seconds);
      cpu_seconds.push_back(record.end.cpu_seconds);
      memory = std::max(memory, record.end.peak_memory_mb);
      if (row.verdict.empty() || !record.hasResult()) {
        row.verdict = record.verdict();
        row.message = record.message;
      }
    }
    row.runs = static_cast<int>(runs.size());
    row.seconds = medianOf(seconds);
    row.cpu_seconds = medianOf(cpu_seconds);
    row.peak_memory_mb = memory;
  }

  void
  addResult(const fs::path& folder, SuiteResult& result)
  try {
    const RunResult summary = readRunSummary(folder / "summary.json");
    result.estimate = readTrajectory(folder / "trajectory.tum");
    result.row.agreement = agreementOf(summary);
    addOdometry(summary, result.estimate.stamps);
    addErrors(result);
  } catch (const pcl::PCLException& e) {
    result.row.message = e.what();
  }

  void
  addErrors(SuiteResult& result) const
  {
    const Trajectory& reference = results_.reference;
    if (reference.poses.empty())
      return;
    SuiteRow& row = result.row;
    row.errors = evaluateTrajectory(result.estimate, reference);
    const auto& pairs = row.errors->matching.pairs;
    row.steps = stepErrors(result.estimate, reference, pairs);
    row.drift = driftErrors(result.estimate, reference, pairs);
  }

  /** Initial poses are common to every method: they come from the first result. */
  void
  addOdometry(const RunResult& summary, const std::vector<double>& stamps)
  {
    if (has_odometry_)
      return;
    SuiteResult odometry;
    odometry.row.data = data_.name;
    odometry.row.method = "odometry";
    for (const auto& scan : summary.scans)
      odometry.estimate.poses.push_back(scan.initial_pose);
    odometry.estimate.stamps = stamps;
    addErrors(odometry);
    results_.results.insert(results_.results.begin(), odometry);
    has_odometry_ = true;
  }

  const Suite& suite_;
  const SuiteFolder& folder_;
  const SuiteData& data_;
  DataResults results_;
  bool has_odometry_ = false;
};
} // namespace

std::vector<DataResults>
measureSuite(const Suite& suite,
             const SuiteFolder& folder,
             const std::vector<SuiteRun>& runs)
{
  std::vector<DataResults> all;
  for (std::size_t d = 0; d < suite.data.size(); ++d) {
    Measurer measurer(suite, folder, suite.data[d]);
    bool any = false;
    for (std::size_t m = 0; m < suite.methods.size(); ++m) {
      std::vector<const SuiteRun*> repetitions;
      for (const SuiteRun& run : runs)
        if (run.data == d && run.method == m)
          repetitions.push_back(&run);
      if (repetitions.empty())
        continue;
      measurer.add(repetitions);
      any = true;
    }
    if (any)
      all.push_back(measurer.take());
  }
  return all;
}

std::vector<SuiteRow>
rowsOf(const std::vector<DataResults>& results)
{
  std::vector<SuiteRow> rows;
  for (const DataResults& data : results)
    for (const SuiteResult& result : data.results)
      rows.push_back(result.row);
  return rows;
}

} // namespace pcl6d::app
