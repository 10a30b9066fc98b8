// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/x_connection.h"

#include <pcl6d/common/error.h>
#include <pcl6d/visualization/private_display.h>

#include <boost/process/args.hpp>
#include <boost/process/child.hpp>
#include <boost/process/error.hpp>
#include <boost/process/extend.hpp>
#include <boost/process/io.hpp>
#include <boost/process/pipe.hpp>

#include <X11/Xlib.h>
#include <chrono>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <future>
#include <poll.h>
#include <signal.h>
#include <sstream>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace bp = boost::process;
using Clock = std::chrono::steady_clock;

namespace pcl6d {

namespace {
constexpr std::chrono::seconds kStartLimit(20);
constexpr std::chrono::seconds kEndLimit(2);

/** Number of attempts: if two servers start simultaneously and choose one display, one
 * server ends. */
constexpr int kAttempts = 3;

/** The server ended before the connection. */
class EndedEarly : public IoFailed {
public:
  using IoFailed::IoFailed;
};

std::vector<int>
openFiles()
{
  std::vector<int> files;
  std::error_code ignored;
  for (const auto& entry :
       std::filesystem::directory_iterator("/proc/self/fd", ignored))
    files.push_back(std::stoi(entry.path().filename()));
  return files;
}

/** In the child before exec: no Ctrl-C from our terminal, no inherited files, and death
 * together with the launching thread, which may be killed before the connection. */
struct Detach : bp::extend::handler {
  explicit Detach(int kept_file) : kept(kept_file) {}

  int kept; ///< but for this one
  std::vector<int> files = openFiles();
  pid_t parent = ::getpid();

  template <typename Executor>
  void
  on_exec_setup(Executor&) const
  {
    ::setsid();
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) // it has ended meanwhile
      ::_exit(EXIT_FAILURE);
    for (const int file : files)
      if (file > STDERR_FILENO)
        ::fcntl(file, F_SETFD, file == kept ? 0 : FD_CLOEXEC);
  }
};

/** \return the first line that arrives; empty if the writer ended or time ran out */
std::string
readLine(int file, Clock::time_point deadline)
{
  std::string line;
  while (true) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
    pollfd request{file, POLLIN, 0};
    if (left.count() <= 0)
      return {};
    const int ready = ::poll(&request, 1, static_cast<int>(left.count()));
    char c = 0;
    if (ready < 0 && errno == EINTR)
      continue;
    if (ready <= 0 || ::read(file, &c, 1) != 1)
      return {};
    if (c == '\n')
      return line;
    line += c;
  }
}

/** \return the path of a program; empty if not found. Not by Boost, whose search reads
 * the user's locale and fails if the locale is not installed. */
std::string
onThePath(const std::string& program)
{
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/usr/local/bin:/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::string file = folder;
    file.append("/").append(program);
    struct stat status {};
    if (folder.rfind('/', 0) == 0 && ::stat(file.c_str(), &status) == 0 &&
        S_ISREG(status.st_mode) && ::access(file.c_str(), X_OK) == 0)
      return file;
  }
  return {};
}

bp::pipe
makePipe()
try {
  return bp::pipe();
} catch (const bp::process_error& e) {
  throw IoFailed("cannot draw pictures: no pipe to Xvfb: " + e.code().message());
}

bp::child
launch(bp::pipe& answer, const visualization::DisplayCookie& cookie)
{
  const std::string program = onThePath("Xvfb");
  if (program.empty())
    throw IoFailed("cannot draw pictures: the program Xvfb is not on the PATH; install "
                   "the package xvfb");
  try {
    return bp::child(program,
                     bp::args({"-displayfd",
                               "1",
                               "-terminate",
                               "-nolisten",
                               "tcp",
                               "-auth",
                               cookie.path().c_str(),
                               "-screen",
                               "0",
                               "640x480x24"}),
                     bp::std_in<bp::null, bp::std_out> answer,
                     bp::std_err > bp::null,
                     Detach(cookie.file()));
  } catch (const bp::process_error& e) {
    throw IoFailed("cannot start " + program + ": " + e.code().message());
  }
}

/** Launches a child on a thread that lives until released: the kernel ends the child
 * together with the launching thread. A child without a connection in time is killed: a
 * server out of memory leaves requests unanswered, and Xlib would wait forever. */
class LaunchThread {
public:
  LaunchThread() = default;
  LaunchThread(const LaunchThread&) = delete;
  LaunchThread&
  operator=(const LaunchThread&) = delete;

  bp::child
  run(bp::pipe& answer,
      const visualization::DisplayCookie& cookie,
      Clock::time_point deadline)
  {
    std::promise<bp::child> launched;
    auto child = launched.get_future();
    try {
      thread_ = std::thread([&,
                             deadline,
                             launched = std::move(launched),
                             over = over_.get_future()]() mutable {
        try {
          bp::child process = launch(answer, cookie);
          const pid_t group = process.id(); // Detach made it one
          launched.set_value(std::move(process));
          if (connected_.get_future().wait_until(deadline) ==
              std::future_status::timeout)
            ::kill(-group, SIGKILL);
        } catch (...) {
          launched.set_exception(std::current_exception());
        }
        over.wait();
      });
    } catch (const std::system_error&) {
      throw IoFailed(
          "cannot draw pictures: no more threads, or no memory for the thread of Xvfb");
    }
    return child.get();
  }

  /** The child is connected, or about to be waited for, and is not killed any more. */
  void
  stopWatching()
  {
    if (!std::exchange(is_watched_, false))
      return;
    connected_.set_value();
  }

  void
  finish()
  {
    if (!thread_.joinable()) // it never began
      return;
    stopWatching();
    over_.set_value();
    thread_.join();
  }

  /** For a fork of the process, where the thread does not exist. */
  void
  forget()
  {
    if (thread_.joinable())
      thread_.detach();
  }

private:
  std::promise<void> connected_;
  std::promise<void> over_;
  bool is_watched_ = true;
  std::thread thread_;
};

} // namespace

struct PrivateDisplay::Server {
  visualization::DisplayCookie cookie;
  LaunchThread launcher;
  bp::child process;
  std::string name;
  Display* connection = nullptr;
  pid_t owner = ::getpid();

  Server();
  ~Server();
  void
  waitForEnd();
};

PrivateDisplay::Server::Server()
{
  const auto deadline = Clock::now() + kStartLimit;
  bp::pipe answer = makePipe();
  try {
    process = launcher.run(answer, cookie, deadline);
  } catch (...) {
    launcher.finish();
    throw;
  }
  const std::string number = readLine(answer.native_source(), deadline);
  if (!number.empty()) {
    name = ":" + number;
    connection = cookie.connect(name);
  }
  const bool is_ours = connection && visualization::isOurs(connection);
  launcher.stopWatching();
  if (!is_ours) {
    const bool late = Clock::now() >= deadline;
    process.terminate();
    launcher.finish();
    const std::string why =
        connection ? "the display " + name + " belongs to another user"
        : late ? "Xvfb did not start within " + std::to_string(kStartLimit.count()) +
                     " s; try by hand: Xvfb :99"
               : "Xvfb did not start, or cannot be reached (too few file "
                 "descriptors?); try by hand: Xvfb :99";
    if (!connection && !late)
      throw EndedEarly("cannot draw pictures: " + why);
    throw IoFailed("cannot draw pictures: " + why);
  }
  visualization::keepErrorsOf(connection);
}

PrivateDisplay::Server::~Server()
{
  if (::getpid() != owner) { // a fork: server and connection belong to the parent
    process.detach();
    launcher.forget();
    return;
  }
  // Not XCloseDisplay(): the OpenGL libraries called by this function may be unloaded.
  ::shutdown(ConnectionNumber(connection), SHUT_RDWR);
  waitForEnd();
  launcher.finish();
}

void
PrivateDisplay::Server::waitForEnd()
{
  const auto deadline = Clock::now() + kEndLimit;
  std::error_code ignored; // already waited for elsewhere
  while (process.running(ignored)) {
    if (Clock::now() > deadline) {
      ::kill(process.id(), SIGTERM);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  process.detach();
}

PrivateDisplay::PrivateDisplay()
{
  for (int attempt = 1; !server_; ++attempt)
    try {
      server_ = std::make_unique<Server>();
    } catch (const EndedEarly&) {
      if (attempt == kAttempts)
        throw;
    }
}
PrivateDisplay::~PrivateDisplay() = default;

PrivateDisplay&
PrivateDisplay::instance()
{
  static PrivateDisplay display;
  display.requireAlive();
  return display;
}

void
PrivateDisplay::requireAlive() const
{
  std::error_code ignored;
  const std::string error = visualization::takeError();
  if (!error.empty())
    throw IoFailed("cannot draw pictures: " + error);
  if (!server_->process.running(ignored))
    throw IoFailed("cannot draw pictures: the private X server " + name() +
                   " has ended");
}

void*
PrivateDisplay::connection() const
{
  return server_->connection;
}

const std::string&
PrivateDisplay::name() const
{
  return server_->name;
}

int
PrivateDisplay::serverPid() const
{
  return server_->process.id();
}

} // namespace pcl6d
