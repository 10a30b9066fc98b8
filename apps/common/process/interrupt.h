// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <csignal>

namespace pcl6d::app {

/** \brief Turns SIGINT, SIGTERM and SIGHUP into a request to stop, until destruction. A
 * second signal of a kind ends the program at once. Signals ignored before (nohup) stay
 * ignored. At most one instance at a time. */
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
