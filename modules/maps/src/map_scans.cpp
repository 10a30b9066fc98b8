// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/option_names.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/filters/scan_sampling.h>
#include <pcl6d/maps/map_scans.h>
#include <pcl6d/run/registered_scans.h>
#include <pcl6d/visibility/ray_origin.h>

#include <algorithm>

namespace pcl6d {

namespace {
/** [m] default of octomap_server and slam_toolbox, the usual makers of maps under ROS. */
constexpr double kFinestByDefault = 0.05;

/** \return the smallest of 0.05, 0.1, 0.2, 0.5, 1, 2, ... not below the length */
double
roundedUp(double length)
{
  double unit = kFinestByDefault / 5;
  for (;; unit *= 10)
    for (const double step : {1, 2, 5})
      if (unit * step >= kFinestByDefault && unit * step >= length * (1 - 1e-9))
        return unit * step;
}

bool
isFloating(const ScanResult& scan, const RunResult& run)
{
  return std::find(run.floating.begin(), run.floating.end(), scan.file) !=
         run.floating.end();
}
} // namespace

MapScans::MapScans(const std::filesystem::path& run)
: run_(RunFolder::finished(run, "the run was interrupted; start the run again"))
, trajectory_(run_.trajectory())
{
  const std::filesystem::path file = run / "summary.json";
  const RunResult& summary = run_.summary();
  min_range_ = lengthOfRun(summary, kMinRangeOption, file);
  max_range_ = lengthOfRun(summary, kMaxRangeOption, file);
  for (std::size_t i = 0; i < summary.scans.size(); ++i)
    if (summary.scans[i].state == ScanState::kPredicted ||
        isFloating(summary.scans[i], summary))
      ++left_out_;
    else
      places_.push_back(i);
  has_rays_.resize(places_.size());
}

Points
MapScans::ownPoints(std::size_t place) const
{
  run_.requireScan(place);
  return gateByRange(run_.readScan(place), min_range_, max_range_);
}

MappedScan
MapScans::read(std::size_t i)
{
  const std::size_t place = places_.at(i);
  const Points points = ownPoints(place);
  const Eigen::Isometry3d& pose = trajectory_.poses[place];
  if (!has_rays_[i])
    has_rays_[i] = isPlausibleOrigin(points);
  MappedScan scan;
  scan.points = transformed(points, pose);
  scan.origin = pose.translation().cast<float>();
  scan.has_rays = *has_rays_[i];
  return scan;
}

Parameter
MapScans::resolution() const
{
  const double voxel =
      lengthOfRun(run_.summary(), kVoxelOption, run_.path() / "summary.json");
  std::vector<double> spacings;
  if (!places_.empty())
    for (const std::size_t i : {std::size_t{0}, size() / 2, size() - 1})
      spacings.push_back(samplingOf(ownPoints(places_[i])).lineSpacing());
  std::sort(spacings.begin(), spacings.end());
  const double spacing = spacings.empty() ? 0 : spacings[spacings.size() / 2];
  Parameter resolution;
  resolution.value = roundedUp(std::max(voxel, spacing));
  resolution.why = spacing > voxel ? "line spacing" : "voxel of the run";
  resolution.why += ", rounded up";
  return resolution;
}

std::size_t
MapScans::withoutRays() const
{
  return static_cast<std::size_t>(
      std::count(has_rays_.begin(), has_rays_.end(), std::optional<bool>(false)));
}

} // namespace pcl6d
