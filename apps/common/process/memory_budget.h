// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace pcl6d {
class OptionList;
}

namespace pcl6d::app {

class OptionTable;

/** \brief Option `--memory SIZE` of a program: upper bound of the memory of its process. */
struct MemoryOption {
  std::size_t bytes = 0; ///< 0: not given

  /** \brief Adds the row to a table. */
  void
  addTo(OptionTable& table);

  /** \brief Adds the row to a list of options. */
  void
  describe(OptionList& list);
};

/** \return [bytes] of "1G", "500M", "1.5 GiB", "800000k": powers of 1024; without a unit, bytes
 * \throws UsageError no size, not > 0, or more than the machine has */
std::size_t
memorySize(const std::string& text);

/** \return memory [bytes] of the machine, or of the container if less */
std::size_t
machineMemory();

/** \brief Bounds the resident size of the process, whatever the size of the data.
 *
 * While the heap takes less than two fifths of the budget, memory comes from the heap.
 * From then on, every block of 2 kB and more lies in a file without a name
 * (ScratchArena), and a process near its budget releases the pages of these blocks.
 * Used pages come back at once, mostly from the system's cache, which does not count as
 * memory of the process. Addresses of blocks never change, so the budget affects only
 * run time.
 *
 * Works by the operators new and delete of the programs; memory that libraries take by
 * malloc, such as pictures, is counted but not moved. */
class MemoryBudget {
public:
  /** \brief Starts to watch, until the process ends; only the first instance counts.
   * \param[in] option not given: half of the machine's memory
   * \param[in] folder for the file, if needed; if missing, its nearest existing parent */
  MemoryBudget(const MemoryOption& option, const std::filesystem::path& folder);

  /** \return [bytes] */
  std::size_t
  bytes() const;

  /** \brief Makes sure that work on a scan fits in. \param[in] points number of points
   * of the scan
   * \throws IoFailed the budget is too small; the message tells the memory needed */
  void
  require(std::size_t points, const std::string& scan) const;

  /** \return size of the blocks in the file [bytes] */
  std::size_t
  scratch() const;
};

} // namespace pcl6d::app
