// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/result_json.h"
#include "evaluate/trajectory/trajectory_report.h"

#include <pcl6d/io/json_numbers.h>

#include <limits>
#include <ostream>

namespace pcl6d::app {

namespace {
Json
toJson(const ErrorStatistics& errors, const PoseMatching& matching)
{
  Json json = statisticsJson(errors);
  json["pose_of_max"] = matching.pairs[errors.index_of_max].estimate;
  return json;
}

/** The share of the path in percent; NaN (null in JSON) without a path. */
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

/** pose_of_max: where the motion ends. */
Json
toJson(const RelativeErrors& errors, const PoseMatching& matching)
{
  Json json = {{"count", errors.motions.size()}};
  if (errors.motions.empty())
    return json;
  const auto withEnd = [&](const ErrorStatistics& kind) {
    Json one = statisticsJson(kind);
    one["pose_of_max"] = matching.pairs[errors.motions[kind.index_of_max].to].estimate;
    return one;
  };
  json["translation"] = withEnd(errors.translation);
  json["rotation"] = withEnd(errors.rotation);
  return json;
}

Json
toJson(const DriftErrors& drift, const PoseMatching& matching)
{
  Json lengths = Json::array();
  for (const auto& one : drift.lengths) {
    Json json = {{"length", one.length}};
    json.update(toJson(one.errors, matching));
    if (!one.errors.motions.empty()) {
      json["translation_per_metre"] = one.translation_per_metre;
      json["rotation_per_metre"] = one.rotation_per_metre;
    }
    lengths.push_back(std::move(json));
  }
  Json json = {{"stretches", drift.stretches},
               {"translation_per_metre", nullptr},
               {"rotation_per_metre", nullptr},
               {"end_translation", drift.end.translation},
               {"end_rotation", drift.end.rotation},
               {"path", drift.path}};
  if (drift.stretches > 0) {
    json["translation_per_metre"] = drift.translation_per_metre;
    json["rotation_per_metre"] = drift.rotation_per_metre;
  }
  json["lengths"] = std::move(lengths);
  return json;
}

Json
loopsToJson(const TrajectoryEvaluation& evaluation)
{
  const auto& matching = evaluation.matching;
  Json json = toJson(evaluation.loops, matching);
  Json loops = Json::array();
  for (const auto& loop : evaluation.loops.motions)
    loops.push_back({{"from", matching.pairs[loop.from].estimate},
                     {"to", matching.pairs[loop.to].estimate},
                     {"path", loop.path},
                     {"translation", loop.translation},
                     {"rotation", loop.rotation}});
  json["loops"] = std::move(loops);
  return json;
}
} // namespace

std::string
toJson(const TrajectoryReport& report)
{
  const TrajectoryEvaluation& evaluation = report.evaluation;
  const auto& matching = evaluation.matching;
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> motion =
      evaluation.alignment.transform.matrix();
  Json json = {{"schema_version", 1},
               {"estimate", report.estimate},
               {"reference", report.reference},
               {"matched_by", matching.by_time ? "time" : "index"},
               {"max_time_difference", report.options.matching.max_time_difference},
               {"interpolated", report.options.interpolation_gap.has_value()},
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
  json["steps"] = toJson(evaluation.steps, matching);
  json["drift"] = toJson(evaluation.drift, matching);
  json["loop_closure"] = loopsToJson(evaluation);
  json["length_ratios"] = statisticsJson(evaluation.length_ratios.ratio);
  json["length_ratios"]["count"] = evaluation.length_ratios.ratio.count;
  json["length_ratios"]["scale"] = evaluation.length_ratios.scale;
  // File names need not be UTF-8, but JSON must be.
  return jsonFileText(json, 2);
}

void
writeCsv(std::ostream& stream, const TrajectoryReport& report)
{
  const TrajectoryEvaluation& evaluation = report.evaluation;
  stream.precision(17);
  stream << "estimate,reference,position,orientation,position_2d,yaw,"
            "aligned_position,aligned_orientation,step_translation,step_rotation\n";
  for (std::size_t row = 0; row < evaluation.matching.pairs.size(); ++row) {
    const PosePair& pair = evaluation.matching.pairs[row];
    const PoseError& error = evaluation.without_alignment.poses[row];
    const PoseError& aligned = evaluation.with_alignment.poses[row];
    stream << pair.estimate << ',' << pair.reference << ',' << error.position << ','
           << error.orientation << ',' << error.position_2d << ',' << error.yaw << ','
           << aligned.position << ',' << aligned.orientation << ',';
    if (row > 0)
      stream << evaluation.steps.motions[row - 1].translation << ','
             << evaluation.steps.motions[row - 1].rotation << '\n';
    else
      stream << ",\n";
  }
}

} // namespace pcl6d::app
