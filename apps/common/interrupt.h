// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <csignal>

namespace pcl6d::app {

/** \brief Turns SIGINT, SIGTERM and SIGHUP into a request to stop, for the length of its
 * scope. A second signal of a kind ends the program at once. A signal that was ignored
 * before (nohup) stays so. One at a time. */
class Interrupt {
public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt&
  operator=(const Interrupt&) = delete;

  /** \return whether a signal came in */
  bool
  requested() const;

private:
  static constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, 3> before_{};
};

} // namespace pcl6d::app
