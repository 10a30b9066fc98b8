// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/progress_bar.h"

#include <pcl6d/io/scan_reader.h>

#include <string>
#include <utility>
#include <vector>

namespace pcl6d::app {

/** \brief Counts the scans affected by each kind of loss, for one line per kind. */
class LossTally {
public:
  /** \brief Adds the losses of reading and writing a scan.
   * \param[in] name of the scan, for the warning if the scan is empty */
  void
  addScan(const std::string& name,
          const ScanCloud& scan,
          const std::vector<std::string>& losses);

  /** \brief Adds a loss that does not belong to a scan. */
  void
  add(const std::string& loss);

  /** \brief Prints to stdout, in the order of first occurrence. */
  void
  print() const;

  /** \brief Warns of scans without points, which indicate a fault of the scanner.
   * \return the exit code: kDoubtful with empty scans */
  int
  evaluate(ProgressBar& bar) const;

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
