// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/input/drive_closing.h"

#include <pcl6d/common/error.h>
#include <pcl6d/global_registration/drive_loops.h>
#include <pcl6d/io/text.h>
#include <pcl6d/verification/prepared_scans.h>

#include <algorithm>
#include <deque>
#include <vector>

namespace pcl6d::app {

namespace {
/** Number of evenly chosen scans from which range gate and voxel are derived. */
constexpr std::size_t kLookedAt = 4;

std::vector<Eigen::Isometry3d>
posesOf(const ScanFolder& folder)
{
  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t i = 0; i < folder.size(); ++i)
    poses.push_back(folder.initialPose(i));
  return poses;
}

ScanParameters
parametersOf(const Settings& settings, const ScanFolder& folder)
{
  std::vector<Points> points;
  const std::size_t count = std::min(kLookedAt, folder.size());
  for (std::size_t k = 0; k < count; ++k)
    points.push_back(folder.read(k * folder.size() / count).points);
  return deriveScanParameters(settings.slam, points);
}
} // namespace

void
closeLoopsOfDrive(const Settings& settings,
                  ScanFolder& folder,
                  const ProgressCallback& progress)
{
  const std::vector<Eigen::Isometry3d> poses = posesOf(folder);
  const ScanParameters parameters = parametersOf(settings, folder);
  DriveLoopOptions options;
  options.num_threads = settings.slam.num_threads;
  options.progress = progress;
  if (!mayHoldDriveLoops(poses, parameters.median_range, options))
    return;
  PreparedScans prepared(folder.size(), parameters, options.num_threads);
  try {
    for (std::size_t i = 0; i < folder.size(); ++i) {
      prepared.set(i, folder.read(i).points, folder.title(i));
      progress({"preparing", i + 1, folder.size()});
    }
  } catch (const ComputeFailed&) {
    return; // a sweep of a few points; the registration reports its name
  }
  std::deque<PlaceableScan> scans;
  for (const VerifiedScan& scan : prepared.scans())
    scans.emplace_back(scan);
  const DriveLoops found = closeDriveLoops(scans, poses, options);
  const auto counting = static_cast<std::size_t>(
      std::count_if(found.loops.begin(), found.loops.end(), [](const DriveLoop& loop) {
        return loop.counts;
      }));
  if (counting == 0)
    return;
  folder.replacePoses(found.poses,
                      folder.poseSource() + ", " + text::counted(counting, "loop") +
                          " closed by place recognition");
}

} // namespace pcl6d::app
