// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/progress.h>
#include <pcl6d/common/work_sharing.h>
#include <pcl6d/slam6d/slam6d.h>
#include <pcl6d/slam6d/task_memory.h>

#include <atomic>

namespace pcl6d::slam6d {

/** \brief Thrown by SlamContext::report() after Slam6D::cancel(), handled by the pipeline. A stage
 * that catches it must rethrow it, or end as kStopped. */
struct Cancelled {};

/** \brief The environment of a run, passed to every stage. */
struct SlamContext {
  ProgressCallback progress;
  Slam6D::Observer observer; ///< of registered scans
  WorkSharing* sharing = nullptr;
  TaskMemory* memory = nullptr;
  std::atomic<bool> cancelled{false};
  bool is_shared = false; ///< all processes run the present stage, and stop together

  bool
  isFirst() const
  {
    return !sharing || sharing->isFirst();
  }

  /** \brief Reports progress. \throws Cancelled the run is to stop */
  void
  report(const Progress& now)
  {
    if (progress)
      progress(now);
    const bool stop = cancelled.exchange(false);
    if (sharing && is_shared ? sharing->fromFirst(stop) : stop)
      throw Cancelled();
  }

  /** \brief Reports all scans to the observer. */
  void
  observe(const Slam6DResult& result) const
  {
    for (std::size_t i = 0; observer && i < result.scans.size(); ++i)
      observer(i, result.scans[i]);
  }
};

} // namespace pcl6d::slam6d
