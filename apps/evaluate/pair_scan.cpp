// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/pair_scan.h"

#include <pcl6d/common/error.h>
#include <pcl6d/slam6d/scan_preparation.h>

namespace pcl6d::app {

NearScan
readNear(const std::string& file, ScanFormat format, ProgressBar& bar)
{
  NearScan scan = readNearScan(file, format);
  if (scan.points.size() < 3)
    throw IoFailed(tooFewPoints(file, scan.points.size(), "with finite coordinates") +
                   " (" + std::to_string(scan.dropped) + " without)");
  if (!scan.description.empty())
    bar.warn(file + ": " + scan.description);
  return scan;
}

Eigen::Isometry3d
nearPose(const Eigen::Isometry3d& T_a_b, const NearScan& a, const NearScan& b)
{
  return Eigen::Translation3d(-a.offset) * T_a_b * Eigen::Translation3d(b.offset);
}

Eigen::Isometry3d
farPose(const Eigen::Isometry3d& T_a_b, const NearScan& a, const NearScan& b)
{
  return Eigen::Translation3d(a.offset) * T_a_b * Eigen::Translation3d(-b.offset);
}

} // namespace pcl6d::app
