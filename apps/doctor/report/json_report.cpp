// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/report/report.h"
#include "doctor/report/run_words.h"

#include <pcl6d/io/json_numbers.h>

namespace pcl6d::app {

namespace {
using OrderedJson = nlohmann::ordered_json;

OrderedJson
toJson(const DoctorCloud& cloud, const CloudMeasures& of)
{
  OrderedJson json{{"file", cloud.file},
                   {"rows", cloud.rows.size()},
                   {"points", of.points},
                   {"not_finite", of.not_finite + cloud.left_out},
                   {"fields", cloud.fields},
                   {"middle", rowByRow(of.middle)},
                   {"spread", of.spread},
                   {"spacing", of.spacing},
                   {"float_step", of.float_step},
                   {"duplicates", of.duplicates},
                   {"offset", rowByRow(cloud.offset)},
                   {"scanner", rowByRow(of.scanner.place)},
                   {"scanner_known", of.scanner.known}};
  if (of.no_return)
    json["no_return"] = *of.no_return;
  return json;
}

OrderedJson
toJson(const ClassOutcome& out, const DoctorPair& pair)
{
  OrderedJson json{{"end", out.end == RunEnd::kDone ? "done" : endWords(out)},
                   {"converged", out.converged},
                   {"state", out.state},
                   {"at_limit", out.at_limit},
                   {"iterations", out.iterations},
                   {"limit", out.limit},
                   {"fitness", finiteOrNull(out.fitness)},
                   {"seconds", out.seconds},
                   {"output", out.said}};
  json["pose"] =
      out.hasPose() ? rowByRow(pair.toFull(out.pose).matrix()) : OrderedJson(nullptr);
  return json;
}

OrderedJson
toJson(const PoseVerdict& verdict)
{
  return {{"result", verdict.trust},
          {"probability_wrong", verdict.probability_wrong},
          {"patches", verdict.patches},
          {"violated", verdict.contradicted},
          {"reason", verdict.reason},
          {"share", verdict.fit.share},
          {"rms", verdict.fit.misfit}};
}

OrderedJson
toJson(const Experiment& row, const DoctorPair& pair)
{
  OrderedJson json{{"class", toString(row.method)}, {"settings", row.setting_words}};
  json.update(toJson(row.outcome, pair));
  json["verdict"] = toJson(row.verdict);
  const std::pair<const char*, const std::optional<ClassOutcome>&> probes[] = {
      {"longer", row.longer},
      {"local", row.local},
      {"without_nan", row.without_nan},
      {"extracted", row.extracted},
      {"whole", row.whole},
      {"own_normals", row.own_normals}};
  for (const auto& [name, probe] : probes)
    if (probe)
      json[name] = toJson(*probe, pair);
  return json;
}
} // namespace

nlohmann::ordered_json
jsonReport(const Diagnosis& d)
{
  const DoctorPair& pair = d.pair;
  OrderedJson json{{"schema_version", 2},
                   {"verified", d.isVerified()},
                   {"conclusion", conclusionOf(d)}};
  json["source"] = toJson(pair.source, pair.of_source);
  json["target"] = toJson(pair.target, pair.of_target);
  json["initial_pose"] = rowByRow(pair.guess_given.matrix());
  json["max_distance"] = pair.max_distance;
  json["resolution"] = pair.resolution;
  json["distinguishable"] = pair.tolerance();
  json["runs"] = OrderedJson::array();
  for (const Experiment& row : d.rows)
    json["runs"].push_back(toJson(row, pair));
  if (d.best_of_ours)
    json["best_of_ours"] = *d.best_of_ours;
  json["findings"] = OrderedJson::array();
  for (const Finding& f : d.findings)
    json["findings"].push_back({{"severity", toString(f.severity)},
                                {"what", f.what},
                                {"measured", f.measured},
                                {"advice", f.advice}});
  json["advice"] = OrderedJson::array();
  for (const Advice& advice : d.advice)
    json["advice"].push_back({{"what", advice.what}, {"why", advice.why}});
  return json;
}

} // namespace pcl6d::app
