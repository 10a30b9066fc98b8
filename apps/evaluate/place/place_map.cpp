// SPDX-License-Identifier: BSD-3-Clause
#include "common/unit_guess.h"
#include "evaluate/place/place_map.h"
#include "evaluate/placed_scans.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/fingerprint.h>
#include <pcl6d/common/median.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/run/registered_scans.h>

#include <algorithm>
#include <filesystem>
#include <limits>

namespace pcl6d::app {

namespace {
/** Number of scans of a run, evenly chosen, for estimating the range of its scans. */
constexpr std::size_t kMeasured = 4;

RunFolder
openMap(const std::string& path)
{
  if (!std::filesystem::exists(std::filesystem::path(path) / "summary.json"))
    throw IoFailed(path + ": is a folder, but no run of pcl_slam6d (no summary.json)");
  return RunFolder::finished(path, "the run was interrupted; start the run again");
}

void
requireSameUnits(const PlaceSettings& s,
                 const Points& scan,
                 const std::vector<Points>& map)
{
  std::vector<double> ranges;
  const std::size_t count = std::min(kMeasured, map.size());
  for (std::size_t k = 0; k < count; ++k)
    ranges.push_back(medianRange(map[k * map.size() / count]));
  const std::string guess =
      unitGuess(s.scan_a, medianRange(scan), s.scan_b, upperMedian(ranges));
  if (!guess.empty())
    throw IoFailed(guess);
}
} // namespace

PlaceMap::PlaceMap(const PlaceSettings& settings,
                   const NearScan& scan,
                   const ProgressCallback& show)
: run_(openMap(settings.scan_b)), places_(placedScans(run_.summary()))
{
  prepare(settings, scan, read(settings, scan, show));
}

double
PlaceMap::lengthOf(const char* name) const
{
  return lengthOfRun(run_.summary(), name, run_.path() / "summary.json");
}

Eigen::Isometry3d
PlaceMap::pose(std::size_t i) const
{
  return Eigen::Translation3d(-run_.summary().world_offset) * result(i).T_world_scan;
}

/** \return the points of the map's scans within the range gate of the run */
std::vector<Points>
PlaceMap::read(const PlaceSettings& s,
               const NearScan& scan,
               const ProgressCallback& show)
{
  const std::uint64_t own = fingerprintOf(scan.points);
  const double least = s.parameters.min_range.value_or(lengthOf("min-range"));
  const double most = s.parameters.max_range.value_or(lengthOf("max-range"));
  std::vector<Points> points(places_.size());
  std::vector<char> is_same(places_.size()); // written by several threads
  // small enough to show progress and to be interrupted
  constexpr std::size_t kBatch = 8;
  for (std::size_t begin = 0; begin < places_.size(); begin += kBatch) {
    const std::size_t end = std::min(begin + kBatch, places_.size());
    parallelFor(end - begin, s.search.num_threads, [&](std::size_t k) {
      const Points all = run_.readScan(places_[begin + k]);
      is_same[begin + k] = fingerprintOf(all) == own;
      points[begin + k] = gateByRange(all, least, most);
    });
    show({"reading", end, places_.size()});
  }
  for (std::size_t i = places_.size(); i-- > 0;)
    if (is_same[i]) {
      same_as_ = result(i).file;
      places_.erase(places_.begin() + static_cast<std::ptrdiff_t>(i));
      points.erase(points.begin() + static_cast<std::ptrdiff_t>(i));
    }
  if (places_.empty())
    throw IoFailed(run_.path().string() + ": holds no scan " +
                   (same_as_.empty() ? "with a reliable pose" : "but this one"));
  return points;
}

/** Gate and voxel: from the run, or suited to the scan if coarser. */
void
PlaceMap::prepare(const PlaceSettings& s,
                  const NearScan& scan,
                  const std::vector<Points>& map)
{
  ScanParameters all = deriveScanParameters(s.parameters, {scan.points});
  const Points gated =
      gateByRange(scan.points, all.min_range.value, all.max_range.value);
  requireSameUnits(s, gated, map);
  if (!s.parameters.voxel)
    all.voxel.value = std::max(all.voxel.value, lengthOf("voxel"));
  all.min_range.value = 0; // each has been gated by itself
  all.max_range.value = std::numeric_limits<double>::infinity();
  prepared_.emplace(map.size() + 1, all, 1);
  parallelFor(map.size() + 1, s.search.num_threads, [&](std::size_t i) {
    if (i == map.size())
      prepared_->set(i, gated, s.scan_a);
    else
      prepared_->set(i, map[i], result(i).file);
  });
  for (const VerifiedScan& one : prepared_->scans())
    placeable_.emplace_back(one);
}

} // namespace pcl6d::app
