// SPDX-License-Identifier: BSD-3-Clause
#include "render/film_points.h"
#include "render/run_animation.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/frames_io.h>
#include <pcl6d/visualization/camera_path.h>

#include <algorithm>
#include <limits>

namespace pcl6d::app {

namespace {
Eigen::Isometry3d
between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double share)
{
  const Eigen::Quaterniond q_a(a.linear()), q_b(b.linear());
  Eigen::Isometry3d pose(q_a.slerp(share, q_b));
  pose.translation() = (1 - share) * a.translation() + share * b.translation();
  return pose;
}

std::string
nameOf(FrameKind kind, std::size_t round)
{
  switch (kind) {
  case FrameKind::kElch:
    return "loops closed";
  case FrameKind::kLum:
    return "relaxation, round " + std::to_string(round);
  default:
    return "matched";
  }
}
} // namespace

RunAnimation::RunAnimation(const RunFolder& run, const AnimationSettings& settings)
: run_(run), settings_(settings)
{
  view_.width = settings.width;
  view_.height = settings.height;
  view_.max_points = std::numeric_limits<std::size_t>::max(); // chosen once, here
  view_.cut.max_height = std::numeric_limits<double>::infinity();
  view_.final_label = "path";
  switch (settings.kind) {
  case AnimationKind::kGrowth:
    tellGrowth();
    break;
  case AnimationKind::kRelaxation:
    tellRelaxation();
    break;
  case AnimationKind::kTurntable:
    tellTurntable();
    break;
  case AnimationKind::kFlyThrough:
    tellFlyThrough();
  }
}

/** Takes the points of the map. \return a frame with the map */
RunAnimation::Frame
RunAnimation::readMap(const HeightCut& cut)
{
  const RunMap map = run_.readMap();
  const Trajectory path = run_.trajectory();
  Part part;
  for (const auto i : chosenPoints(map.points, path, cut, settings_.points))
    part.points.push_back(map.points[i]);
  if (part.points.empty())
    throw IoFailed(run_.path().string() + ": has no points to show (map.pcd is missing "
                                          "or empty)");
  parts_.push_back(std::move(part));
  Frame frame;
  frame.poses = {Eigen::Isometry3d::Identity()};
  frame.path = path;
  return frame;
}

void
RunAnimation::tellTurntable()
{
  Frame frame = readMap({});
  const MapViewScene scene = sceneOf(frame);
  const Camera first = MapView(view_).viewpoints(scene, 1).front();
  for (const auto& camera :
       turntable(first, middleOf(scene.points), settings_.frames)) {
    frame.camera = camera;
    frames_.push_back(frame);
  }
}

/** From inside, the map appears near and with its ceiling: the scans have denser points. */
void
RunAnimation::tellFlyThrough()
{
  HeightCut all;
  all.max_height = std::numeric_limits<double>::infinity();
  Frame frame;
  const Trajectory path = run_.trajectory();
  if (run_.has("scans")) {
    frame.poses = path.poses;
    readScans(path.poses, all);
  }
  else {
    frame = readMap(all);
  }
  FlyThroughOptions options;
  options.count = settings_.frames;
  std::vector<Camera> cameras;
  try {
    cameras = flyThrough(path, MapView(view_).box(), options);
  } catch (const BadArgument&) {
    throw IoFailed(run_.path().string() + ": the path has no length to fly along");
  }
  frame.path = {}; // the camera is on the path
  view_.colour = PointColour::kHeight;
  view_.colour_range = heightsAlong(path, sceneOf(frame).points);
  view_.point_size = 0.7;
  for (const auto& camera : cameras) {
    frame.camera = camera;
    frames_.push_back(frame);
  }
}

/** \return per scan its history, padded to equal lengths */
std::vector<std::vector<pcl6d::Frame>>
RunAnimation::readHistory() const
{
  auto history = run_.readHistory();
  std::size_t longest = 0;
  for (const auto& frames : history)
    longest = std::max(longest, frames.size());
  for (std::size_t i = 0; i < history.size(); ++i) {
    if (history[i].empty() || longest < 2)
      throw IoFailed(run_.path().string() +
                     ": has no history to show (frames/ lacks a file or rounds)");
    history[i].resize(longest, history[i].back());
  }
  if (history.empty())
    throw IoFailed(run_.path().string() + ": has no scans");
  return history;
}

/** Takes the points of the scans, without points cut off at the poses. */
void
RunAnimation::readScans(const std::vector<Eigen::Isometry3d>& poses,
                        const HeightCut& cut)
{
  const std::size_t most =
      std::max<std::size_t>(1, 2 * settings_.points / poses.size());
  MapViewScene whole;
  whole.trajectory.poses = poses;
  std::vector<std::size_t> part_of;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Part part;
    part.scan = static_cast<std::uint32_t>(run_.summary().scans[i].index);
    const Points points = run_.readScan(i);
    const std::size_t step =
        std::max<std::size_t>(1, (points.size() + most - 1) / most);
    for (std::size_t k = 0; k < points.size(); k += step)
      part.points.push_back(points[k]);
    const Points moved = transformed(part.points, poses[i]);
    whole.points.insert(whole.points.end(), moved.begin(), moved.end());
    part_of.insert(part_of.end(), moved.size(), i);
    parts_.push_back(std::move(part));
  }
  if (whole.points.empty())
    throw IoFailed(run_.path().string() +
                   ": has no points to show (scans/ is missing)");
  std::vector<Points> kept(parts_.size());
  std::vector<std::size_t> begin(parts_.size(), 0);
  for (std::size_t i = 1; i < parts_.size(); ++i)
    begin[i] = begin[i - 1] + parts_[i - 1].points.size();
  for (const auto i :
       chosenPoints(whole.points, whole.trajectory, cut, settings_.points))
    kept[part_of[i]].push_back(parts_[part_of[i]].points[i - begin[part_of[i]]]);
  for (std::size_t i = 0; i < parts_.size(); ++i)
    parts_[i].points = std::move(kept[i]);
  view_.colour = PointColour::kScan;
  view_.colour_range = {static_cast<double>(parts_.front().scan),
                        static_cast<double>(parts_.back().scan)};
}

void
RunAnimation::tellGrowth()
{
  const auto history = readHistory();
  std::vector<Eigen::Isometry3d> matched;
  for (const auto& frames : history) {
    if (frames[1].kind == FrameKind::kInvalid) // interrupted before
      break;
    matched.push_back(frames[1].T_world_scan);
  }
  if (matched.empty())
    throw IoFailed(run_.path().string() + ": no scan of the run was registered");
  readScans(matched, {});
  Frame frame;
  for (std::size_t i = 0; i < matched.size(); ++i) {
    frame.poses.push_back(matched[i]);
    frame.path.poses = frame.poses;
    frame.title =
        std::to_string(i + 1) + " of " + std::to_string(matched.size()) + " scans";
    frames_.push_back(frame);
  }
  const Camera camera = MapView(view_).viewpoints(sceneOf(frame), 1).front();
  for (auto& one : frames_)
    one.camera = camera;
}

void
RunAnimation::tellRelaxation()
{
  const auto history = readHistory();
  const auto final_poses = run_.trajectory().poses;
  const std::size_t states = history.front().size();
  const auto poseAt = [&](std::size_t scan, std::size_t state) {
    return state + 1 == states ? final_poses[scan] : history[scan][state].T_world_scan;
  };
  readScans(final_poses, {});
  std::size_t round = 0;
  for (std::size_t state = 0; state < states; ++state) {
    const FrameKind kind = history.back()[state].kind;
    round += kind == FrameKind::kLum;
    const int steps = state == 0 ? 1 : settings_.steps;
    for (int step = 1; step <= steps; ++step) {
      Frame frame;
      const double share = static_cast<double>(step) / steps;
      for (std::size_t i = 0; i < history.size(); ++i)
        frame.poses.push_back(
            step == steps ? poseAt(i, state)
                          : between(poseAt(i, state - 1), poseAt(i, state), share));
      frame.path.poses = frame.poses;
      frame.title = state == 0 ? "as given" : nameOf(kind, round);
      frames_.push_back(std::move(frame));
    }
  }
  const Camera camera = MapView(view_).viewpoints(sceneOf(frames_.back()), 1).front();
  for (auto& frame : frames_)
    frame.camera = camera;
}

MapViewScene
RunAnimation::sceneOf(const Frame& frame) const
{
  MapViewScene scene;
  scene.trajectory = frame.path;
  for (std::size_t i = 0; i < frame.poses.size(); ++i) {
    const Points moved = transformed(parts_[i].points, frame.poses[i]);
    scene.points.insert(scene.points.end(), moved.begin(), moved.end());
    scene.scans.insert(scene.scans.end(), moved.size(), parts_[i].scan);
  }
  return scene;
}

Image
RunAnimation::draw(std::size_t frame) const
{
  MapViewOptions options = view_;
  options.title = frames_[frame].title;
  return MapView(options).draw(sceneOf(frames_[frame]), frames_[frame].camera).image;
}

} // namespace pcl6d::app
