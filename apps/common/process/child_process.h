// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace pcl6d::app {

/** \brief Exit status and resource usage of a process. */
struct ProcessEnd {
  int exit_code = 0;         ///< 0 if a signal ended the process
  int signal = 0;            ///< signal that ended the process; 0: a normal end
  bool timed_out = false;    ///< ended because of the time limit
  double seconds = 0;        ///< of the clock, to within 5 ms
  double cpu_seconds = 0;    ///< [s] user and system time of the process, all threads
  double peak_memory_mb = 0; ///< largest resident size [MB]
};

/** \brief What to run. */
struct ProcessStart {
  std::filesystem::path program;
  std::vector<std::string> arguments;
  std::filesystem::path log;    ///< gets stdout and stderr, in their order
  double time_limit = 0;        ///< [s] 0: none
  std::size_t memory_limit = 0; ///< [bytes] limit of the data segment; 0: no limit
};

/** \brief A program in its own process group, which ends with this process, even if
 * SIGKILL ends this process. */
class ChildProcess {
public:
  /** \throws IoFailed the log cannot be written, or the program not be run */
  explicit ChildProcess(const ProcessStart& start);
  /** \brief Kills the group if it still runs. */
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess&
  operator=(const ChildProcess&) = delete;

  /** \brief Checks whether the process has ended; to be called every few milliseconds.
   * Past the time limit, or after stop(), the group gets SIGTERM, and SIGKILL if it
   * still runs kGrace later. */
  std::optional<ProcessEnd>
  poll();

  /** \brief Asks the group to end. */
  void
  stop();

  static constexpr std::chrono::seconds kGrace{5};

private:
  using Clock = std::chrono::steady_clock;

  pid_t pid_ = -1;
  double time_limit_;
  Clock::time_point begin_;
  std::optional<Clock::time_point> asked_; ///< time of the request to end
  bool timed_out_ = false;
};

} // namespace pcl6d::app
