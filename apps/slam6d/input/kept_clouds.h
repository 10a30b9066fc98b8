// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/input/run_scans.h"

#include <pcl/PCLPointCloud2.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pcl6d::app {

/** \brief The clouds of a run from reading to writing: kept in memory within a budget; the rest is
 * read again for writing. */
class KeptClouds {
public:
  /** Keeps a reference to the scans. \param[in] budget [bytes] of the clouds in memory */
  KeptClouds(RunScans& scans, std::size_t budget) : scans_(scans), budget_(budget) {}

  /** \brief Adds the next cloud, as read. */
  void
  add(pcl::PCLPointCloud2 cloud);

  std::size_t
  size() const
  {
    return clouds_.size();
  }

  /** \brief Returns a cloud and drops it here. \param[in] motion for deskewing, if estimated
   * \throws IoFailed its file cannot be read again, or has changed */
  pcl::PCLPointCloud2
  take(std::size_t i, const std::optional<MotionWithinScan>& motion = {});

private:
  pcl::PCLPointCloud2
  takeRaw(std::size_t i);

  struct Kept {
    pcl::PCLPointCloud2 cloud;     ///< without data if not in memory
    std::uint64_t fingerprint = 0; ///< of clouds not in memory
    bool in_memory = false;
  };

  RunScans& scans_;
  std::size_t budget_;
  std::size_t used_ = 0; ///< [bytes]
  std::vector<Kept> clouds_;
};

} // namespace pcl6d::app
