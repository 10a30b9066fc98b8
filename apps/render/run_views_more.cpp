// SPDX-License-Identifier: BSD-3-Clause
// The views of planes and of the way of one scan.
#include "render/run_pictures.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/visualization/convergence_strip.h>
#include <pcl6d/visualization/plane_view.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace pcl6d::app {

namespace {
constexpr std::size_t kMostSteps = 8; // panels of a strip

/** The normal of a plane to the side from which it was seen: where the next pose is. */
Eigen::Vector3d
seenFrom(const Plane& plane, const std::vector<Eigen::Isometry3d>& poses)
{
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& corner : plane.hull)
    middle += corner / static_cast<double>(plane.hull.size());
  double nearest = std::numeric_limits<double>::infinity();
  double side = 1;
  for (const auto& pose : poses) {
    const double distance = (pose.translation() - middle).norm();
    if (distance >= nearest)
      continue;
    nearest = distance;
    side = plane.normal.dot(pose.translation()) - plane.offset;
  }
  return side < 0 ? Eigen::Vector3d(-plane.normal) : plane.normal;
}

/** What a step of the history is called, and from which frame it is. */
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

/** \return the first steps, where most happens, and the last one */
std::vector<HistoryStep>
someOf(const std::vector<HistoryStep>& steps)
{
  if (steps.size() <= kMostSteps)
    return steps;
  std::vector<HistoryStep> some(steps.begin(), steps.begin() + kMostSteps - 1);
  some.push_back(steps.back());
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

/** What the other scans measured, with each in its place of that step. */
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
RunPictures::drawPlanes()
{
  PlaneViewScene scene;
  RunPlanePoints points = run_.readPlanePoints();
  scene.points = std::move(points.points);
  scene.plane_of = std::move(points.plane_of);
  scene.planes = run_.readPlanes();
  if (scene.points.empty()) {
    scene.points = map().points;
    scene.plane_of.assign(scene.points.size(), 0);
  }
  const Eigen::Vector3d& offset = run_.summary().world_offset;
  const auto poses = run_.trajectory().poses;
  for (Plane& plane : scene.planes) {
    plane.offset -= plane.normal.dot(offset);
    for (auto& corner : plane.hull)
      corner -= offset;
    scene.seen_from.push_back(seenFrom(plane, poses));
  }
  PlaneViewOptions options;
  options.width = settings_.width.value_or(options.width);
  options.height = settings_.height.value_or(options.height);
  if (!settings_.azimuth.is_auto)
    options.azimuth = settings_.azimuth.value;
  if (!settings_.elevation.is_auto)
    options.elevation = settings_.elevation.value;
  options.background = settings_.background;
  options.transparent = settings_.transparent;
  options.title = title("planes");
  options.max_points = settings_.points;
  Image image;
  PlaneView(options).draw(scene, image);
  return image;
}

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
  scene.title =
      title("scan " + std::to_string(scans[own].index) + " on the way to its place");
  scene.scan = run_.readScan(own);
  if (scene.scan.empty())
    throw IoFailed(run_.path().string() + ": the scan is missing in scans/");
  for (const HistoryStep& step : someOf(stepsOf(history[own]))) {
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
