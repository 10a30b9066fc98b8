// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/run_result.h>
#include <pcl6d/run/run_folder.h>

#include <cstddef>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief The finished runs whose scans are taken over as they are: the one that goes on
 * (--continue), or those that are joined (--join). */
struct EarlierRuns {
  /** A scan, by its run and its place in the summary of that. */
  struct Taken {
    std::size_t run = 0;
    std::size_t place = 0;
  };

  std::vector<RunFolder> runs;
  std::vector<Taken> scans;       ///< the first ones of the folder, in their order
  std::vector<std::string> notes; ///< what is to be said of them, for people

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
  /** \return the result of a scan. Where runs are joined, one that nothing ties to its run
   * counts as predicted: its place is looked for anew */
  ScanResult
  resultOf(std::size_t scan) const;
};

} // namespace pcl6d::app
