// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/x_connection.h"

#include <pcl6d/common/error.h>

#include <X11/Xlib.h>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <mutex>
#include <sys/mman.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace pcl6d::visualization {

namespace {
constexpr char kEnded[] = "the private X server has ended";
constexpr char kProtocol[] = "MIT-MAGIC-COOKIE-1";
constexpr std::size_t kSecretBytes = 16; // of that protocol
constexpr unsigned int kAnyHost = 65535; // FamilyWild of Xauth.h

[[noreturn]] void
failWith(const std::string& what)
{
  throw IoFailed("cannot draw pictures: " + what + ": " + std::strerror(errno));
}

/** A field of an .Xauthority file: its length in two bytes, the high byte first, then
 * its bytes. */
void
appendField(std::string& record, const std::string& field)
{
  record += static_cast<char>(field.size() / 256);
  record += static_cast<char>(field.size() % 256);
  record += field;
}

std::string
randomBytes(std::size_t count)
{
  std::string bytes(count, '\0');
  if (::getrandom(bytes.data(), bytes.size(), 0) !=
      static_cast<ssize_t>(bytes.size())) // whole up to 256 bytes
    failWith("no random bytes for the key of the X server");
  return bytes;
}

/** Whether, on this thread, the end of the server throws IoFailed instead of ending the
 * process. */
thread_local bool end_is_thrown = false;

struct ErrorKeeper {
  std::mutex mutex;
  Display* connection = nullptr;
  XErrorHandler other_errors = nullptr;
  XIOErrorHandler other_ends = nullptr;
  std::string first;
  bool has_ended = false;

  void
  keep(const std::string& text)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (first.empty())
      first = text;
  }
};

ErrorKeeper&
keeper()
{
  // Xlib may call the handler at any time
  static ErrorKeeper* const kKeeper = new ErrorKeeper;
  return *kKeeper;
}

int
onError(Display* display, XErrorEvent* event)
{
  if (display != keeper().connection)
    return keeper().other_errors(display, event);
  std::array<char, 200> text{};
  ::XGetErrorText(display, event->error_code, text.data(), text.size());
  keeper().keep(std::string("the X server says: ") + text.data());
  return 0;
}

int
onEnd(Display* display)
{
  if (display != keeper().connection)
    return keeper().other_ends(display);
  {
    const std::lock_guard<std::mutex> lock(keeper().mutex);
    keeper().has_ended = true;
  }
  if (end_is_thrown)
    throw IoFailed(std::string("cannot draw pictures: ") + kEnded);
  return 0;
}
} // namespace

DisplayCookie::DisplayCookie() : secret_(randomBytes(kSecretBytes))
{
  std::string record;
  record += static_cast<char>(kAnyHost / 256);
  record += static_cast<char>(kAnyHost % 256);
  for (const std::string& field : {std::string(),
                                   std::string(), // address, number: any
                                   std::string(kProtocol),
                                   secret_})
    appendField(record, field);
  file_ = ::memfd_create("pcl6d-xauthority", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (file_ < 0)
    failWith("no file in memory for the key of the X server");
  const bool is_written =
      ::fchmod(file_, S_IRUSR | S_IWUSR) == 0 &&
      ::write(file_, record.data(), record.size()) ==
          static_cast<ssize_t>(record.size()) &&
      ::fcntl(file_,
              F_ADD_SEALS,
              F_SEAL_WRITE | F_SEAL_GROW | F_SEAL_SHRINK | F_SEAL_SEAL) == 0;
  if (!is_written) {
    ::close(file_);
    failWith("the key of the X server cannot be written");
  }
}

DisplayCookie::~DisplayCookie()
{
  ::close(file_);
}

std::string
DisplayCookie::path() const
{
  return "/proc/self/fd/" + std::to_string(file_);
}

Display*
DisplayCookie::connect(const std::string& name) const
{
  std::string protocol = kProtocol, secret = secret_;
  ::XSetAuthorization(protocol.data(),
                      static_cast<int>(protocol.size()),
                      secret.data(),
                      static_cast<int>(secret.size()));
  Display* const connection = ::XOpenDisplay(name.c_str());
  ::XSetAuthorization(nullptr, 0, nullptr, 0);
  return connection;
}

bool
isOurs(Display* connection)
{
  ucred peer{};
  socklen_t size = sizeof peer;
  return ::getsockopt(
             ConnectionNumber(connection), SOL_SOCKET, SO_PEERCRED, &peer, &size) ==
             0 &&
         peer.uid == ::geteuid();
}

void
keepErrorsOf(Display* connection)
{
  keeper().connection = connection;
  keeper().other_errors = ::XSetErrorHandler(onError);
  keeper().other_ends = ::XSetIOErrorHandler(onEnd);
  ::XSetIOErrorExitHandler(
      connection, [](Display*, void*) {}, nullptr); // Xlib continues, without drawing
}

EndIsThrown::EndIsThrown()
{
  end_is_thrown = true;
}

EndIsThrown::~EndIsThrown()
{
  end_is_thrown = false;
}

void
waitForAnswer(Display* connection)
{
  ::XSync(connection, False);
}

std::string
takeError()
{
  const std::lock_guard<std::mutex> lock(keeper().mutex);
  return keeper().has_ended ? kEnded : std::exchange(keeper().first, std::string());
}

} // namespace pcl6d::visualization
