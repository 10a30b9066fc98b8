// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/progress_bar.h"

#include <pcl6d/io/scan_reader.h>

#include <string>
#include <utility>
#include <vector>

namespace pcl6d::app {

/** \brief Counts in how many scans each thing was not kept, for one line each. */
class LossTally {
public:
  /** \brief Adds what reading a scan left out, and what writing it lost.
   * \param[in] name of the scan, for the warning if it has no points */
  void
  addScan(const std::string& name,
          const ScanCloud& scan,
          const std::vector<std::string>& losses);

  /** \brief Adds something that does not belong to a scan. */
  void
  add(const std::string& loss);

  /** \brief Prints to stdout, in the order in which the things came up. */
  void
  print() const;

  /** \brief Warns of scans without points, which a scanner that works does not make.
   * \return the exit code: kDoubtful if there are any */
  int
  judge(ProgressBar& bar) const;

private:
  void
  count(const std::string& loss);

  std::size_t scans_ = 0;
  std::vector<std::string> empty_scans_;
  std::size_t dropped_points_ = 0;
  std::vector<std::pair<std::string, std::size_t>> of_scans_;
  std::vector<std::string> others_;
};

} // namespace pcl6d::app
