// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/fingerprint.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/verification/prepared_scans.h>

#include <sstream>

namespace pcl6d {

namespace {
/** Neighbours of a normal, and voxels of its patch, like in matching. */
constexpr std::size_t kNormalNeighbours = 10;
constexpr double kNormalPatchVoxels = 3;

Points
gated(const Points& measured, const std::string& name, const ScanParameters& p)
{
  Points points = gateByRange(measured, p.min_range.value, p.max_range.value);
  if (points.size() >= 3)
    return points;
  std::ostringstream message;
  message << name << ": " << points.size() << " points within the range gate of "
          << p.min_range.value << " to " << p.max_range.value
          << " m, but at least 3 are needed";
  throw ComputeFailed(message.str());
}

Points
reduced(const Points& points, const std::string& name, double voxel)
{
  ReductionOptions options;
  options.voxel = voxel;
  try {
    return reducePoints(points, options);
  } catch (const BadArgument& e) {
    throw ComputeFailed(name + ": " + e.what() + " (see voxel and max range)");
  }
}
} // namespace

PreparedScans::PreparedScans(std::size_t count,
                             const ScanParameters& parameters,
                             unsigned int num_threads)
: parameters_(parameters)
, num_threads_(num_threads)
, surfaces_(count)
, scans_(count)
, fingerprints_(count)
{}

void
PreparedScans::set(std::size_t place, const Points& measured, const std::string& name)
{
  const double voxel = parameters_.voxel.value;
  const Points points = gated(measured, name, parameters_);
  IcpModel::Options options;
  options.normals = true;
  options.neighbours = kNormalNeighbours;
  options.normal_voxel = kNormalPatchVoxels * voxel;
  options.num_threads = num_threads_;
  surfaces_.at(place).emplace(reduced(points, name, voxel), options);
  scans_[place] = VerifiedScan(points, *surfaces_[place], voxel);
  fingerprints_[place] = fingerprintOf(points);
}

std::size_t
PreparedScans::firstLike(std::size_t place) const
{
  std::size_t first = 0;
  while (fingerprints_[first] != fingerprints_[place])
    ++first;
  return first;
}

} // namespace pcl6d
