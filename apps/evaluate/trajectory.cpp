// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/command_line.h"
#include "evaluate/trusted_rows.h"
#include "evaluate/verbs.h"

#include <pcl6d/benchmarking/trajectory_error.h>
#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/trajectory_io.h>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <limits>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;
namespace po = boost::program_options;
using Json = nlohmann::ordered_json;

constexpr double kDegrees = 180 / M_PI;

struct TrajectorySettings {
  std::string estimate;
  std::string reference;
  std::string json;    ///< file, "-" for stdout, or empty
  std::string trusted; ///< mcl.csv of `evaluate mcl`, or empty
  PoseMatchingOptions matching;
};

bool
parse(const std::vector<std::string>& arguments, TrajectorySettings& s)
{
  CommandLine line(
      std::string("usage: ") + kEvaluate +
      " trajectory ESTIMATE REFERENCE [options]\n"
      "Position and orientation errors of a trajectory against a reference, first\n"
      "without alignment, then after the rigid motion that fits the positions best.\n"
      "Files: KITTI (12 numbers a row) or TUM (8 numbers a row). Poses are matched by\n"
      "time if both files have stamps (TUM), else by their index. If one file is TUM\n"
      "and all its stamps are whole numbers within the rows of the other, these are\n"
      "indices: so give trajectory.tum of a run of selected scans (--first, "
      "--every).\n");
  line.positional("ESTIMATE", &s.estimate);
  line.positional("REFERENCE", &s.reference);
  double& difference = s.matching.max_time_difference;
  line.group("Evaluation")
      .add_options() //
      ("max-time-difference",
       po::value(&difference)->value_name("S")->default_value(difference, "0.02"),
       "[s] largest between the stamps of a pair") //
      ("trusted",
       po::value(&s.trusted)->value_name("mcl.csv"),
       "leave out the poses of the reference that this table of `mcl` does not trust; "
       "one row per pose of the reference") //
      ("json",
       po::value(&s.json)->value_name("FILE"),
       "write the numbers (angles in radians) to FILE; - prints them instead of the "
       "table");
  if (!line.parse(arguments))
    return false;
  checkOptions([&] { s.matching.validate(); });
  std::error_code missing; // a missing file is no input
  for (const auto& input : {s.estimate, s.reference, s.trusted})
    if (fs::equivalent(s.json, input, missing))
      throw UsageError("--json = " + s.json + ", but that is an input");
  return true;
}

/** Trajectories that do not fit together are bad data, not a wrong command line. */
TrajectoryEvaluation
evaluate(const TrajectorySettings& s,
         const Trajectory& estimate,
         const Trajectory& reference)
try {
  return evaluateTrajectory(estimate, reference, s.matching);
} catch (const pcl::PCLException& e) {
  throw ComputeFailed(s.estimate + " against " + s.reference + ": " + e.what());
}

Json
toJson(const ErrorStatistics& errors, const PoseMatching& matching)
{
  return {{"rms", errors.rms},
          {"mean", errors.mean},
          {"median", errors.median},
          {"max", errors.max},
          {"pose_of_max", matching.pairs[errors.index_of_max].estimate}};
}

/** The share of the path in percent; NaN (null in JSON) if there is no path. */
double
percentOfPath(const TrajectoryErrors& errors, double path_length)
{
  return path_length > 0 ? 100 * errors.position.rms / path_length
                         : std::numeric_limits<double>::quiet_NaN();
}

Json
toJson(const TrajectoryErrors& errors, const TrajectoryEvaluation& evaluation)
{
  const auto& matching = evaluation.matching;
  return {
      {"position", toJson(errors.position, matching)},
      {"orientation", toJson(errors.orientation, matching)},
      {"position_2d", toJson(errors.position_2d, matching)},
      {"yaw", toJson(errors.yaw, matching)},
      {"position_rms_percent_of_path", percentOfPath(errors, evaluation.path_length)}};
}

Json
toJson(const TrajectorySettings& s, const TrajectoryEvaluation& evaluation)
{
  const auto& matching = evaluation.matching;
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> motion =
      evaluation.alignment.transform.matrix();
  Json json = {{"schema_version", 1},
               {"estimate", s.estimate},
               {"reference", s.reference},
               {"matched_by", matching.by_time ? "time" : "index"},
               {"max_time_difference", s.matching.max_time_difference},
               {"pairs", matching.pairs.size()},
               {"unmatched_estimate", matching.unmatched_estimate},
               {"unmatched_reference", matching.unmatched_reference},
               {"untrusted", matching.untrusted},
               {"reference_path_length", evaluation.path_length}};
  json["without_alignment"] = toJson(evaluation.without_alignment, evaluation);
  json["with_alignment"] = toJson(evaluation.with_alignment, evaluation);
  json["alignment"] = {
      {"status", toString(evaluation.alignment.status)},
      {"T_reference_estimate",
       std::vector<double>(motion.data(), motion.data() + motion.size())}};
  return json;
}

void
printRow(const char* what,
         const ErrorStatistics& errors,
         double unit,
         const PoseMatching& matching)
{
  std::printf("  %-18s%12.4f%12.4f%12.4f%12.4f%12zu\n",
              what,
              unit * errors.rms,
              unit * errors.mean,
              unit * errors.median,
              unit * errors.max,
              matching.pairs[errors.index_of_max].estimate);
}

void
printErrors(const std::string& title,
            const TrajectoryErrors& errors,
            const TrajectoryEvaluation& evaluation)
{
  const auto& matching = evaluation.matching;
  std::printf("\n%-20s%12s%12s%12s%12s%12s\n",
              title.c_str(),
              "rms",
              "mean",
              "median",
              "max",
              "max at pose");
  printRow("position [m]", errors.position, 1, matching);
  printRow("orientation [deg]", errors.orientation, kDegrees, matching);
  printRow("2D position [m]", errors.position_2d, 1, matching);
  printRow("yaw [deg]", errors.yaw, kDegrees, matching);
  if (evaluation.path_length > 0)
    std::printf("  position rms is %.2f %% of the path\n",
                percentOfPath(errors, evaluation.path_length));
}

void
printTable(const TrajectorySettings& s, const TrajectoryEvaluation& evaluation)
{
  const auto& matching = evaluation.matching;
  std::printf("%s against %s\n"
              "%zu pairs of poses by %s, path %.2f m",
              s.estimate.c_str(),
              s.reference.c_str(),
              matching.pairs.size(),
              matching.by_time ? "time" : "index",
              evaluation.path_length);
  if (matching.unmatched_estimate + matching.unmatched_reference > 0)
    std::printf("; without partner: %zu of the estimate, %zu of the reference",
                matching.unmatched_estimate,
                matching.unmatched_reference);
  if (matching.untrusted > 0)
    std::printf("; left out, as the reference is not trusted: %zu", matching.untrusted);
  std::printf("\n");
  printErrors("without alignment", evaluation.without_alignment, evaluation);
  printErrors("with alignment", evaluation.with_alignment, evaluation);
  if (evaluation.alignment.status != Status::kOk)
    std::printf("  only shifted: the positions do not determine a rotation (%s)\n",
                toString(evaluation.alignment.status));
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
  if (!s.trusted.empty())
    s.matching.trusted = readTrustedRows(s.trusted);
  const TrajectoryEvaluation evaluation = evaluate(s, estimate, reference);
  // File names need not be UTF-8, but JSON must be.
  const std::string json =
      toJson(s, evaluation).dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
  if (s.json == "-")
    std::fputs(json.c_str(), stdout);
  else
    printTable(s, evaluation);
  if (std::fflush(stdout) != 0)
    throw IoFailed("cannot write to the standard output");
  if (!s.json.empty() && s.json != "-")
    writeFileAtomically(s.json, [&](std::ostream& stream) { stream << json; });
  return kDone;
}

} // namespace pcl6d::app
