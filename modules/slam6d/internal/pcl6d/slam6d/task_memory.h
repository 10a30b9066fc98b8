// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/slam6d/slam6d_result.h>

#include <cstdint>
#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A cache of task results, queried by Slam6D before each task and filled afterwards: an
 * interrupted run continues from it. Tasks are the matching of a scan, and the graph stage (loops
 * and relaxation). The name of a task is a hash of its inputs: points and initial poses of the
 * scans up to it, parameters, given links, and poses relaxed by an earlier optimize(). Options are
 * not part of the hash; a cache that outlives the process must compare them. \ingroup slam6d */
class TaskMemory {
public:
  virtual ~TaskMemory() = default;

  /** \return the result of a scan, if known \param[in] scan index
   * \param[in] inputs the name of the task */
  virtual std::optional<ScanResult>
  matched(std::size_t scan, std::uint64_t inputs) = 0;

  virtual void
  keepMatched(std::size_t scan, std::uint64_t inputs, const ScanResult& result) = 0;

  /** \return the result after loops and relaxation, without verification, if known */
  virtual std::optional<Slam6DResult>
  relaxed(std::uint64_t inputs) = 0;

  virtual void
  keepRelaxed(std::uint64_t inputs, const Slam6DResult& result) = 0;
};

} // namespace pcl6d
