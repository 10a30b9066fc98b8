// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/scan_reader.h>

#include <string>
#include <utility>
#include <vector>

namespace pcl6d::app {

/** \brief Counts in how many scans each thing was not kept, for one line each. */
class LossTally {
public:
  /** \brief Adds what reading a scan left out, and what writing it lost. */
  void
  addScan(const ScanCloud& scan, const std::vector<std::string>& losses);

  /** \brief Adds something that does not belong to a scan. */
  void
  add(const std::string& loss);

  /** \brief Prints to stdout, in the order in which the things came up. */
  void
  print() const;

private:
  void
  count(const std::string& loss);

  std::size_t scans_ = 0;
  std::size_t dropped_points_ = 0;
  std::vector<std::pair<std::string, std::size_t>> of_scans_;
  std::vector<std::string> others_;
};

} // namespace pcl6d::app
