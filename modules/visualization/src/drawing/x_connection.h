// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <sys/types.h>

struct _XDisplay;

/** \file The connection to a private X server: with a secret, and without the ends of the
 * process that Xlib has in store. */
namespace pcl6d::visualization {

/** \brief The secret that a client must tell to a private X server (MIT-MAGIC-COOKIE-1).
 * The server reads it from a file in memory that has no name: no other user can open it, and
 * it is gone with the last process that holds it, whatever ends that. */
class DisplayCookie {
public:
  /** \throws IoFailed the system gives no random bytes, or no file in memory */
  DisplayCookie();
  ~DisplayCookie();
  DisplayCookie(const DisplayCookie&) = delete;
  DisplayCookie&
  operator=(const DisplayCookie&) = delete;

  /** \return the file, which the server inherits */
  int
  file() const
  {
    return file_;
  }

  /** \return the path of the file in a process that inherits it */
  std::string
  path() const;

  /** \return a connection to the display of that name with the cookie, null if there is
   * none; later ones to other displays are made as before */
  _XDisplay*
  connect(const std::string& name) const;

private:
  int file_ = -1;
  std::string secret_;
};

/** \return whether the server at the other end runs as this user: the name of a display is
 * one of a socket that others may have made */
bool
isOurs(_XDisplay* connection);

/** \brief From now on, errors of a connection do not end the process: the first one is kept.
 * Those of other connections go where they went before. One connection of a process. */
void
keepErrorsOf(_XDisplay* connection);

/** \brief In its scope, on its thread, the end of the server is thrown as IoFailed from
 * within Xlib: OpenGL crashes on the answers that Xlib gives then. What was in use must not
 * be used or destroyed any more. Outside, Xlib goes on with nothing drawn. */
class EndIsThrown {
public:
  EndIsThrown();
  ~EndIsThrown();
  EndIsThrown(const EndIsThrown&) = delete;
  EndIsThrown&
  operator=(const EndIsThrown&) = delete;
};

/** \brief Waits until the server has done what it was asked for; if it is gone, the error is
 * kept. */
void
waitForAnswer(_XDisplay* connection);

/** \return the first error of that connection since the last call, in words; empty if there
 * was none. That the server has ended is told every time. */
std::string
takeError();

} // namespace pcl6d::visualization
