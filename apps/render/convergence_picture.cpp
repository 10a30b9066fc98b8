// SPDX-License-Identifier: BSD-3-Clause
#include "render/run_pictures.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/io/frames_io.h>
#include <pcl6d/visualization/convergence_strip.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pcl6d::app {

namespace {
constexpr std::size_t kMostSteps = 8; // panels of a strip

/** Name of a step of the history, and its frame. */
struct HistoryStep {
  std::string name;
  std::size_t frame;
};

std::vector<HistoryStep>
stepsOf(const std::vector<Frame>& frames)
{
  std::vector<HistoryStep> steps;
  std::size_t rounds = 0;
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (i == 0)
      steps.push_back({"as given", i});
    else if (frames[i].kind == FrameKind::kElch)
      steps.push_back({"loops closed", i});
    else if (frames[i].kind == FrameKind::kLum)
      steps.push_back({"relaxation, round " + std::to_string(++rounds), i});
    else
      steps.push_back(
          {frames[i].kind == FrameKind::kInvalid ? "predicted" : "matched", i});
  return steps;
}

/** \return at most kMostSteps steps that moved the scan, including the last */
std::vector<HistoryStep>
someOf(const std::vector<HistoryStep>& steps, const std::vector<Frame>& frames)
{
  constexpr double kStill = 5e-4; // [m], [rad]
  std::vector<HistoryStep> some;
  for (const auto& step : steps) {
    if (!some.empty()) {
      const auto moved = distanceBetween(frames[some.back().frame].T_world_scan,
                                         frames[step.frame].T_world_scan);
      const bool still = moved.translation < kStill && moved.rotation < kStill;
      if (some.size() > 1 && still)
        continue;
      if (some.size() == kMostSteps)
        some.pop_back();
    }
    some.push_back(step);
  }
  return some;
}

std::string
distanceText(const Eigen::Isometry3d& pose, const Eigen::Isometry3d& last)
{
  const auto off = distanceBetween(pose, last);
  char text[64];
  std::snprintf(text,
                sizeof text,
                "%.3f m, %.2f deg from the last",
                off.translation,
                off.rotation * 180 / M_PI);
  return text;
}

/** Points of the other scans, at their poses of the step. */
Points
othersAt(std::size_t frame,
         std::size_t own,
         const RunMap& map,
         const std::map<int, std::size_t>& places,
         const std::vector<Eigen::Isometry3d>& last,
         const std::vector<std::vector<Frame>>& history)
{
  std::vector<Eigen::Isometry3d> motions;
  for (std::size_t i = 0; i < last.size(); ++i) {
    const auto& frames = history[i];
    motions.push_back(frames.empty()
                          ? Eigen::Isometry3d::Identity()
                          : frames[std::min(frame, frames.size() - 1)].T_world_scan *
                                last[i].inverse());
  }
  Points points;
  for (std::size_t k = 0; k < map.points.size() && k < map.scans.size(); ++k) {
    const auto place = places.find(static_cast<int>(map.scans[k]));
    if (place != places.end() && place->second != own)
      points.push_back(
          (motions[place->second] * map.points[k].cast<double>()).cast<float>());
  }
  return points;
}
} // namespace

Image
RunPictures::drawConvergence()
{
  const auto& scans = run_.summary().scans;
  const auto history = run_.readHistory();
  const std::size_t own = settings_.scan ? placeOf(*settings_.scan) : mostCorrected();
  if (own >= history.size() || history[own].empty())
    throw IoFailed(run_.path().string() +
                   ": the history of the scan is missing in frames/");
  const auto last = run_.trajectory().poses;
  ConvergenceStripScene scene;
  scene.title = title("scan " + std::to_string(scans[own].index) +
                      " on the way to the final pose");
  scene.scan = run_.readScan(own);
  if (scene.scan.empty())
    throw IoFailed(run_.path().string() + ": the scan is missing in scans/");
  for (const HistoryStep& step : someOf(stepsOf(history[own]), history[own])) {
    const Eigen::Isometry3d& pose = history[own][step.frame].T_world_scan;
    scene.steps.push_back({step.name,
                           distanceText(pose, last[own]),
                           pose,
                           othersAt(step.frame, own, map(), places_, last, history)});
  }
  ConvergenceStripOptions options;
  options.width = settings_.width.value_or(2000);
  options.background = settings_.background;
  options.transparent = settings_.transparent;
  return ConvergenceStrip(options).draw(scene).image;
}

} // namespace pcl6d::app
