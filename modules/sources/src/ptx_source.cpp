// SPDX-License-Identifier: BSD-3-Clause
#include "ptx_source.h"

#include <pcl6d/common/require.h>

#include <cstdio>

namespace pcl6d {

PtxSource::PtxSource(const std::filesystem::path& path)
: path_(path), places_(listPtxScans(path))
{
  const std::string stem = path.stem().string();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    char number[32];
    std::snprintf(number, sizeof number, "_%03zu", i);
    SourceScan scan;
    scan.name = places_.size() == 1 ? stem : stem + number;
    scan.pose = places_[i].T_world_scan;
    scan.num_points = std::uint64_t{places_[i].columns} * places_[i].rows;
    scans_.push_back(std::move(scan));
  }
}

ScanCloud
PtxSource::read(std::size_t i) const
{
  require(i < places_.size(), "scan", i, "below " + std::to_string(places_.size()));
  return readPtxScan(path_, places_[i]);
}

} // namespace pcl6d
