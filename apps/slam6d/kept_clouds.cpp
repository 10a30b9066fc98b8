// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/kept_clouds.h"

#include <pcl6d/common/error.h>

#include <unistd.h>
#include <utility>

namespace pcl6d::app {

void
KeptClouds::add(pcl::PCLPointCloud2 cloud)
{
  Kept kept;
  kept.points = static_cast<std::size_t>(cloud.width) * cloud.height;
  kept.in_memory = used_ + cloud.data.size() <= budget_;
  if (kept.in_memory) {
    used_ += cloud.data.size();
    kept.cloud = std::move(cloud);
  }
  clouds_.push_back(std::move(kept));
}

pcl::PCLPointCloud2
KeptClouds::take(std::size_t i)
{
  Kept kept = std::exchange(clouds_.at(i), {});
  if (kept.in_memory)
    return std::move(kept.cloud);
  pcl::PCLPointCloud2 cloud = scans_.read(i).cloud;
  const std::size_t points = static_cast<std::size_t>(cloud.width) * cloud.height;
  if (points != kept.points)
    throw IoFailed(scans_.folder().file(i).string() +
                   ": has changed since it was read (" + std::to_string(points) +
                   " points now, " + std::to_string(kept.points) + " before)");
  return cloud;
}

std::size_t
cloudBudget()
{
  const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGE_SIZE);
  constexpr std::size_t kUnknown = std::size_t{1} << 30;
  if (pages <= 0 || page <= 0)
    return kUnknown;
  return static_cast<std::size_t>(pages) / 4 * static_cast<std::size_t>(page);
}

} // namespace pcl6d::app
