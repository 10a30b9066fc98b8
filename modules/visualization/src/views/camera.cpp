// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/point_spread.h"

#include <pcl6d/visualization/camera.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace pcl6d {
using namespace visualization;

namespace {
constexpr double kFieldOfView = 0.6; // [rad] between left and right: not too steep

/** Enough for quantiles, without single points far away. */
Points
sampleOf(const Points& points)
{
  constexpr std::size_t kEnough = 30000;
  std::vector<std::size_t> indices(points.size());
  std::iota(indices.begin(), indices.end(), 0);
  Points sample;
  for (const auto i : thinned(indices, kEnough))
    sample.push_back(points[i]);
  Eigen::AlignedBox3f box;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float> values;
    for (const auto& p : sample)
      values.push_back(p[axis]);
    const float low = quantile(values, 0.002), high = quantile(values, 0.998);
    box.min()[axis] = low - 0.1F * (high - low);
    box.max()[axis] = high + 0.1F * (high - low);
  }
  sample.erase(std::remove_if(sample.begin(),
                              sample.end(),
                              [&](const auto& p) { return !box.contains(p); }),
               sample.end());
  return sample.empty() ? Points{points.front()} : sample;
}

/** Axes right, down, forward of a camera that looks at its scene. */
Eigen::Matrix3d
axesOf(double azimuth, double elevation)
{
  const Eigen::Vector3d forward(-std::cos(elevation) * std::cos(azimuth),
                                -std::cos(elevation) * std::sin(azimuth),
                                -std::sin(elevation));
  const Eigen::Vector3d right(-std::sin(azimuth), std::cos(azimuth), 0);
  Eigen::Matrix3d axes;
  axes << right, forward.cross(right), forward;
  return axes;
}

/** Position of the camera: points at u along an axis and w along the view stay within
 * the tangent on both sides. */
struct Stand {
  double back = 0;   // [m] along the view
  double middle = 0; // [m] along the axis
};

Stand
standFor(const std::vector<float>& u, const std::vector<float>& w, double tangent)
{
  std::vector<float> high(u.size()), low(u.size());
  const auto t = static_cast<float>(tangent);
  for (std::size_t i = 0; i < u.size(); ++i) {
    high[i] = u[i] - t * w[i];
    low[i] = -u[i] - t * w[i];
  }
  constexpr double kNearlyAll = 0.997;
  const double a = quantile(std::move(high), kNearlyAll);
  const double b = quantile(std::move(low), kNearlyAll);
  return {-(a + b) / (2 * tangent), 0.5 * (a - b)};
}

Camera
cameraOnSample(const Points& sample,
               double azimuth,
               double elevation,
               const PictureBox& box)
{
  const Eigen::Matrix3d axes = axesOf(azimuth, elevation);
  const Eigen::Matrix3f to_camera = axes.transpose().cast<float>();
  std::vector<float> u, v, w;
  for (const auto& p : sample) {
    const Eigen::Vector3f local = to_camera * p;
    u.push_back(local.x());
    v.push_back(local.y());
    w.push_back(local.z());
  }
  const double half_width = 0.5 * (box.right - box.left);
  const double half_height = 0.5 * (box.bottom - box.top);
  Camera camera;
  camera.scale = half_width / std::tan(0.5 * kFieldOfView);
  const Stand across = standFor(u, w, half_width / camera.scale);
  const Stand upwards = standFor(v, w, half_height / camera.scale);
  const double closest = *std::min_element(w.begin(), w.end()) - 0.5;
  const double back = std::min({across.back, upwards.back, closest});
  camera.T_world_camera.linear() = axes;
  camera.T_world_camera.translation() =
      axes * Eigen::Vector3d(across.middle, upwards.middle, back);
  camera.centre = {0.5 * (box.left + box.right), 0.5 * (box.top + box.bottom)};
  return camera;
}

/** Share of the picture that is filled, times the square of the share of visible points. */
double
scoreOf(const Camera& camera, const Points& sample, const PictureBox& box)
{
  constexpr int kColumns = 96;
  const double cell = (box.right - box.left) / kColumns;
  const auto rows = static_cast<int>((box.bottom - box.top) / cell) + 1;
  std::vector<double> nearest(static_cast<std::size_t>(kColumns * rows),
                              std::numeric_limits<double>::infinity());
  std::vector<std::pair<std::size_t, double>> seen;
  const Eigen::Isometry3d to_camera = camera.T_world_camera.inverse();
  for (const auto& p : sample) {
    const auto pixel = camera.project(to_camera * p.cast<double>());
    if (!pixel || !box.contains(pixel->head<2>()))
      continue;
    const auto column =
        std::min(static_cast<int>((pixel->x() - box.left) / cell), kColumns - 1);
    const auto row = static_cast<int>((pixel->y() - box.top) / cell);
    const auto place = static_cast<std::size_t>(row * kColumns + column);
    seen.emplace_back(place, pixel->z());
    nearest[place] = std::min(nearest[place], pixel->z());
  }
  std::size_t filled = 0, visible = 0;
  for (const double depth : nearest)
    filled += std::isfinite(depth);
  for (const auto& [place, depth] : seen)
    visible += depth <= 1.03 * nearest[place];
  const double share =
      static_cast<double>(visible) / static_cast<double>(sample.size());
  return share * share * static_cast<double>(filled) /
         static_cast<double>(nearest.size());
}

/** Azimuth range of the points [rad], the full circle unless a quarter is empty. */
std::pair<double, double>
seenAzimuths(const Points& points)
{
  constexpr int kBins = 360;
  const auto bin = [](int i) { return static_cast<std::size_t>(i % kBins); };
  std::vector<bool> seen(kBins, false);
  for (const auto& p : points)
    seen[bin(static_cast<int>((std::atan2(p.y(), p.x()) / (2 * M_PI) + 1) * kBins))] =
        true;
  int longest = 0, end = 0, gap = 0; // of the empty bins
  for (int i = 0; i < 2 * kBins; ++i) {
    gap = seen[bin(i)] ? 0 : gap + 1;
    if (gap > longest && gap < kBins) {
      longest = gap;
      end = i + 1;
    }
  }
  if (longest < kBins / 4)
    return {-M_PI, M_PI};
  const double degree = 2 * M_PI / kBins;
  return {(end - 2) * degree, (end + kBins - longest + 2) * degree};
}
} // namespace

Camera
cameraOn(const Points& points, double azimuth, double elevation, const PictureBox& box)
{
  return cameraOnSample(sampleOf(points), azimuth, elevation, box);
}

std::vector<Camera>
goodViewpoints(const Points& points, const PictureBox& box, std::size_t count)
{
  struct Candidate {
    double azimuth;
    double score;
    Camera camera;
  };
  const Points sample = sampleOf(points);
  std::vector<Candidate> candidates;
  for (const double elevation : {0.5, 0.75, 1.0}) // [rad]
    for (int i = 0; i < 24; ++i) {
      const double azimuth = 2 * M_PI * i / 24;
      const Camera camera = cameraOnSample(sample, azimuth, elevation, box);
      candidates.push_back({azimuth, scoreOf(camera, sample, box), camera});
    }
  std::stable_sort(candidates.begin(),
                   candidates.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  std::vector<Candidate> chosen;
  for (const auto& candidate : candidates) {
    const bool far = std::all_of(chosen.begin(), chosen.end(), [&](const auto& other) {
      return std::cos(candidate.azimuth - other.azimuth) <= 0.5 + 1e-9;
    });
    if (far && chosen.size() < count)
      chosen.push_back(candidate);
  }
  std::vector<Camera> cameras;
  for (const auto& candidate : chosen)
    cameras.push_back(candidate.camera);
  return cameras;
}

Camera
panoramaFrom(const Eigen::Isometry3d& T_world_scan,
             const Points& points,
             PictureBox& box)
{
  const auto [from, to] = seenAzimuths(points);
  const double ahead = 0.5 * (from + to);
  std::vector<float> elevations;
  for (const auto& p : points)
    elevations.push_back(std::atan2(p.z(), p.head<2>().norm()));
  const double low = quantile(elevations, 0.002) - 0.02; // [rad]
  const double high = quantile(std::move(elevations), 0.998) + 0.02;
  Eigen::Matrix3d axes; // right, down, forward in the frame of the scan
  axes << Eigen::Vector3d(std::sin(ahead), -std::cos(ahead), 0),
      -Eigen::Vector3d::UnitZ(), Eigen::Vector3d(std::cos(ahead), std::sin(ahead), 0);
  Camera camera;
  camera.projection = Projection::kPanorama;
  camera.T_world_camera = T_world_scan * Eigen::Isometry3d(axes);
  constexpr double kHighest = 0.6; // of the width
  const double width = box.right - box.left;
  camera.scale = std::min(width / (to - from), kHighest * width / (high - low));
  camera.centre = {0.5 * (box.left + box.right), box.top + camera.scale * high};
  box.bottom = box.top + camera.scale * (high - low);
  return camera;
}

} // namespace pcl6d
