// SPDX-License-Identifier: BSD-3-Clause
#include "common/open_scans.h"
#include "evaluate/icp/icp_report.h"
#include "evaluate/result_json.h"
#include "evaluate/verbs.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/error.h>
#include <pcl6d/common/version.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/visualization/convergence_map.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iomanip>
#include <sstream>

namespace pcl6d::app {

namespace {

std::vector<std::pair<const char*, Parameter>>
named(const Slam6DParameters& p)
{
  return {{"min-range", p.min_range},
          {"max-range", p.max_range},
          {"voxel", p.voxel},
          {"max-distance", p.max_distance},
          {"max-distance-start", p.max_distance_start}};
}

std::string
fixed(double value, int decimals)
{
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string
orDash(const std::optional<double>& value, double unit, int decimals)
{
  return value ? fixed(unit * *value, decimals) : "-";
}

std::string
axisText(double offset, const char* unit, int steps)
{
  if (steps == 1)
    return " 0";
  std::ostringstream text;
  text << std::setprecision(3) << " to +-" << offset << ' ' << unit << " in " << steps
       << " steps";
  return text.str();
}

void
printHeader(const IcpSettings& settings, const IcpEvaluation& e)
{
  std::printf("%s onto %s: %zu onto %zu reduced points\n",
              settings.scan_b.c_str(),
              settings.scan_a.c_str(),
              e.points_b,
              e.points_a);
  for (const auto& [name, parameter] : named(e.parameters))
    std::printf("%s\n", parameterLine(name, parameter).c_str());
  const IcpBasinOptions& o = e.options;
  std::printf("start from %s; %zu %s each: x, y%s, yaw%s\n",
              e.pose_source.c_str(),
              icpStarts(o).size(),
              icpStarts(o).size() == 1 ? "run" : "runs",
              axisText(o.offset_xy, "m", o.steps_xy).c_str(),
              axisText(degrees(o.offset_yaw), "deg", o.steps_yaw).c_str());
  for (const IcpBestPose& best : e.basin.best)
    if (best.doubt.empty()) {
      const Eigen::Vector3d t = best.result.T_target_source.translation();
      std::printf("best pose of %s: (%.4f, %.4f, %.4f) m, rms %.4f m, overlap %.3f; "
                  "sigma %.4f m, %.3f deg\n",
                  toString(best.metric),
                  t.x(),
                  t.y(),
                  t.z(),
                  best.result.rms,
                  best.result.overlap,
                  best.sigma_position,
                  degrees(best.sigma_orientation));
      if (o.icp.estimate_scale)
        std::printf("scale of %s: %.6f\n", settings.scan_b.c_str(), best.result.scale);
    }
}

void
printRow(const IcpBasinRow& row)
{
  const IcpBasinSummary& s = row.summary;
  const auto mean = [&s](double value, int decimals) {
    return s.correct > 0 ? fixed(value, decimals) : std::string("-");
  };
  std::printf("%-7s%-18s%-12s%9.1f%11s%12s%9s%12s%9s%9s%11s\n",
              toString(row.variant.metric),
              row.variant.minimiser.c_str(),
              toString(row.variant.search),
              100 * s.success,
              mean(1000 * s.position_rms, 3).c_str(),
              mean(degrees(s.orientation_rms), 4).c_str(),
              mean(s.rms, 5).c_str(),
              mean(s.iterations, 3).c_str(),
              mean(1000 * s.seconds, 2).c_str(),
              orDash(s.reach_xy, 1, 2).c_str(),
              orDash(s.reach_yaw, degrees(1), 1).c_str());
}

/** Numbers with full precision; an empty field for a missing value. */
class CsvLine {
public:
  explicit CsvLine(std::ostream& stream) : stream_(stream) { stream_.precision(17); }
  ~CsvLine() { stream_ << '\n'; }
  CsvLine(const CsvLine&) = delete;
  CsvLine&
  operator=(const CsvLine&) = delete;

  template <typename T>
  CsvLine&
  operator<<(const T& value)
  {
    stream_ << separator_ << value;
    separator_ = ",";
    return *this;
  }
  CsvLine&
  operator<<(const std::optional<double>& value)
  {
    return value ? *this << *value : *this << "";
  }

private:
  std::ostream& stream_;
  const char* separator_ = "";
};

void
writeRows(std::ostream& stream, const IcpBasin& basin)
{
  stream << "metric,minimiser,search,runs,correct,success,position_error_rms,"
            "orientation_error_rms,pair_rms,iterations,seconds,reach_xy,reach_yaw\n";
  for (const IcpBasinRow& row : basin.rows) {
    const IcpBasinSummary& s = row.summary;
    const auto mean = [&s](double value) {
      return s.correct > 0 ? std::optional<double>(value) : std::nullopt;
    };
    CsvLine(stream) << toString(row.variant.metric) << row.variant.minimiser
                    << toString(row.variant.search) << s.runs << s.correct << s.success
                    << mean(s.position_rms) << mean(s.orientation_rms) << mean(s.rms)
                    << mean(s.iterations) << mean(s.seconds) << s.reach_xy
                    << s.reach_yaw;
  }
}

void
writeRuns(std::ostream& stream, const IcpBasin& basin)
{
  stream << "metric,minimiser,search,x,y,yaw,correct,position_error,orientation_error,"
            "pairs,pair_rms,iterations,stop,seconds,scale\n";
  for (const IcpBasinRow& row : basin.rows)
    for (const IcpBasinRun& run : row.runs)
      CsvLine(stream) << toString(row.variant.metric) << row.variant.minimiser
                      << toString(row.variant.search) << run.start.x << run.start.y
                      << run.start.yaw << run.correct << run.position_error
                      << run.orientation_error << run.pairs << run.rms << run.iterations
                      << toString(run.stop) << run.seconds << run.scale;
}

Json
toJson(const IcpBestPose& best)
{
  return {{"metric", toString(best.metric)},
          {"reliable", best.doubt.empty()},
          {"doubt", best.doubt},
          {"T_a_b", rowByRow(best.result.T_target_source.matrix())},
          {"scale", best.result.scale},
          {"status", toString(best.result.status)},
          {"iterations", best.result.iterations},
          {"pairs", best.result.pairs},
          {"rms", best.result.rms},
          {"overlap", best.result.overlap},
          {"sigma_position", best.sigma_position},
          {"sigma_orientation", best.sigma_orientation}};
}

Json
toJson(const IcpSettings& settings, const IcpEvaluation& e)
{
  const IcpBasinOptions& o = e.options;
  Json json = {
      {"schema_version", 2},
      {"generator", kEvaluate},
      {"version", PCL6D_VERSION},
      {"complete", e.basin.complete},
      {"scan_a", settings.scan_a},
      {"scan_b", settings.scan_b},
      {"points_a", e.points_a},
      {"points_b", e.points_b},
      {"start", {{"source", e.pose_source}, {"T_a_b", rowByRow(e.guess.matrix())}}},
      {"x", gridValues(o.offset_xy, o.steps_xy)},
      {"y", gridValues(o.offset_xy, o.steps_xy)},
      {"yaw", gridValues(o.offset_yaw, o.steps_yaw)},
      {"sigmas", o.sigmas},
      {"robust", toString(o.icp.robust)},
      {"iterations", o.icp.max_iterations}};
  for (const auto& [name, parameter] : named(e.parameters))
    json["parameters"].push_back({{"name", name},
                                  {"value", parameter.value},
                                  {"source", parameter.given ? "given" : "derived"},
                                  {"why", parameter.why}});
  for (const IcpBestPose& best : e.basin.best)
    json["best"].push_back(toJson(best));
  json["disagreements"] = Json::array();
  for (const IcpDisagreement& d : e.basin.disagreements)
    json["disagreements"].push_back({{"metrics", {toString(d.a), toString(d.b)}},
                                     {"position", d.distance.translation},
                                     {"orientation", d.distance.rotation}});
  return json;
}

using BasinRows = std::vector<const IcpBasinRow*>;

/** \return the name of a file without its folder */
std::string
nameOf(const std::string& scan)
{
  return std::filesystem::path(scan).filename().string();
}

BasinRows
rowsOf(Metric metric, const IcpBasin& basin)
{
  BasinRows rows;
  for (const IcpBasinRow& row : basin.rows)
    if (row.variant.metric == metric)
      rows.push_back(&row);
  return rows;
}

ConvergenceMapScene
emptyScene(const IcpSettings& settings, const IcpEvaluation& e, Metric metric)
{
  ConvergenceMapScene scene;
  scene.title = nameOf(settings.scan_b) + " onto " + nameOf(settings.scan_a) +
                ", metric " + toString(metric);
  scene.x = scene.y = gridValues(e.options.offset_xy, e.options.steps_xy);
  return scene;
}

/** Adds the result of a run to the share of its cell in x and y. */
void
count(const IcpBasinRun& run, std::size_t place, double weight, ConvergencePanel& panel)
{
  panel.shares.at(place) =
      std::min(panel.shares.at(place) + (run.correct ? weight : 0.0), 1.0);
}

/** One panel per method: the share of successful turns. */
ConvergenceMapScene
sceneOfMethods(const IcpSettings& settings,
               const IcpEvaluation& e,
               Metric metric,
               const BasinRows& rows)
{
  ConvergenceMapScene scene = emptyScene(settings, e, metric);
  const std::size_t places = scene.x.size() * scene.y.size();
  scene.share_label = "correct runs over the yaws";
  for (const IcpBasinRow* row : rows) {
    char percent[32];
    std::snprintf(percent, sizeof percent, "%.1f %%", 100 * row->summary.success);
    ConvergencePanel panel{row->variant.minimiser + ", " +
                               toString(row->variant.search) + ": " + percent,
                           std::vector<double>(places, 0.0)};
    for (std::size_t i = 0; i < row->runs.size(); ++i)
      count(row->runs[i], i % places, 1.0 / e.options.steps_yaw, panel);
    scene.panels.push_back(std::move(panel));
  }
  return scene;
}

/** One panel per turn: the share of successful methods. */
ConvergenceMapScene
sceneOfYaws(const IcpSettings& settings,
            const IcpEvaluation& e,
            Metric metric,
            const BasinRows& rows)
{
  ConvergenceMapScene scene = emptyScene(settings, e, metric);
  const std::size_t places = scene.x.size() * scene.y.size();
  scene.title +=
      ": " + std::to_string(rows.size()) + (rows.size() == 1 ? " method" : " methods");
  scene.share_label = "correct runs over the methods";
  for (const double yaw : gridValues(e.options.offset_yaw, e.options.steps_yaw)) {
    char title[32];
    std::snprintf(
        title, sizeof title, yaw == 0 ? "yaw 0" : "yaw %+.3g deg", degrees(yaw));
    scene.panels.push_back({title, std::vector<double>(places, 0.0)});
  }
  for (const IcpBasinRow* row : rows)
    for (std::size_t i = 0; i < row->runs.size(); ++i)
      count(row->runs[i],
            i % places,
            1.0 / static_cast<double>(rows.size()),
            scene.panels[i / places]);
  return scene;
}
} // namespace

OutputRules
icpFolderRules(const IcpSettings& settings)
{
  OutputRules rules;
  rules.folder = settings.out;
  rules.inputs = {settings.scan_a, settings.scan_b};
  rules.program = kEvaluate;
  rules.marker = "icp.json";
  rules.files = std::regex("icp\\.(csv|json)|icp_runs\\.csv|icp_basin_[a-z_]+\\.png");
  rules.force = settings.force;
  return rules;
}

void
printIcpTable(const IcpSettings& settings, const IcpEvaluation& evaluation)
{
  if (!settings.quiet)
    printHeader(settings, evaluation);
  if (evaluation.basin.rows.empty())
    return;
  if (!settings.quiet)
    std::printf("\n");
  std::printf("%-7s%-18s%-12s%9s%11s%12s%9s%12s%9s%9s%11s\n",
              "metric",
              "minimiser",
              "search",
              "correct %",
              "error [mm]",
              "error [deg]",
              "rms [m]",
              "iterations",
              "ms",
              "reach m",
              "reach deg");
  for (const IcpBasinRow& row : evaluation.basin.rows)
    printRow(row);
}

void
writeIcpFiles(const OutputFolder& out,
              const IcpSettings& settings,
              const IcpEvaluation& e)
{
  writeFileAtomically(out / "icp.csv",
                      [&](std::ostream& stream) { writeRows(stream, e.basin); });
  writeFileAtomically(out / "icp_runs.csv",
                      [&](std::ostream& stream) { writeRuns(stream, e.basin); });
  writeJson(out / "icp.json", toJson(settings, e), 2);
}

bool
drawIcpBasins(FolderJob& job, const IcpSettings& settings, const IcpEvaluation& e)
{
  bool is_drawn = true;
  const auto draw = [&](const std::string& name, const ConvergenceMapScene& scene) {
    is_drawn &= job.draw(name, [&](const std::filesystem::path& picture) {
      ConvergenceMap().write(picture, scene);
    });
  };
  for (const IcpBestPose& best : e.basin.best) {
    const BasinRows rows = rowsOf(best.metric, e.basin);
    if (rows.empty())
      continue;
    const std::string name = std::string("icp_basin_") + toString(best.metric);
    draw(name + ".png", sceneOfMethods(settings, e, best.metric, rows));
    draw(name + "_yaw.png", sceneOfYaws(settings, e, best.metric, rows));
  }
  return is_drawn;
}

} // namespace pcl6d::app
