// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/earlier_run.h"

#include <pcl6d/common/error.h>

namespace pcl6d::app {

EarlierRun::EarlierRun(const std::filesystem::path& folder)
: folder_(folder), summary_(readRunSummary(folder / "summary.json"))
{
  const std::string file = (folder / "summary.json").string();
  if (summary_.generator != "pcl_slam6d")
    throw IoFailed(file + ": is of '" + summary_.generator + "', not of pcl_slam6d");
  if (!summary_.complete)
    throw IoFailed(file +
                   ": the run was interrupted; run it again, then go on with it");
}

void
EarlierRun::putBefore(ScanFolder& folder) const
{
  folder.continueRun(folder_, summary_);
}

ScanResult
EarlierRun::scan(std::size_t i) const
{
  const RunResult::ScanEntry& entry = summary_.scans.at(i);
  ScanResult scan;
  scan.initial_pose = entry.initial_pose;
  scan.T_world_scan = entry.T_world_scan;
  scan.covariance = entry.covariance;
  try {
    scan.state = scanStateFromName(entry.state);
    scan.status = statusFromName(entry.status);
    scan.start = initialGuessFromName(entry.start);
  } catch (const BadArgument& e) {
    throw IoFailed((folder_ / "summary.json").string() + ": " + entry.file + ": " +
                   e.what());
  }
  scan.pairs = entry.pairs;
  scan.rms = entry.rms;
  scan.overlap = entry.overlap;
  scan.iterations = entry.iterations;
  scan.correction = entry.correction;
  scan.reason = entry.reason;
  return scan;
}

std::size_t
EarlierRun::dropped(std::size_t i) const
{
  return summary_.scans.at(i).dropped;
}

} // namespace pcl6d::app
