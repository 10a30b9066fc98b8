// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/placed_scans.h"
#include "localize/known_map.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/fingerprint.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/run/registered_scans.h>

#include <algorithm>

namespace pcl6d::app {

namespace {
RunFolder
openRun(const std::string& path)
{
  if (!std::filesystem::exists(std::filesystem::path(path) / "summary.json"))
    throw IoFailed(path +
                   ": holds no run of pcl_slam6d (no summary.json); RUN comes first, "
                   "then the scans");
  return RunFolder::finished(path, "the run was interrupted; start the run again");
}
} // namespace

KnownMap::KnownMap(const LocalizeSettings& s, const ProgressCallback& show)
: run_(openRun(s.run)), places_(placedScans(run_.summary()))
{
  if (places_.empty())
    throw IoFailed(s.run + ": no scan of the run has a pose");
  ScanParameterOptions given = s.parameters;
  given.min_range = given.min_range.value_or(lengthOf("min-range"));
  given.max_range = given.max_range.value_or(lengthOf("max-range"));
  given.voxel = given.voxel.value_or(lengthOf("voxel"));
  parameters_ = deriveScanParameters(given, {run_.readScan(places_.front())});
  prepared_.emplace(places_.size(), parameters_, 1);
  fingerprints_.resize(places_.size());
  constexpr std::size_t kBatch = 8; // between calls of show
  for (std::size_t begin = 0; begin < places_.size(); begin += kBatch) {
    const std::size_t end = std::min(begin + kBatch, places_.size());
    parallelFor(end - begin, s.num_threads, [&](std::size_t k) {
      const std::size_t i = begin + k;
      const Points points = run_.readScan(places_[i]);
      fingerprints_[i] = fingerprintOf(points);
      prepared_->set(i, points, run_.summary().scans[places_[i]].file);
    });
    show({"reading", end, places_.size()});
  }
  for (const VerifiedScan& scan : prepared_->scans())
    placeable_.emplace_back(scan);
}

double
KnownMap::lengthOf(const char* name) const
{
  return lengthOfRun(run_.summary(), name, run_.path() / "summary.json");
}

std::vector<KnownScan>
KnownMap::scans() const
{
  std::vector<KnownScan> known;
  for (std::size_t i = 0; i < places_.size(); ++i)
    known.push_back({&placeable_[i],
                     Eigen::Translation3d(-worldOffset()) *
                         run_.summary().scans[places_[i]].T_world_scan});
  return known;
}

PreparedScans
KnownMap::prepare(const Points& points, const std::string& name) const
{
  PreparedScans scan(1, parameters_);
  scan.set(0, points, name);
  return scan;
}

std::set<std::size_t>
KnownMap::copiesOf(const Points& points) const
{
  std::set<std::size_t> copies;
  const std::uint64_t sum = fingerprintOf(points);
  for (std::size_t i = 0; i < fingerprints_.size(); ++i)
    if (fingerprints_[i] == sum)
      copies.insert(i);
  return copies;
}

} // namespace pcl6d::app
