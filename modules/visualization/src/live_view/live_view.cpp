// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/picture_size.h"
#include "live_view/live_view_channel.h"
#include "live_view/live_view_window.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/visualization/live_view.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace pcl6d {
using namespace visualization;

namespace {
constexpr int kWindowLimit = 20000;    // [ms]
constexpr int kPollInterval = 100;     // [ms]
constexpr timeval kSendLimit = {5, 0}; // of a window that has stopped answering

/** Waits for a byte, or the end of the other side. */
bool
waitForInput(int socket, int milliseconds)
{
  pollfd request{socket, POLLIN, 0};
  int ready = 0;
  do
    ready = ::poll(&request, 1, milliseconds);
  while (ready < 0 && errno == EINTR);
  return ready > 0;
}

/** Main function of the child. X and OpenGL print no messages on the terminal, and
 * Ctrl-C is ignored. */
[[noreturn]] void
runWindow(int socket, const LiveViewOptions& options, pid_t parent)
{
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) // it has ended meanwhile
    ::_exit(1);
  for (const int signal : {SIGINT, SIGHUP, SIGTERM})
    std::signal(signal, SIG_IGN);
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    ::dup2(nowhere, file);
  try {
    LiveViewWindow window(options);
    if (::send(socket, "y", 1, MSG_NOSIGNAL) == 1)
      window.run(socket);
    ::_exit(0);
  } catch (...) {
    ::_exit(1);
  }
}

/** Every k-th finite point. */
Points
thinned(const Points& points, std::size_t most)
{
  const std::size_t step = std::max<std::size_t>(1, (points.size() + most - 1) / most);
  Points result;
  result.reserve(points.size() / step + 1);
  for (std::size_t i = 0; i < points.size(); i += step)
    if (points[i].allFinite())
      result.push_back(points[i]);
  return result;
}
} // namespace

void
LiveViewOptions::validate() const
{
  requirePictureSize("width", width);
  requirePictureSize("height", height);
  require(points_per_scan > 0, "points_per_scan", points_per_scan, "> 0");
}

struct LiveView::Process {
  pid_t pid = -1;
  int socket = -1;
  bool open = true;

  explicit Process(const LiveViewOptions& options);
  ~Process();
  void
  send(const LiveMessage& message);
};

LiveView::Process::Process(const LiveViewOptions& options)
{
  const char* display = std::getenv("DISPLAY");
  if (!display || !*display)
    throw IoFailed("no live view: no display (the variable DISPLAY is not set)");
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw IoFailed(std::string("no live view: ") + std::strerror(errno));
  const pid_t parent = ::getpid();
  pid = ::fork();
  if (pid == 0) {
    ::close(ends[0]);
    runWindow(ends[1], options, parent);
  }
  ::close(ends[1]);
  socket = ends[0];
  ::setsockopt(socket, SOL_SOCKET, SO_SNDTIMEO, &kSendLimit, sizeof(kSendLimit));
  char answer = 0;
  if (pid > 0 && waitForInput(socket, kWindowLimit) &&
      ::recv(socket, &answer, 1, 0) == 1)
    return;
  if (pid > 0) {
    ::kill(pid, SIGKILL);
    ::waitpid(pid, nullptr, 0);
  }
  ::close(socket);
  throw IoFailed("no live view: no window with OpenGL can be opened on the display " +
                 std::string(display));
}

LiveView::Process::~Process()
{
  ::close(socket);
  ::kill(pid, SIGKILL); // the child may be busy drawing, and has no state to save
  while (::waitpid(pid, nullptr, 0) < 0 && errno == EINTR)
    ;
}

void
LiveView::Process::send(const LiveMessage& message)
{
  open = open && sendMessage(socket, message);
}

LiveView::LiveView(const LiveViewOptions& options) : options_(options)
{
  options_.validate();
  process_ = std::make_unique<Process>(options_);
}

LiveView::~LiveView() = default;

void
LiveView::addScan(const Points& points, const Eigen::Isometry3d& initial_pose)
{
  if (num_scans_ == 0)
    origin_ = initial_pose.translation();
  LiveMessage message;
  message.kind = LiveMessage::Kind::kScan;
  message.scan = static_cast<std::uint32_t>(num_scans_++);
  message.T_world_scan = (Eigen::Translation3d(-origin_) * initial_pose).matrix();
  message.points = thinned(points, options_.points_per_scan);
  process_->send(message);
}

void
LiveView::place(std::size_t scan, const Eigen::Isometry3d& T_world_scan)
{
  require(scan < num_scans_, "scan", scan, "below " + std::to_string(num_scans_));
  LiveMessage message;
  message.kind = LiveMessage::Kind::kPose;
  message.scan = static_cast<std::uint32_t>(scan);
  message.T_world_scan = (Eigen::Translation3d(-origin_) * T_world_scan).matrix();
  process_->send(message);
}

void
LiveView::setText(const std::string& text)
{
  LiveMessage message;
  message.text = text;
  process_->send(message);
}

bool
LiveView::isOpen()
{
  // the child reports at most once
  if (process_->open && waitForInput(process_->socket, 0))
    process_->open = false;
  return process_->open;
}

void
LiveView::waitUntilClosed(const std::function<bool()>& stop)
{
  while (isOpen() && !stop())
    waitForInput(process_->socket, kPollInterval);
}

} // namespace pcl6d
