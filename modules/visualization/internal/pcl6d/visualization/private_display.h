// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <memory>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief This process's own X server without a screen, used for drawing every picture.
 *
 * Debian's VTK draws only into X, and a server has no X: therefore Xvfb is started at
 * first use, on a free display number (any number of processes at once), in a session
 * of its own, reachable only from this machine and with a key unreadable for other
 * users. The server lives as long as the connection of this class: when the process
 * ends, even by SIGKILL, the connection closes and the server ends. The user's DISPLAY
 * is neither read nor set. \ingroup visualization */
class PrivateDisplay {
public:
  /** \brief The display of this process; the first call starts the server, in about 0.2 s.
   * \throws IoFailed Xvfb is not installed, does not start within 20 s, or has ended since */
  static PrivateDisplay&
  instance();

  /** \brief Closes the connection and waits until the server has ended. */
  ~PrivateDisplay();
  PrivateDisplay(const PrivateDisplay&) = delete;
  PrivateDisplay&
  operator=(const PrivateDisplay&) = delete;

  /** \brief Checks that drawing succeeded; to be called after drawing, as Xlib reports
   * no errors.
   * \throws IoFailed the server has ended, or rejected a request */
  void
  requireAlive() const;

  /** \return the connection, an X11 `Display*` */
  void*
  connection() const;

  /** \return the name of the display, ":99" */
  const std::string&
  name() const;

  /** \return the process id of the server */
  int
  serverPid() const;

private:
  PrivateDisplay();

  struct Server;
  std::unique_ptr<Server> server_;
};

} // namespace pcl6d
