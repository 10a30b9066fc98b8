// SPDX-License-Identifier: BSD-3-Clause
#include "cascade/training_scene.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/simulation/cast_scan.h>
#include <pcl6d/simulation/scene_bodies.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::object_localization {
namespace {
TriangleScene
sceneOf(const TriangleMesh& mesh, const Eigen::AlignedBox3d& box)
{
  Eigen::Isometry3d standing = Eigen::Isometry3d::Identity();
  standing.translation() = -box.center();
  standing.translation().z() = -box.min().z();
  Surface material;
  material.reflectance = 1; // times the drawn reflectance
  material.is_solid = false;
  TriangleScene scene;
  addMesh(scene, mesh, standing, material);
  return scene;
}

Eigen::AlignedBox3d
boxOf(const std::vector<Eigen::Vector3d>& vertices)
{
  Eigen::AlignedBox3d box;
  for (const auto& vertex : vertices)
    box.extend(vertex);
  return box;
}

/** \return the height of the floor at a position in plan, from the points around it */
std::optional<double>
floorAt(const Points& points, const Eigen::Vector2d& place)
{
  constexpr float kReach = 0.6f;     // [m]
  constexpr std::size_t kFewest = 8; // points
  std::vector<float> heights;
  for (const auto& p : points)
    if ((p.head<2>() - place.cast<float>()).squaredNorm() < kReach * kReach)
      heights.push_back(p.z());
  if (heights.size() < kFewest)
    return {};
  const auto low = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 10);
  std::nth_element(heights.begin(), low, heights.end());
  return *low;
}

/** \return whether points of the scan are inside the object's box */
bool
isBlocked(const Points& points,
          const Eigen::AlignedBox3d& box,
          const Eigen::Isometry3d& T_model_scan)
{
  constexpr double kFloor = 0.1; // [m] points up to this height may be on the floor
  constexpr int kMost = 3;
  Eigen::AlignedBox3d inner = box;
  inner.min().z() += kFloor;
  int inside = 0;
  for (const auto& p : points)
    inside += inner.contains(T_model_scan * p.cast<double>()) ? 1 : 0;
  return inside > kMost;
}

/** The samples of the scanner on the model, in the scan's frame. */
MeasuredPoints
samplesOn(const RayCaster& caster,
          const ScannerPreset& scanner,
          const Eigen::Isometry3d& T_model_scan,
          double reflectance,
          std::uint64_t seed)
{
  RangeOptions range = scanner.range;
  range.seed = seed;
  range.num_threads = 1;
  const RangeScan scan = castScan(caster, *scanner.scanner, T_model_scan, range);
  MeasuredPoints samples;
  for (int line = 0; line < scan.num_lines; ++line)
    for (int i = 0; i < scan.samples_per_line; ++i) {
      const RangeSample& sample = scan.at(line, i);
      if (!std::isfinite(sample.range))
        continue;
      const Ray ray = scanner.scanner->ray(line, i);
      samples.points.push_back(
          (ray.origin + sample.range * ray.direction).cast<float>());
      samples.reflectance.push_back(static_cast<float>(reflectance * sample.intensity));
    }
  return samples;
}

/** Removes the points hidden by the object. */
MeasuredPoints
notHidden(const TrainingScan& scan,
          const TrainingModel& model,
          const Eigen::Isometry3d& T_model_scan)
{
  const Eigen::Vector3d middle = T_model_scan.inverse() * model.box().center();
  const double radius = model.box().diagonal().norm() / 2;
  const double distance = middle.norm();
  const double cosine =
      std::sqrt(std::max(0.0, 1 - radius * radius / (distance * distance)));
  MeasuredPoints left;
  for (std::size_t i = 0; i < scan.points().size(); ++i) {
    const Eigen::Vector3d p = scan.points()[i].cast<double>();
    const double range = p.norm();
    const bool is_towards =
        distance <= radius || p.dot(middle) >= cosine * range * distance;
    if (is_towards && range > 0) {
      const Ray ray{T_model_scan.translation(), T_model_scan.linear() * p / range};
      if (model.caster().cast(ray, range))
        continue;
    }
    left.points.push_back(scan.points()[i]);
    if (!scan.reflectance().empty())
      left.reflectance.push_back(scan.reflectance()[i]);
  }
  return left;
}

constexpr int kCols = 720, kRows = 360; // half a degree

std::size_t
cellOf(const Eigen::Vector3f& p)
{
  const double azimuth = portableAtan2(p.y(), p.x());
  const double elevation = portableAtan2(p.z(), p.head<2>().norm());
  const int col = static_cast<int>((azimuth / M_PI + 1) / 2 * kCols) % kCols;
  const int row =
      std::min(kRows - 1, static_cast<int>((elevation / M_PI + 0.5) * kRows));
  return static_cast<std::size_t>(row * kCols + col);
}

/** \return which samples are visible: no point of the scan is near their direction and
 * clearly nearer */
std::vector<bool>
visible(const Points& samples, const TrainingScan& scan)
{
  constexpr float kClearly = 0.15f; // [m]
  std::vector<bool> seen;
  for (const auto& p : samples)
    seen.push_back(p.norm() < scan.nearestTowards(p) + kClearly);
  return seen;
}

Eigen::Isometry3d
randomPose(const TrainingImageOptions& options, Random& random)
{
  const double distance = random.uniform(options.min_distance, options.max_distance);
  const SinCos azimuth = portableSinCos(random.uniform(-M_PI, M_PI));
  const SinCos heading = portableSinCos(random.uniform(-M_PI, M_PI));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear().topLeftCorner<2, 2>() << heading.cos, -heading.sin, heading.sin,
      heading.cos;
  pose.translation() << distance * azimuth.cos, distance * azimuth.sin, 0;
  return pose;
}
} // namespace

TrainingScan::TrainingScan(const BackgroundScan& scan)
: scan_(&scan)
, nearest_(std::size_t{kCols} * kRows, std::numeric_limits<float>::infinity())
{
  for (const auto& p : scan.points) {
    float& nearest = nearest_[cellOf(p)];
    nearest = std::min(nearest, p.norm());
  }
}

float
TrainingScan::nearestTowards(const Eigen::Vector3f& point) const
{
  return nearest_[cellOf(point)];
}

TrainingModel::TrainingModel(const TriangleMesh& mesh)
: caster_(sceneOf(mesh, boxOf(mesh.vertices)))
{
  box_ = boxOf(caster_.scene().vertices);
}

ObjectInScan
putIntoScan(const TrainingModel& model,
            const ScannerPreset& scanner,
            const TrainingScan& scan,
            const TrainingImageOptions& options,
            Random& random)
{
  ObjectInScan result;
  Eigen::Isometry3d T_scan_model = randomPose(options, random);
  const double reflectance =
      random.uniform(options.min_reflectance, options.max_reflectance);
  const auto seed = static_cast<std::uint64_t>(random.uniform() * 0x1p53);
  const auto refused = [&](PlaceVerdict verdict) {
    result.verdict = verdict;
    return result;
  };
  const auto floor = floorAt(scan.points(), T_scan_model.translation().head<2>());
  if (!floor)
    return refused(PlaceVerdict::kNoFloor);
  T_scan_model.translation().z() = *floor;
  const Eigen::Isometry3d T_model_scan = T_scan_model.inverse();
  if (isBlocked(scan.points(), model.box(), T_model_scan))
    return refused(PlaceVerdict::kBlocked);
  const MeasuredPoints samples =
      samplesOn(model.caster(), scanner, T_model_scan, reflectance, seed);
  if (samples.points.size() < options.min_samples)
    return refused(PlaceVerdict::kTooFewSamples);
  const std::vector<bool> seen = visible(samples.points, scan);
  const auto count = std::count(seen.begin(), seen.end(), true);
  if (static_cast<double>(count) <
      options.min_visible * static_cast<double>(samples.points.size()))
    return refused(PlaceVerdict::kHidden);
  result.scan = notHidden(scan, model, T_model_scan);
  result.middle = T_scan_model * model.box().center();
  result.nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (seen[i]) {
      const double range = samples.points[i].norm();
      result.nearest = std::min(result.nearest, range);
      result.farthest = std::max(result.farthest, range);
      result.scan.points.push_back(samples.points[i]);
      if (!scan.reflectance().empty())
        result.scan.reflectance.push_back(samples.reflectance[i]);
    }
  return result;
}

} // namespace pcl6d::object_localization
