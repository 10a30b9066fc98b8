// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/input/kept_clouds.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/fingerprint.h>

#include <utility>

namespace pcl6d::app {

namespace {
std::uint64_t
fingerprintOf(const pcl::PCLPointCloud2& cloud)
{
  Fingerprint sum;
  sum.add(cloud.width);
  sum.add(cloud.height);
  for (const auto byte : cloud.data)
    sum.add(static_cast<std::uint32_t>(byte));
  return sum.value();
}
} // namespace

void
KeptClouds::add(pcl::PCLPointCloud2 cloud)
{
  Kept kept;
  kept.in_memory = used_ + cloud.data.size() <= budget_;
  if (kept.in_memory) {
    used_ += cloud.data.size();
    kept.cloud = std::move(cloud);
  }
  else
    kept.fingerprint = fingerprintOf(cloud);
  clouds_.push_back(std::move(kept));
}

pcl::PCLPointCloud2
KeptClouds::take(std::size_t i, const std::optional<MotionWithinScan>& motion)
{
  pcl::PCLPointCloud2 cloud = takeRaw(i);
  if (motion)
    scans_.undoMotion(*motion, i, cloud);
  return cloud;
}

pcl::PCLPointCloud2
KeptClouds::takeRaw(std::size_t i)
{
  Kept kept = std::exchange(clouds_.at(i), {});
  if (kept.in_memory)
    return std::move(kept.cloud);
  pcl::PCLPointCloud2 cloud = scans_.read(i).cloud;
  if (fingerprintOf(cloud) != kept.fingerprint)
    throw IoFailed(scans_.folder().title(i) + ": was changed after the first reading");
  return cloud;
}

} // namespace pcl6d::app
