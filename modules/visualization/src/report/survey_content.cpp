// SPDX-License-Identifier: BSD-3-Clause
#include "report/survey_rows.h"

#include <pcl6d/io/text.h>
#include <pcl6d/run/control_table.h>
#include <pcl6d/run/run_links_io.h>
#include <pcl6d/visualization/survey_report.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace pcl6d {
using namespace visualization;

namespace {
namespace fs = std::filesystem;

/** Entries of the header of every report, with their titles. */
const std::pair<const char*, const char*> kHeader[] = {{"project", "Project"},
                                                       {"client", "Client"},
                                                       {"operator", "Operator"},
                                                       {"instrument", "Instrument"},
                                                       {"date", "Date of survey"}};
constexpr const char* kCoordinateSystem = "coordinate-system";
constexpr const char* kEpsgOption = "epsg";

/** \return EPSG code of the run, else the name of the frame of the coordinates */
std::string
coordinateSystemOf(const RunResult& run)
{
  for (const RunResult::Option& option : run.options)
    if (option.name == kEpsgOption && option.value != "0")
      return "EPSG:" + option.value;
  return run.control && run.control->adjusted ? "frame of the control points"
                                              : "frame of the initial poses (local)";
}

std::vector<std::pair<std::string, std::string>>
headerOf(const RunResult& run, const SurveyOptions& options)
{
  std::map<std::string, std::string> given(options.project.begin(),
                                           options.project.end());
  std::vector<std::pair<std::string, std::string>> header;
  const auto take = [&](const std::string& key, const std::string& otherwise) {
    const auto found = given.find(key);
    const std::string value = found == given.end() ? otherwise : found->second;
    given.erase(key);
    return value;
  };
  for (const auto& [key, name] : kHeader)
    header.emplace_back(name, take(key, "-"));
  header.emplace_back("Coordinate system",
                      take(kCoordinateSystem, coordinateSystemOf(run)));
  for (const auto& [key, value] : options.project) // in their order
    if (given.count(key) > 0)
      header.emplace_back(key, value);
  header.emplace_back("Software", run.generator + ' ' + run.version);
  header.emplace_back("Initial poses", run.pose_source);
  return header;
}

/** \return [m] rms of the point-pair distances over the used links; NaN without links */
double
bundleError(const RunResult& run)
{
  double sum = 0, pairs = 0;
  for (const RunLink& link : run.links)
    if (link.verdict == LinkVerdict::kUsed && std::isfinite(link.rms)) {
      sum += static_cast<double>(link.pairs) * link.rms * link.rms;
      pairs += static_cast<double>(link.pairs);
    }
  return std::sqrt(sum / pairs);
}

/** \return [m] the largest 95 % bound of the stations; NaN: a bound is unknown */
double
largestBound(const RunResult& run)
{
  double largest = 0;
  for (std::size_t i = 0; i < run.scans.size(); ++i)
    largest = std::max(
        largest,
        boundOfStation(run, i).value_or(std::numeric_limits<double>::infinity()));
  return largest;
}

/** One row of the requirements. */
class Requirements {
public:
  explicit Requirements(std::optional<double> tolerance) : tolerance_(tolerance)
  {
    table.name = "requirements";
    table.title = "Requirements";
    table.note = tolerance ? "Tolerance " + millimetresOf(*tolerance) + " mm."
                           : "No tolerance was given.";
    table.columns = {"quantity", "value [mm]", "limit [mm]", "result"};
  }

  void
  add(const std::string& name, double value, bool is_tested = true)
  {
    const bool is_limited = tolerance_ && is_tested;
    const bool is_met = is_limited && value <= *tolerance_; // false of NaN
    has_failed = has_failed || (is_limited && !is_met);
    using Mark = SurveyCell::Mark;
    table.rows.push_back({{name},
                          {millimetresOf(value)},
                          {is_limited ? millimetresOf(*tolerance_) : "-"},
                          {!is_limited ? "-" : (is_met ? "pass" : "fail"),
                           !is_limited ? Mark::kPlain
                           : is_met    ? Mark::kPass
                                       : Mark::kFail}});
  }

  SurveyTable table;
  bool has_failed = false;

private:
  std::optional<double> tolerance_;
};

Requirements
requirementsOf(const RunResult& run, const SurveyOptions& options)
{
  Requirements all(options.tolerance);
  all.add(
      "bundle error (rms of the cloud-to-cloud distances)", bundleError(run), false);
  if (run.control && run.control->adjusted) {
    const ControlResult& control = *run.control;
    if (const auto rms = control.rms(ControlUse::kControl))
      all.add("control points, rms of residuals", *rms);
    if (const auto rms = control.rms(ControlUse::kCheck))
      all.add("check points, rms of residuals", *rms);
    if (const auto largest = control.largest(ControlUse::kCheck))
      all.add("check points, largest residual", *largest);
  }
  all.add(run.control && run.control->adjusted
              ? "station positions in the control frame, largest bound (95 %)"
              : "station positions relative to the first, largest bound (95 %)",
          largestBound(run));
  return all;
}

/** The verdict in the words of the trade. */
void
assess(const RunResult& run, bool has_failed, SurveyReport& report)
{
  const auto add = [&](SurveyVerdict verdict, const std::string& reason) {
    report.verdict = std::max(report.verdict, verdict);
    report.reasons.push_back(reason);
  };
  report.verdict = SurveyVerdict::kAccepted;
  if (!run.complete)
    add(SurveyVerdict::kRejected, "The run was interrupted.");
  if (run.control && !run.control->adjusted)
    add(SurveyVerdict::kRejected,
        "The map was not adjusted to the control points: " + run.control->reason + '.');
  else if (run.control && !run.control->doubt.empty())
    add(SurveyVerdict::kRejected, "Control: " + run.control->doubt + '.');
  if (!run.verification)
    add(SurveyVerdict::kConditional, "The registration was not verified.");
  else
    for (const std::string& doubt : wordsOfEach(run.verification->doubts))
      add(run.verification->trusted() ? SurveyVerdict::kConditional
                                      : SurveyVerdict::kRejected,
          "Verification: " + doubt + '.');
  if (!run.trusted && report.verdict != SurveyVerdict::kRejected)
    add(SurveyVerdict::kRejected, "Part of the stations is not registered reliably.");
  if (has_failed)
    add(SurveyVerdict::kRejected, "A requirement is not met.");
  if (run.control)
    for (const std::string& name : run.control->rejected())
      add(SurveyVerdict::kConditional,
          "Control point " + name +
              " has a gross error in its coordinates or in a target, and was taken out "
              "of "
              "the adjustment.");
  if (report.reasons.empty())
    report.reasons.emplace_back("All stations are connected by consistent links, and "
                                "nothing contradicts the map.");
}

void
fillOverlaps(const RunResult& run, SurveyReport& report)
{
  const std::map<int, std::size_t> places = placesByIndex(run);
  const std::size_t count = run.scans.size();
  report.overlaps.assign(
      count, std::vector<double>(count, std::numeric_limits<double>::quiet_NaN()));
  for (const RunLink& link : run.links) {
    const auto a = places.find(static_cast<int>(link.from));
    const auto b = places.find(static_cast<int>(link.to));
    if (a == places.end() || b == places.end() || !link.counts())
      continue;
    report.overlaps[a->second][b->second] = report.overlaps[b->second][a->second] =
        link.overlap;
    if (link.verdict == LinkVerdict::kUsed && std::isfinite(link.rms))
      report.link_errors.push_back(link.rms);
  }
}
} // namespace

SurveyReport
surveyOf(const RunFolder& folder, const SurveyOptions& options)
{
  options.validate();
  RunResult run = folder.summary();
  run.links = folder.readLinks();
  std::vector<LinkCheck> checks;
  if (folder.has("verification.csv"))
    checks = readLinkChecks(folder.path() / "verification.csv");
  SurveyReport report;
  std::error_code error;
  report.title = fs::canonical(folder.path(), error).filename().string();
  for (const auto& [key, value] : options.project)
    if (key == "project")
      report.title = value;
  report.header = headerOf(run, options);
  for (const ScanResult& scan : run.scans)
    report.stations.push_back(stationName(scan));
  const Requirements requirements = requirementsOf(run, options);
  assess(run, requirements.has_failed, report);
  report.tables = {requirements.table};
  if (run.control && !run.control->residuals.empty())
    report.tables.push_back(controlTable(run));
  report.tables.push_back(stationTable(run));
  if (!run.links.empty())
    report.tables.push_back(linkTable(run, checks));
  fillOverlaps(run, report);
  if (folder.has("top_view.png"))
    report.top_view = text::readFile(folder.path() / "top_view.png");
  return report;
}

} // namespace pcl6d
