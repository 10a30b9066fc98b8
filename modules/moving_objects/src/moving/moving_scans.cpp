// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/filters/scan_sampling.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/moving_objects/moving_scans.h>
#include <pcl6d/visibility/range_noise.h>
#include <pcl6d/visibility/ray_origin.h>

#include <cmath>
#include <utility>

namespace pcl6d {

namespace {
/** Normals as in matching: number of points, and voxel of their reduction. */
constexpr std::size_t kNormalNeighbours = 10;
constexpr double kNormalVoxels = 3;

Points
reducedBy(double voxel, const Points& points)
{
  ReductionOptions reduction;
  reduction.voxel = voxel;
  return reducePoints(points, reduction);
}

/** \return the points in the frame of the scanner */
Points
seenFrom(const Eigen::Vector3f& origin, const Points& measured)
{
  Points seen = measured;
  for (Eigen::Vector3f& p : seen)
    p -= origin;
  return seen;
}
} // namespace

/** A scan in the frame with the scanner at the origin. */
struct MovingScans::Kept {
  Eigen::Vector3f origin;
  double min_range = 0, max_range = 0, voxel = 0; // [m]
  RayImage rays;
  Points surface;
  Normals normals;
  PointTree tree;
  SeenScan seen;

  Kept(const Eigen::Vector3f& from,
       const Points& measured,
       const std::optional<double>& given_voxel,
       unsigned int num_threads)
  : origin(from)
  {
    Points points = seenFrom(from, measured);
    ScanParameterOptions given;
    given.voxel = given_voxel;
    const ScanParameters gate = deriveScanParameters(given, {points});
    min_range = gate.min_range.value;
    max_range = gate.max_range.value;
    voxel = gate.voxel.value;
    points = gateByRange(points, min_range, max_range);
    RayImageOptions image;
    image.noise = rangeNoise(points);
    image.between_lines = samplingOf(points).structure != ScanStructure::kEven;
    rays = plausibleRays(points, image);
    surface = reducedBy(voxel, points);
    tree = PointTree(surface, num_threads);
    const Points patches = reducedBy(kNormalVoxels * voxel, surface);
    normals = estimateNormals(surface,
                              patches,
                              PointTree(patches, num_threads),
                              kNormalNeighbours,
                              num_threads);
    seen.rays = &rays;
    seen.surface = &surface;
    seen.normals = &normals;
    seen.tree = &tree;
    seen.voxel = voxel;
  }
};

MovingScans::MovingScans(const MovingPointsOptions& options) : options_(options)
{
  options_.validate();
}

void
MovingScans::setVoxel(const std::optional<double>& voxel)
{
  ScanParameterOptions rule;
  rule.voxel = voxel;
  rule.validate();
  voxel_ = voxel;
}

void
MovingScans::setNumberOfThreads(unsigned int num_threads)
{
  options_.num_threads = num_threads;
  observers_.reset();
}

std::size_t
MovingScans::add(const Points& measured,
                 const Eigen::Isometry3d& T_world_scan,
                 const PoseSigma& sigma,
                 const Eigen::Vector3f& origin)
{
  require(origin.allFinite(), "origin of the rays", origin.transpose(), "finite");
  std::vector<SeenScan> poses(size() + 1); // checks both arguments before any work
  poses.back().T_world_scan = T_world_scan;
  poses.back().sigma = sigma;
  (void)MovingPoints(std::move(poses));
  const auto scan =
      std::make_shared<Kept>(origin, measured, voxel_, options_.num_threads);
  scan->seen.T_world_scan = T_world_scan;
  scan->seen.T_world_scan.translate(origin.cast<double>());
  scan->seen.sigma = sigma;
  scans_.push_back(scan);
  observers_.reset();
  return scans_.size() - 1;
}

const MovingScans::Kept&
MovingScans::kept(std::size_t scan) const
{
  require(scan < scans_.size(), "scan", scan, "one of " + std::to_string(size()));
  return *scans_[scan];
}

double
MovingScans::voxel(std::size_t scan) const
{
  return kept(scan).voxel;
}

const MovingPoints&
MovingScans::observers()
{
  if (!observers_) {
    std::vector<SeenScan> seen;
    for (const auto& scan : scans_)
      seen.push_back(scan->seen);
    observers_ = std::make_shared<const MovingPoints>(std::move(seen), options_);
  }
  return *observers_;
}

bool
MovingScans::isBlind()
{
  return observers().isBlind();
}

std::vector<PointMotion>
MovingScans::motion(std::size_t scan, const Points& measured)
{
  const Kept& observed = kept(scan);
  Points points = seenFrom(observed.origin, measured);
  maskOutOfRange(observed.min_range, observed.max_range, points);
  return observers().classify(scan, points);
}

} // namespace pcl6d
