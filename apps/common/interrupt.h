// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pcl6d::app {

/** \brief Turns SIGINT and SIGTERM into a request to stop, for the length of its scope.
 * A second signal ends the program at once. One at a time. */
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
};

} // namespace pcl6d::app
