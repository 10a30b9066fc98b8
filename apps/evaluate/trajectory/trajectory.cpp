// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "common/progress_bar.h"
#include "evaluate/result_file.h"
#include "evaluate/trajectory/trajectory_report.h"
#include "evaluate/trusted_rows.h"
#include "evaluate/verbs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/link_list_io.h>
#include <pcl6d/io/text.h>
#include <pcl6d/io/trajectory_io.h>

#include <cmath>
#include <cstdio>

namespace pcl6d::app {

namespace {
struct TrajectorySettings {
  std::string estimate;
  std::string reference;
  std::string json;    ///< file, "-" for stdout, or empty
  std::string output;  ///< .json or .csv, or empty
  std::string loops;   ///< file, or empty
  std::string trusted; ///< mcl.csv of `evaluate mcl`, or empty
  TrajectoryEvaluationOptions options;
};

constexpr const char* kTrajectoryUsage =
    R"( trajectory ESTIMATE REFERENCE [options]
Position and orientation errors of a trajectory against a reference, first
without alignment, then after the rigid motion that fits the positions best (ATE);
errors of the motions per step and per distance (RPE), drift, errors across loops
and of length ratios.
Files: KITTI (12 numbers a row) or TUM (8 numbers a row). Poses are matched by
time if both files have stamps (TUM), else by index. If one file is TUM with
whole numbers within the rows of the second file as stamps, the stamps are indices:
use trajectory.tum for a run of selected scans (--first, --every).
)";

void
addOptions(OptionTable& table, TrajectorySettings& s)
{
  RevisitOptions& revisits = s.options.revisits;
  table.positional("ESTIMATE", &s.estimate);
  table.positional("REFERENCE", &s.reference);
  table.group("Evaluation");
  table.add("max-time-difference S", &s.options.matching.max_time_difference)
      .help("[s] largest between the stamps of a pair");
  table.add("interpolate S", &s.options.interpolation_gap)
      .above(0, "> 0")
      .help("compare with the reference at the stamps of the estimate, interpolated "
            "between poses at most [s] apart; both need stamps");
  table.add("lengths M ...", &s.options.lengths)
      .multitoken()
      .help("[m] of the stretches of drift; default: 100 200 ... 800, or a round part "
            "where the path is shorter");
  table.add("loop-radius M", &revisits.radius)
      .help("[m] largest distance between the two ends of a loop in the reference");
  table.add("loop-path M", &revisits.min_path)
      .help("[m] shortest way between the ends");
  table.add("loops FILE", &s.loops)
      .help("loops in place of the found loops: lines `a b` with the indices of two "
            "poses of the reference, or a .g2o file");
  table.add("trusted mcl.csv", &s.trusted)
      .help("leave out the poses of the reference marked as doubtful in FILE, a table "
            "of `mcl`; a row per pose of the reference");
  table.add("output,o FILE", &s.output)
      .help("write every number (.json) or a row per pose (.csv), angles in radians");
  table.add("json FILE", &s.json)
      .help("write every number as JSON to FILE; - prints JSON instead of the table");
}

bool
parse(const std::vector<std::string>& arguments, TrajectorySettings& s)
{
  OptionTable table(std::string("usage: ") + kEvaluate + kTrajectoryUsage);
  addOptions(table, s);
  if (!table.parse(arguments))
    return false;
  for (const char* const option : {"loops", "trusted"})
    if (table.given("interpolate") && table.given(option))
      throw UsageError(std::string("--") + option +
                       " names poses of the reference, but --interpolate replaces "
                       "these poses: give either option");
  table.check(
      [&] {
        s.options.matching.validate();
        s.options.revisits.validate();
        for (const double length : s.options.lengths)
          require(
              std::isfinite(length) && length > 0, "lengths", length, "finite and > 0");
      },
      {{"radius", "loop-radius"}, {"min_path", "loop-path"}});
  requireResultFile("--output", s.output, {".json", ".csv"});
  const std::vector<std::string> inputs{s.estimate, s.reference, s.loops, s.trusted};
  refuseInputs(s.json, inputs, "an input", "--json");
  refuseInputs(s.output, inputs);
  if (s.json != "-")
    refuseSameOutput("--json", s.json, "--output", s.output);
  return true;
}

/** Trajectories that do not match are bad data, not a wrong command line. */
TrajectoryEvaluation
evaluate(const TrajectorySettings& s,
         const Trajectory& estimate,
         const Trajectory& reference)
try {
  return evaluateTrajectory(estimate, reference, s.options);
} catch (const pcl::PCLException& e) {
  throw ComputeFailed(s.estimate + " against " + s.reference + ": " + e.what());
}

void
write(const TrajectorySettings& s, const TrajectoryReport& report)
{
  if (s.json == "-")
    std::fputs(toJson(report).c_str(), stdout);
  else
    printTable(report);
  flushOutput();
  const auto writeJson = [&](std::ostream& stream) { stream << toJson(report); };
  if (!s.json.empty() && s.json != "-")
    writeFileAtomically(s.json, writeJson);
  if (hasExtension(s.output, ".csv"))
    writeFileAtomically(s.output,
                        [&](std::ostream& stream) { writeCsv(stream, report); });
  else if (!s.output.empty())
    writeFileAtomically(s.output, writeJson);
}
} // namespace

int
runTrajectory(const std::vector<std::string>& arguments)
{
  TrajectorySettings s;
  if (!parse(arguments, s))
    return kDone;
  const Trajectory estimate = readTrajectory(s.estimate);
  const Trajectory reference = readTrajectory(s.reference);
  if (!s.loops.empty())
    s.options.loops = readLinkList(s.loops);
  if (!s.trusted.empty())
    s.options.matching.trusted = readTrustedRows(s.trusted);
  TrajectoryReport report{s.estimate, s.reference, s.options, {}};
  report.evaluation = evaluate(s, estimate, reference);
  write(s, report);
  const TrajectoryEvaluation& found = report.evaluation;
  if (found.alignment.status == Status::kTooFewPairs)
    ProgressBar(false).warn("only " +
                            text::counted(found.matching.pairs.size(), "pair") +
                            " of poses: errors after alignment are meaningless");
  return kDone;
}

} // namespace pcl6d::app
