// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/icp_report.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/error.h>
#include <pcl6d/visualization/convergence_map.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace pcl6d::app {

namespace {
using Rows = std::vector<const IcpBasinRow*>;

std::string
nameOf(const std::string& scan)
{
  return std::filesystem::path(scan).filename().string();
}

Rows
rowsOf(Metric metric, const IcpBasin& basin)
{
  Rows rows;
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

/** Adds what a run has to say to the share of its place in x and y. */
void
count(const IcpBasinRun& run, std::size_t place, double weight, ConvergencePanel& panel)
{
  panel.shares.at(place) =
      std::min(panel.shares.at(place) + (run.correct ? weight : 0.0), 1.0);
}

/** One panel per method: the share of the turns from which it finds back. */
ConvergenceMapScene
sceneOfMethods(const IcpSettings& settings,
               const IcpEvaluation& e,
               Metric metric,
               const Rows& rows)
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

/** One panel per turn: the share of the methods that find back. */
ConvergenceMapScene
sceneOfYaws(const IcpSettings& settings,
            const IcpEvaluation& e,
            Metric metric,
            const Rows& rows)
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

void
drawIcpBasins(const OutputFolder& out,
              const IcpSettings& settings,
              const IcpEvaluation& e,
              ProgressBar& bar)
{
  try {
    for (const IcpBestPose& best : e.basin.best) {
      const Rows rows = rowsOf(best.metric, e.basin);
      if (rows.empty())
        continue;
      const std::string name = std::string("icp_basin_") + toString(best.metric);
      const ConvergenceMap map;
      map.write(out / (name + ".png"), sceneOfMethods(settings, e, best.metric, rows));
      map.write(out / (name + "_yaw.png"), sceneOfYaws(settings, e, best.metric, rows));
    }
  } catch (const pcl::PCLException& error) { // no display, or too many panels
    bar.warn("no picture: " + std::string(error.what()));
  }
}

} // namespace pcl6d::app
