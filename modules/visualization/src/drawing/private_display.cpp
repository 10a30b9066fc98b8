// SPDX-License-Identifier: BSD-3-Clause
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
#include <sys/prctl.h>
#include <sys/socket.h>
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
        ::fcntl(file, F_SETFD, FD_CLOEXEC);
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

bp::child
launch(bp::pipe& answer)
{
  const auto program = bp::search_path("Xvfb");
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
                               "-screen",
                               "0",
                               "640x480x24"}),
                     bp::std_in<bp::null, bp::std_out> answer,
                     bp::std_err > bp::null,
                     Detach());
  } catch (const bp::process_error& e) {
    throw IoFailed("cannot start " + program.string() + ": " + e.what());
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
  run(bp::pipe& answer)
  {
    std::promise<bp::child> launched;
    auto child = launched.get_future();
    thread_ = std::thread(
        [&answer, launched = std::move(launched), over = over_.get_future()]() mutable {
          try {
            launched.set_value(launch(answer));
          } catch (...) {
            launched.set_exception(std::current_exception());
          }
          over.wait();
        });
    return child.get();
  }

  void
  finish()
  {
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
  bp::pipe answer;
  try {
    process = launcher.run(answer);
  } catch (...) {
    launcher.finish();
    throw;
  }
  const std::string number = readLine(answer.native_source(), deadline);
  if (!number.empty()) {
    name = ":" + number;
    connection = ::XOpenDisplay(name.c_str());
  }
  if (!connection) {
    process.terminate();
    launcher.finish();
    throw IoFailed("cannot draw pictures: Xvfb did not start within " +
                   std::to_string(kStartLimit.count()) +
                   " s; try it by hand: Xvfb :99");
  }
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
  // Xlib would end the process at the first word to a server that is gone.
  std::error_code ignored;
  if (!display.server_->process.running(ignored))
    throw IoFailed("cannot draw pictures: the private X server " + display.name() +
                   " has ended");
  return display;
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
