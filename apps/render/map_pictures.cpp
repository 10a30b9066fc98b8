// SPDX-License-Identifier: BSD-3-Clause
// The views of the map, from above and in perspective.
#include "render/run_pictures.h"

#include <pcl6d/common/error.h>
#include <pcl6d/visualization/before_after_view.h>
#include <pcl6d/visualization/map_overlays.h>

#include <cmath>

namespace pcl6d::app {

namespace {
LinkState
stateOf(const RunLink& link)
{
  if (link.verdict == LinkVerdict::kOdometry)
    return LinkState::kOdometry;
  return link.counts() ? LinkState::kUsed : LinkState::kRefused;
}

/** Whether a scan is unreliable. */
bool
isDoubtful(const ScanResult& scan)
{
  return scan.state == ScanState::kPredicted || scan.state == ScanState::kUnconverged ||
         scan.state == ScanState::kPending;
}

/** The bounding box of the paths with a margin, for the surroundings of each pose. */
Eigen::AlignedBox2d
areaAround(const Trajectory& trajectory)
{
  Eigen::AlignedBox2d box;
  for (const auto& pose : trajectory.poses)
    box.extend(Eigen::Vector2d(pose.translation().head<2>()));
  if (box.isEmpty())
    return {Eigen::Vector2d(-1, -1), Eigen::Vector2d(1, 1)};
  const double room = 2 + 0.2 * box.diagonal().norm(); // [m]
  return {box.min() - Eigen::Vector2d(room, room),
          box.max() + Eigen::Vector2d(room, room)};
}
} // namespace

TopViewScene
RunPictures::topScene(PointColour colour)
{
  TopViewScene scene;
  static_cast<MapCloud&>(scene) = cloudFor(colour);
  scene.trajectory = run_.trajectory();
  scene.initial = run_.initialTrajectory();
  return scene;
}

MapViewScene
RunPictures::mapScene(PointColour colour)
{
  MapViewScene scene;
  static_cast<MapCloud&>(scene) = cloudFor(colour);
  scene.trajectory = run_.trajectory();
  return scene;
}

Image
RunPictures::drawTop()
{
  TopViewOptions options = optionsOf<TopViewOptions>("", PointColour::kHeight);
  options.shading = 0.4;
  TopViewScene scene = topScene(options.colour);
  scene.moving = run_.readMoving().points;
  return TopView(options).draw(scene).image;
}

Camera
RunPictures::chosenCamera(const MapView& view, const MapViewScene& scene) const
{
  if (!settings_.azimuth && !settings_.elevation)
    return view.viewpoints(scene, settings_.viewpoint).back();
  constexpr double kUsualElevation = 0.75; // [rad]
  return view.cameraFrom(scene,
                         settings_.azimuth.value_or(0),
                         settings_.elevation.value_or(kUsualElevation));
}

Image
RunPictures::drawPerspective()
{
  MapViewOptions options = optionsOf<MapViewOptions>("", PointColour::kHeight);
  options.final_label = "path of the scanner";
  const MapViewScene scene = mapScene(options.colour);
  const MapView view(options);
  return view.draw(scene, chosenCamera(view, scene)).image;
}

/** The map with each scan at its initial pose. */
TopViewScene
RunPictures::sceneBefore(const TopViewScene& after, PointColour colour)
{
  TopViewScene before = after;
  before.trajectory = run_.initialTrajectory();
  before.initial.poses.clear();
  std::vector<Eigen::Isometry3d> motions;
  for (std::size_t i = 0; i < before.trajectory.poses.size(); ++i)
    motions.push_back(before.trajectory.poses[i] * after.trajectory.poses[i].inverse());
  if (before.scans.size() != before.points.size())
    throw IoFailed(
        run_.path().string() + ": before-after needs the scan of each point" +
        (colour == PointColour::kLabel ? ", missing with colour label" : ""));
  for (std::size_t k = 0; k < before.points.size(); ++k) {
    const auto& motion = motions[placeOf(static_cast<int>(before.scans[k]))];
    before.points[k] = (motion * before.points[k].cast<double>()).cast<float>();
  }
  return before;
}

Image
RunPictures::drawBeforeAfter()
{
  TopViewOptions options = optionsOf<TopViewOptions>("before", PointColour::kScan);
  options.width = settings_.width.value_or(2000);
  options.final_label = options.initial_label = ""; // the titles tell
  TopViewScene after = topScene(options.colour);
  after.initial.poses.clear();
  const TopViewScene before = sceneBefore(after, options.colour);
  return BeforeAfterView(options, "after").draw(before, after).image;
}

Image
RunPictures::drawGraph()
{
  TopViewOptions options =
      optionsOf<TopViewOptions>("links of the scans", PointColour::kPlain);
  TopViewScene scene = topScene(options.colour);
  std::vector<ViewLink> links;
  for (const RunLink& link : run_.readLinks())
    links.push_back({placeOf(static_cast<int>(link.from)),
                     placeOf(static_cast<int>(link.to)),
                     stateOf(link),
                     link.rms});
  std::vector<bool> doubtful;
  for (const auto& scan : run_.summary().scans)
    doubtful.push_back(run_.hasSummary() && isDoubtful(scan));
  options.area = areaAround(scene.trajectory);
  scene.overlay = graphOverlay(scene.trajectory, links, doubtful, options.background);
  options.draw_paths = false;
  return TopView(options).draw(scene).image;
}

Image
RunPictures::drawCovariance()
{
  TopViewOptions options =
      optionsOf<TopViewOptions>("covariances", PointColour::kPlain);
  TopViewScene scene = topScene(options.colour);
  std::vector<std::optional<Eigen::Matrix3d>> covariances;
  for (const auto& scan : run_.summary().scans) {
    covariances.emplace_back();
    if (scan.covariance)
      covariances.back() = scan.covariance->topLeftCorner<3, 3>();
  }
  options.area = areaAround(scene.trajectory);
  scene.overlay = covarianceOverlay(scene.trajectory, covariances, options.background);
  options.draw_paths = false;
  return TopView(options).draw(scene).image;
}

Image
RunPictures::drawSlice()
{
  TopViewOptions options = optionsOf<TopViewOptions>("slice", PointColour::kScan);
  options.cut.slice = HeightSlice{std::nullopt, settings_.slice_thickness};
  if (settings_.slice_height)
    options.cut.slice->height =
        *settings_.slice_height - run_.summary().world_offset.z();
  options.final_label = "path of the scanner";
  TopViewScene scene = topScene(options.colour);
  scene.initial.poses.clear();
  scene.overlay = roomOverlay();
  return TopView(options).draw(scene).image;
}

Image
RunPictures::drawPanorama()
{
  const auto& scans = run_.summary().scans;
  if (scans.empty())
    throw IoFailed(run_.path().string() + ": panorama needs the poses of the scans");
  const std::size_t place =
      settings_.scan ? placeOf(*settings_.scan) : scans.size() / 2;
  const RunMap own = run_.readScanCloud(place);
  const Eigen::Isometry3d pose = run_.trajectory().poses[place];
  MapViewScene scene;
  scene.points = transformed(own.points, pose);
  scene.scans = own.scans;
  scene.reflectances = own.intensities;
  MapViewOptions options = optionsOf<MapViewOptions>(
      "panorama of scan " + std::to_string(scans[place].index),
      own.intensities.empty() ? PointColour::kHeight : PointColour::kReflectance);
  options.width = settings_.width.value_or(2000);
  options.shading = 0.3; // near ground is seen under many angles
  return MapView(options).drawPanorama(scene, pose).image;
}

} // namespace pcl6d::app
