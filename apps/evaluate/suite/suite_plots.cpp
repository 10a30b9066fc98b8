// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/suite/suite_report.h"

#include <pcl6d/visualization/line_chart.h>

#include <algorithm>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

constexpr Colour kReference{0, 0, 0};
constexpr Colour kOdometry{170, 170, 170};

bool
isOdometry(const SuiteResult& result)
{
  return result.row.runs == 0;
}

ChartSeries
namedSeries(const SuiteResult& result)
{
  ChartSeries series;
  series.name = result.row.method;
  if (isOdometry(result))
    series.colour = kOdometry;
  return series;
}

void
addPath(const Trajectory& path, ChartSeries series, LineChartScene& scene)
{
  if (path.poses.empty())
    return;
  for (const auto& pose : path.poses) {
    series.x.push_back(pose.translation().x());
    series.y.push_back(pose.translation().y());
  }
  scene.series.push_back(std::move(series));
}

LineChartScene
emptyScene(const DataResults& data,
           const std::string& title,
           const std::string& x,
           const std::string& y)
{
  LineChartScene scene;
  scene.title = data.data + ": " + title;
  scene.x.title = x;
  scene.y.title = y;
  return scene;
}

/** \return the part of the reference used in a comparison */
Trajectory
comparedReference(const DataResults& data)
{
  std::size_t first = data.reference.poses.size(), end = 0;
  for (const SuiteResult& result : data.results)
    if (result.row.errors)
      for (const PosePair& pair : result.row.errors->matching.pairs) {
        first = std::min(first, pair.reference);
        end = std::max(end, pair.reference + 1);
      }
  Trajectory part;
  for (std::size_t i = first; i < end; ++i)
    part.poses.push_back(data.reference.poses[i]);
  return part;
}

/** The reference lies on top, to show where other paths leave the reference. */
LineChartScene
pathsOf(const DataResults& data)
{
  LineChartScene scene = emptyScene(data, "paths", "x [m]", "y [m]");
  scene.equal_aspect = true;
  for (const SuiteResult& result : data.results)
    addPath(result.estimate, namedSeries(result), scene);
  ChartSeries reference;
  reference.name = "reference";
  reference.colour = kReference;
  addPath(comparedReference(data), reference, scene);
  return scene;
}

LineChartScene
errorsOf(const DataResults& data)
{
  LineChartScene scene = emptyScene(data, "position error", "scan", "error [m]");
  scene.y.logarithmic = true;
  for (const SuiteResult& result : data.results) {
    if (!result.row.errors)
      continue;
    ChartSeries series = namedSeries(result);
    const auto& poses = result.row.errors->without_alignment.poses;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      series.x.push_back(
          static_cast<double>(result.row.errors->matching.pairs[i].reference));
      series.y.push_back(poses[i].position);
    }
    scene.series.push_back(std::move(series));
  }
  return scene;
}

LineChartScene
timesOf(const DataResults& data)
{
  LineChartScene scene =
      emptyScene(data, "share of the time by stage", "time [s]", "position rms [m]");
  scene.x.logarithmic = scene.y.logarithmic = true;
  for (const SuiteResult& result : data.results) {
    if (!result.row.errors || !result.row.seconds)
      continue;
    ChartSeries series = namedSeries(result);
    series.mark = ChartMark::kDots;
    series.x = {*result.row.seconds};
    series.y = {result.row.errors->without_alignment.position.rms};
    scene.series.push_back(std::move(series));
  }
  return scene;
}

/** A chart without positive values has no logarithms and is not drawn. */
bool
hasPoints(const LineChartScene& scene)
{
  for (const ChartSeries& series : scene.series)
    for (std::size_t i = 0; i < series.x.size(); ++i)
      if ((!scene.x.logarithmic || series.x[i] > 0) &&
          (!scene.y.logarithmic || series.y[i] > 0))
        return true;
  return false;
}
} // namespace

void
drawSuite(const fs::path& folder, const std::vector<DataResults>& results)
{
  for (const DataResults& data : results) {
    LineChartOptions options;
    options.height = std::max(options.height,
                              120 + 21 * (2 + static_cast<int>(data.results.size())));
    const LineChart chart(options);
    const std::pair<const char*, LineChartScene> charts[] = {
        {"_paths.png", pathsOf(data)},
        {"_errors.png", errorsOf(data)},
        {"_times.png", timesOf(data)}};
    for (const auto& [ending, scene] : charts)
      if (hasPoints(scene))
        chart.write(folder / (data.data + ending), scene);
  }
}

} // namespace pcl6d::app
