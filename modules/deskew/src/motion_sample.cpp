// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/voxel_key.h>
#include <pcl6d/deskew/motion_sample.h>
#include <pcl6d/filters/voxel_reduction.h>

#include <pcl/types.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace pcl6d::deskew {

namespace {
constexpr std::size_t kPointsPerBlock = 256;
constexpr double kClose = 1.3; ///< accepted ratio of the drawn to the wanted number
constexpr int kTries = 4;
} // namespace

TimedPoints
MotionSampler::draw(const TimedPoints& scan, std::size_t count)
{
  pcl::Indices chosen;
  for (int tried = 0; tried < kTries; ++tried) {
    chosen = VoxelGroups(scan.points, voxel_).chooseRandom(1, seed_);
    const double ratio =
        static_cast<double>(chosen.size()) / static_cast<double>(count);
    if (ratio < kClose && (ratio * kClose > 1 || scan.points.size() < count))
      break;
    voxel_ *= std::clamp(std::sqrt(ratio), 0.25, 4.0); // surfaces: their area counts
  }
  std::sort(chosen.begin(), chosen.end()); // in order of measurement: both halves cover
                                           // equal times
  TimedPoints sample;
  for (const auto i : chosen) {
    sample.points.push_back(scan.points[i]);
    sample.times.push_back(scan.times[i]);
  }
  return sample;
}

TimedPoints
halfOf(const TimedPoints& sample, std::size_t first)
{
  TimedPoints half;
  for (std::size_t i = first; i < sample.points.size(); i += 2) {
    half.points.push_back(sample.points[i]);
    half.times.push_back(sample.times[i]);
  }
  return half;
}

std::vector<double>
fitOf(const SurfaceMap& map,
      const std::vector<Eigen::Vector3d>& world,
      double noise,
      unsigned int num_threads)
{
  std::vector<double> fit(world.size(), 0);
  parallelBlocks(world.size(), kPointsPerBlock, num_threads, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const SurfacePlane* plane = map.planeAt(world[i]);
      if (!plane)
        continue;
      const double off = plane->normal.dot(world[i] - plane->mean);
      fit[i] = 1 / (1 + off * off / (plane->variance + noise * noise));
    }
  });
  return fit;
}

double
meanOf(const std::vector<double>& values)
{
  return values.empty() ? 0
                        : std::accumulate(values.begin(), values.end(), 0.0) /
                              static_cast<double>(values.size());
}

AgreementChange
changeOf(const std::vector<double>& before,
         const std::vector<double>& after,
         const Points& points,
         double cube)
{
  AgreementChange change;
  if (before.empty())
    return change;
  const auto count = static_cast<double>(before.size());
  change.before = meanOf(before);
  change.after = meanOf(after);
  const double gain = change.after - change.before;
  std::map<VoxelKey, double> cubes; // what the points of a cube gain beyond the mean
  for (std::size_t i = 0; i < before.size(); ++i)
    cubes[voxelKey(points[i], cube)] += after[i] - before[i] - gain;
  double squares = 0;
  for (const auto& [key, sum] : cubes)
    squares += sum * sum;
  change.deviation = std::sqrt(squares) / count;
  return change;
}

AgreementChange
pooled(const std::vector<AgreementChange>& changes)
{
  AgreementChange all;
  if (changes.empty())
    return all;
  const auto count = static_cast<double>(changes.size());
  for (const AgreementChange& change : changes) {
    all.before += change.before / count;
    all.after += change.after / count;
    all.deviation += change.deviation * change.deviation / (count * count);
  }
  all.deviation = std::sqrt(all.deviation);
  return all;
}

} // namespace pcl6d::deskew
