// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/slam6d/slam6d_result.h>

#include <cstdint>
#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What Slam6D asks before each task, and tells after it, so that a run that was
 * interrupted goes on where it was. Tasks: matching of a scan, and the graph stage (loops and
 * relaxation). Each is named by a hash of all that it follows from: points and initial poses
 * of the scans so far, parameters, given links, poses that an earlier optimize() relaxed. Options are not in it; who keeps results
 * longer than a process must compare those. \ingroup slam6d */
class TaskMemory {
public:
  virtual ~TaskMemory() = default;

  /** \return the result of a scan, if it is known \param[in] scan its place
   * \param[in] inputs the name of the task */
  virtual std::optional<ScanResult>
  matched(std::size_t scan, std::uint64_t inputs) = 0;

  virtual void
  keepMatched(std::size_t scan, std::uint64_t inputs, const ScanResult& result) = 0;

  /** \return the result after loops and relaxation, without verification, if it is known */
  virtual std::optional<Slam6DResult>
  relaxed(std::uint64_t inputs) = 0;

  virtual void
  keepRelaxed(std::uint64_t inputs, const Slam6DResult& result) = 0;
};

} // namespace pcl6d
