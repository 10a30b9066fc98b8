// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/x_connection.h"

#include <pcl6d/common/error.h>
#include <pcl6d/visualization/private_display.h>

#include <boost/process.hpp>
#include <boost/process/extend.hpp>

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

/** In the child before exec: no Ctrl-C from our terminal, none of our files, and an end
 * with the thread that started it, which may be killed before it is connected. */
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

/** \return the path of a program; empty if there is none. Not by Boost, which asks for the
 * user's locale on the way and fails where that is not installed. */
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

/** Runs the launch of a child on a thread that then lives until it is let go: the kernel
 * ends the child when the thread that started it ends. */
class LaunchThread {
public:
  LaunchThread() = default;
  LaunchThread(const LaunchThread&) = delete;
  LaunchThread&
  operator=(const LaunchThread&) = delete;

  bp::child
  run(bp::pipe& answer, const visualization::DisplayCookie& cookie)
  {
    std::promise<bp::child> launched;
    auto child = launched.get_future();
    try {
      thread_ = std::thread(
          [&, launched = std::move(launched), over = over_.get_future()]() mutable {
            try {
              launched.set_value(launch(answer, cookie));
            } catch (...) {
              launched.set_exception(std::current_exception());
            }
            over.wait();
          });
    } catch (const std::system_error&) {
      throw IoFailed("cannot draw pictures: no more threads, or no memory for the one "
                     "that starts Xvfb");
    }
    return child.get();
  }

  void
  finish()
  {
    if (!thread_.joinable()) // it never began
      return;
    over_.set_value();
    thread_.join();
  }

  /** In a fork of the process, which has no such thread. */
  void
  forget()
  {
    if (thread_.joinable())
      thread_.detach();
  }

private:
  std::promise<void> over_;
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
    process = launcher.run(answer, cookie);
  } catch (...) {
    launcher.finish();
    throw;
  }
  const std::string number = readLine(answer.native_source(), deadline);
  if (!number.empty()) {
    name = ":" + number;
    connection = cookie.connect(name);
  }
  if (!connection || !visualization::isOurs(connection)) {
    const bool late = Clock::now() >= deadline;
    process.terminate();
    launcher.finish();
    const std::string why =
        connection ? "the display " + name + " is that of another user"
        : late ? "Xvfb did not start within " + std::to_string(kStartLimit.count()) +
                     " s; try it by hand: Xvfb :99"
               : "Xvfb did not start, or cannot be reached (too few file "
                 "descriptors?); try it by hand: Xvfb :99";
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
  // Not XCloseDisplay: it would call into OpenGL libraries that may be gone by now.
  ::shutdown(ConnectionNumber(connection), SHUT_RDWR);
  waitForEnd();
  launcher.finish();
}

void
PrivateDisplay::Server::waitForEnd()
{
  const auto deadline = Clock::now() + kEndLimit;
  std::error_code ignored; // somebody else has waited for it
  while (process.running(ignored)) {
    if (Clock::now() > deadline) {
      ::kill(process.id(), SIGTERM);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  process.detach();
}

PrivateDisplay::PrivateDisplay() : server_(std::make_unique<Server>())
{}
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
