// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <sys/types.h>

struct _XDisplay;

/** \file Connection to a private X server, with a secret, and with errors in place of
 * Xlib's process exits. */
namespace pcl6d::visualization {

/** \brief Secret of the clients of a private X server (MIT-MAGIC-COOKIE-1). The server
 * reads the secret from an unnamed file in memory: no other user can open the file, and
 * the file vanishes with the last process that has it open, even a killed one. */
class DisplayCookie {
public:
  /** \throws IoFailed the system gives no random bytes, or no file in memory */
  DisplayCookie();
  ~DisplayCookie();
  DisplayCookie(const DisplayCookie&) = delete;
  DisplayCookie&
  operator=(const DisplayCookie&) = delete;

  /** \return the file, inherited by the server */
  int
  file() const
  {
    return file_;
  }

  /** \return the path of the file in a process that inherits the file */
  std::string
  path() const;

  /** \return a connection to the named display with the cookie, null on failure; later
   * connections to other displays are unaffected */
  _XDisplay*
  connect(const std::string& name) const;

private:
  int file_ = -1;
  std::string secret_;
};

/** \return whether the server at the other end runs as this user: another user may have
 * made the display's socket */
bool
isOurs(_XDisplay* connection);

/** \brief From now on, errors of the connection do not end the process: the first error
 * is kept. Errors of other connections go to the previous handler. At most one
 * connection per process. */
void
keepErrorsOf(_XDisplay* connection);

/** \brief Within its scope, on its thread, the end of the server is thrown as IoFailed
 * from within Xlib: OpenGL crashes on the answers of Xlib after the end. Objects in use
 * at the throw must not be used or destroyed any more. Outside the scope, Xlib
 * continues without drawing. */
class EndIsThrown {
public:
  EndIsThrown();
  ~EndIsThrown();
  EndIsThrown(const EndIsThrown&) = delete;
  EndIsThrown&
  operator=(const EndIsThrown&) = delete;
};

/** \brief Waits until the server has answered the pending requests; the end of the
 * server is kept as an error. */
void
waitForAnswer(_XDisplay* connection);

/** \return the first error of the connection since the last call, in words; empty
 * without error. The end of the server is reported at every call. */
std::string
takeError();

} // namespace pcl6d::visualization
