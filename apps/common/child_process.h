// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace pcl6d::app {

/** \brief How a program ended, and what it used. */
struct ProcessEnd {
  int exit_code = 0;         ///< 0 if a signal ended it
  int signal = 0;            ///< that ended it; 0: it ended by itself
  bool timed_out = false;    ///< it was ended because its time was over
  double seconds = 0;        ///< of the clock, to within 5 ms
  double cpu_seconds = 0;    ///< of all its threads, user and system
  double peak_memory_mb = 0; ///< largest resident size [MB]
};

/** \brief What to run. */
struct ProcessStart {
  std::filesystem::path program;
  std::vector<std::string> arguments;
  std::filesystem::path log;    ///< gets stdout and stderr, in their order
  double time_limit = 0;        ///< [s] 0: none
  std::size_t memory_limit = 0; ///< [bytes] of its data; 0: none
};

/** \brief A program in a process group of its own, which ends with this process, however
 * that ends: also by SIGKILL. */
class ChildProcess {
public:
  /** \throws IoFailed the log cannot be written, or the program not be run */
  explicit ChildProcess(const ProcessStart& start);
  /** \brief Kills what still runs. */
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess&
  operator=(const ChildProcess&) = delete;

  /** \brief Looks whether it has ended; to be called every few milliseconds. Past the time
   * limit, or after stop(), its group is asked to end (SIGTERM) and killed when it has
   * not ended kGrace later. */
  std::optional<ProcessEnd>
  poll();

  /** \brief Asks it to end. */
  void
  stop();

  static constexpr std::chrono::seconds kGrace{5};

private:
  using Clock = std::chrono::steady_clock;

  pid_t pid_ = -1;
  double time_limit_;
  Clock::time_point begin_;
  std::optional<Clock::time_point> asked_; ///< when it was asked to end
  bool timed_out_ = false;
};

} // namespace pcl6d::app
