// SPDX-License-Identifier: BSD-3-Clause
#include "robust_motion.h"
#include "run_surface.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/moving_objects/run_alignment.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using moving_objects::PlanePair;
using moving_objects::RobustMotion;
using moving_objects::robustMotion;
using moving_objects::RunSurface;

namespace {
/** Number of paired points of a scan: enough to cover its surfaces. */
constexpr std::size_t kPointsOfScan = 2000;

/** [voxels] Points in a cube with this edge count as one: beyond, residuals are correlated by
 * less than 5 % (share/doc/trust.md, Origin of the numbers). */
constexpr double kCubeVoxels = 16;

/** Iterations of matching: pairs are searched again, within half of the distance, until ... */
constexpr int kMostSteps = 12;
/** ... the distance reaches this number of standard deviations of the residuals, or a voxel. */
constexpr double kReachSigmas = 4;

/** Pairs needed to correct the pose of a scan: fewer cover only a corner. */
constexpr std::size_t kFewestPairs = 100;

/** Least cosine between the normals of a pair: 45 degrees. */
constexpr float kFacing = 0.7071F;

/** The points of a scan on the planes of the other run. */
struct ScanPairs {
  std::vector<PlanePair> pairs;
  std::size_t looked_at = 0;
};

ScanPairs
pairsOf(const ComparedScan& scan, const RunSurface& on, double reach)
{
  ScanPairs found;
  const Points& points = *scan.points;
  const auto reach_sq = static_cast<float>(reach * reach);
  const Eigen::Matrix3f R = scan.T_world_scan.linear().cast<float>();
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kPointsOfScan);
  for (std::size_t i = stride / 2; i < points.size(); i += stride) {
    const Eigen::Vector3d place = scan.T_world_scan * points[i].cast<double>();
    const Neighbour near = on.tree().nearest(place.cast<float>(), reach_sq);
    ++found.looked_at;
    if (near.index < 0)
      continue;
    const auto k = static_cast<std::size_t>(near.index);
    const Eigen::Vector3f& normal = on.normals()[k];
    if (normal.isZero(0) || normal.dot(R * (*scan.normals)[i]) < kFacing)
      continue;
    const Eigen::Vector3d n = normal.cast<double>();
    found.pairs.push_back({place, n, n.dot(on.points()[k].cast<double>() - place)});
  }
  return found;
}

/** \return the pairs of each scan */
std::vector<ScanPairs>
pairsOfAll(const ComparedRun& run,
           const RunSurface& on,
           double reach,
           unsigned int num_threads)
{
  std::vector<ScanPairs> found(run.size());
  parallelFor(run.size(), num_threads, [&](std::size_t s) {
    found[s] = pairsOf(run[s], on, reach);
  });
  return found;
}

void
moveAll(const Eigen::Isometry3d& motion, ComparedRun& run)
{
  for (ComparedScan& scan : run)
    scan.T_world_scan = motion * scan.T_world_scan;
}

/** Moves the second run as one rigid piece. */
void
moveInOnePiece(const RunSurface& on,
               const RunAlignmentOptions& options,
               ComparedRun& second,
               RunAlignment& result)
{
  double reach = options.reach * options.voxel;
  for (int k = 0; k < kMostSteps; ++k) {
    std::vector<PlanePair> all;
    std::size_t looked_at = 0;
    for (const ScanPairs& one : pairsOfAll(second, on, reach, options.num_threads)) {
      all.insert(all.end(), one.pairs.begin(), one.pairs.end());
      looked_at += one.looked_at;
    }
    const RobustMotion fit = robustMotion(all, kCubeVoxels * options.voxel);
    result.pairs = fit.pairs;
    result.overlap = looked_at == 0 ? 0
                                    : static_cast<double>(all.size()) /
                                          static_cast<double>(looked_at);
    result.residual = fit.scale;
    if (fit.pairs == 0 || !options.move)
      return;
    moveAll(fit.motion(), second);
    result.T_new_old = fit.motion() * result.T_new_old;
    reach = std::clamp(
        kReachSigmas * fit.scale, options.voxel, std::max(options.voxel, reach / 2));
  }
}

/** Moves each scan separately. \return rms [m] */
double
moveEach(const RunSurface& on, const RunAlignmentOptions& options, ComparedRun& second)
{
  constexpr int kEach = 3; // steps are small now, and pairs hardly change
  std::vector<double> moved_sq(second.size());
  parallelFor(second.size(), options.num_threads, [&](std::size_t s) {
    const Eigen::Vector3d before = second[s].T_world_scan.translation();
    for (int k = 0; k < kEach; ++k) {
      const auto found = pairsOf(second[s], on, options.voxel);
      if (found.pairs.size() < kFewestPairs)
        break;
      const RobustMotion fit = robustMotion(found.pairs, kCubeVoxels * options.voxel);
      second[s].T_world_scan = fit.motion() * second[s].T_world_scan;
    }
    moved_sq[s] = (second[s].T_world_scan.translation() - before).squaredNorm();
  });
  double sum = 0;
  for (const double one : moved_sq)
    sum += one;
  return std::sqrt(sum / static_cast<double>(second.size()));
}

/** Sets the covariances of a run from its fits to the other run. */
void
setCovariances(const RunSurface& on,
               const RunAlignmentOptions& options,
               ComparedRun& run)
{
  std::vector<char> is_known(run.size());
  parallelFor(run.size(), options.num_threads, [&](std::size_t s) {
    const auto found = pairsOf(run[s], on, options.voxel);
    const RobustMotion fit = robustMotion(found.pairs, kCubeVoxels * options.voxel);
    is_known[s] = fit.pairs >= kFewestPairs;
    run[s].covariance = fit.uncertaintyAbout(run[s].T_world_scan.translation());
  });
  const auto traceOf = [&](std::size_t s) {
    return run[s].covariance.topLeftCorner<3, 3>().trace();
  };
  std::size_t largest = 0;
  for (std::size_t s = 1; s < run.size(); ++s)
    if (traceOf(s) > traceOf(largest))
      largest = s;
  for (std::size_t s = 0; s < run.size(); ++s)
    if (!is_known[s])
      run[s].covariance = run[largest].covariance;
}
} // namespace

void
RunAlignmentOptions::validate() const
{
  require(std::isfinite(voxel) && voxel > 0, "voxel", voxel, "finite and > 0");
  require(std::isfinite(reach) && reach > 0, "reach", reach, "finite and > 0");
}

RunAlignment
alignRuns(ComparedRun& first, ComparedRun& second, const RunAlignmentOptions& options)
{
  options.validate();
  requireComplete(first, "first run");
  requireComplete(second, "second run");
  RunAlignment result;
  if (first.empty() || second.empty())
    return result;
  const RunSurface on_first(first, options.voxel, options.num_threads);
  moveInOnePiece(on_first, options, second, result);
  if (result.pairs == 0)
    return result;
  if (options.move)
    result.bending = moveEach(on_first, options, second);
  setCovariances(on_first, options, second);
  const RunSurface on_second(second, options.voxel, options.num_threads);
  setCovariances(on_second, options, first);
  return result;
}

} // namespace pcl6d
