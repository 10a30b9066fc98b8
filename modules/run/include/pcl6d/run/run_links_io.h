// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A row of links.csv: two scans that a run joined, or might have. */
struct RunLink {
  std::size_t from = 0; ///< index NNN of a scan
  std::size_t to = 0;   ///< index NNN of a scan
  std::string kind;     ///< "sequence", "loop", "network", ...
  std::string verdict;  ///< "used", "refused", "odometry"
  std::string reason;   ///< why it is refused; else empty
  double distance = 0;  ///< [m] between the scans
  std::size_t pairs = 0;
  double rms = 0; ///< [m] of the pairs; NaN without pairs
  double overlap = 0;
  double condition = 0;
  double weight = 0; ///< in [0, 1] how much it counts

  /** \return whether it joins the scans */
  bool
  counts() const
  {
    return verdict != "refused";
  }
};

/** \brief Writes links.csv, atomically. \throws IoFailed the file cannot be written
 * \ingroup run */
void
writeRunLinks(const std::filesystem::path& path, const std::vector<RunLink>& links);

/** \brief Reads links.csv by the names of its columns. \throws IoFailed naming file, line,
 * value and rule: unreadable, a column is missing, a row has another number of columns, no
 * number where one belongs \ingroup run */
std::vector<RunLink>
readRunLinks(const std::filesystem::path& path);

} // namespace pcl6d
