// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/run_scans.h"

#include <pcl/PCLPointCloud2.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pcl6d::app {

/** \brief The clouds of a run from reading to writing: in memory as far as a budget goes, the
 * others are read again when they are written. */
class KeptClouds {
public:
  /** Keeps a reference to the scans. \param[in] budget [bytes] of the clouds in memory */
  KeptClouds(RunScans& scans, std::size_t budget) : scans_(scans), budget_(budget) {}

  /** \brief The next cloud, as it was read. */
  void
  add(pcl::PCLPointCloud2 cloud);

  std::size_t
  size() const
  {
    return clouds_.size();
  }

  /** \brief Gives a cloud up. \param[in] motion that is undone, if it was found
   * \throws IoFailed its file cannot be read again, or holds
   * something else now */
  pcl::PCLPointCloud2
  take(std::size_t i, const std::optional<MotionWithinScan>& motion = {});

private:
  pcl::PCLPointCloud2
  takeRaw(std::size_t i);

  struct Kept {
    pcl::PCLPointCloud2 cloud;     ///< without data if it is to be read again
    std::uint64_t fingerprint = 0; ///< of what is to be read again
    bool in_memory = false;
  };

  RunScans& scans_;
  std::size_t budget_;
  std::size_t used_ = 0; ///< [bytes]
  std::vector<Kept> clouds_;
};

} // namespace pcl6d::app
