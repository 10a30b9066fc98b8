// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/run_result.h>
#include <pcl6d/run/run_folder.h>

#include <cstddef>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief The finished runs whose scans are taken over: the continued run (--continue), or the
 * joined runs (--join). */
struct EarlierRuns {
  /** A scan, by its run and its index in the run's summary. */
  struct Taken {
    std::size_t run = 0;
    std::size_t place = 0;
  };

  std::vector<RunFolder> runs;
  std::vector<Taken> scans;       ///< first scans of the folder, in order
  std::vector<std::string> notes; ///< messages about the runs, for people

  bool
  empty() const
  {
    return runs.empty();
  }
  /** \return whether runs are joined */
  bool
  areJoined() const
  {
    return runs.size() > 1;
  }
  /** \return the result of a scan. In joined runs, a scan disconnected from its run counts as
   * predicted: its pose is searched for again */
  ScanResult
  resultOf(std::size_t scan) const;
};

} // namespace pcl6d::app
