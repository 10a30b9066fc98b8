// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace pcl6d::app {

class OptionTable;

/** \brief `--memory SIZE` of a program: what its process may hold in memory at a time. */
struct MemoryOption {
  std::size_t bytes = 0; ///< 0: not given

  /** \brief Adds the row to a table. */
  void
  addTo(OptionTable& table);
};

/** \return [bytes] of "1G", "500M", "1.5 GiB", "800000k": powers of 1024; without a unit, bytes
 * \throws UsageError no size, not > 0, or more than the machine has */
std::size_t
memorySize(const std::string& text);

/** \return [bytes] of the machine, or of the container if that has less */
std::size_t
machineMemory();

/** \brief Bounds the resident size of the process, whatever it works on.
 *
 * While the heap takes less than two fifths of the budget, memory comes from the heap. From
 * then on, every block of 2 kB and more lies in a file without a name (ScratchArena), and when
 * the process comes near its budget, it lets go of the pages of all of them: those that are
 * used come back at once, mostly from the system's cache, which is no part of the process.
 * Places of blocks do not change, so that nothing but time depends on the budget.
 *
 * Works by the operators new and delete of the programs; what libraries take by malloc, such
 * as pictures, is not moved, but counted. */
class MemoryBudget {
public:
  /** \brief Starts to watch, until the process ends: of several, the first counts.
   * \param[in] option not given: half of the machine's memory
   * \param[in] folder for the file, if it comes to one; if it is not there, the nearest above
   * it */
  MemoryBudget(const MemoryOption& option, const std::filesystem::path& folder);

  /** \return [bytes] */
  std::size_t
  bytes() const;

  /** \brief Makes sure that work on a scan fits in. \param[in] points of it
   * \throws IoFailed it does not; tells what is needed */
  void
  require(std::size_t points, const std::string& scan) const;

  /** \return [bytes] that lie in the file */
  std::size_t
  scratch() const;
};

} // namespace pcl6d::app
