// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

/** \file Processes that may crash, hang and fill memory without harm to others. */
namespace pcl6d::faults {

struct Limits {
  double seconds = 20; ///< of the clock, then it is killed with all that it started
  /** Memory of its own beyond which allocations fail: it protects the machine. What is
   * too much is evaluated by the peak that the system measured. */
  std::size_t memory = std::size_t{3} << 30;
  std::size_t file = std::size_t{1} << 30; ///< size of a file
};

struct Command {
  std::filesystem::path program;
  std::vector<std::string> arguments;
  std::filesystem::path folder;    ///< where it runs
  std::filesystem::path out, err;  ///< files for what it prints
  std::filesystem::path temporary; ///< its TMPDIR
  std::string mark; ///< in its environment, by which its children are known
};

/** \brief How a process ended. */
struct Ended {
  bool timed_out = false;
  int signal = 0;    ///< that ended it; 0: none
  int exit_code = 0; ///< if no signal ended it
  double seconds = 0;
  std::size_t peak_memory = 0; ///< [B] resident, of it or a child of it
};

/** \brief Starts a process in a session of its own, with empty stdin, the locale C, no
 * display and no home. \throws std::runtime_error there is no process to be had */
pid_t
startChild(const Command& command, const Limits& limits);

/** \return its end, from what wait4() says */
Ended
endOf(int status, double peak_kib);

/** \return the ids of children that this process inherited from those with the mark */
std::vector<pid_t>
heirsOf(const std::string& mark);

/** \brief From now on, processes whose parent ends become children of this one. */
void
inheritOrphans();

/** \brief Runs a process and waits. \return its end */
Ended
runToEnd(const Command& command, const Limits& limits);

/** \return the command as a line for a shell */
std::string
shellLine(const Command& command);

} // namespace pcl6d::faults
