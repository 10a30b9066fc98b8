// SPDX-License-Identifier: BSD-3-Clause
#include "common/process/child_process.h"

#include <pcl6d/common/error.h>

#include <boost/process/args.hpp>
#include <boost/process/child.hpp>
#include <boost/process/error.hpp>
#include <boost/process/extend.hpp>
#include <boost/process/io.hpp>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace bp = boost::process;

namespace pcl6d::app {

namespace {
double
secondsOf(const timeval& time)
{
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

struct CloseFile {
  void
  operator()(std::FILE* file) const
  {
    std::fclose(file);
  }
};

/** In the child before exec: a process group of its own, death together with the parent
 * process, and default signal handlers. */
struct OwnGroup : bp::extend::handler {
  explicit OwnGroup(std::size_t memory) : memory_limit(memory) {}

  pid_t parent = ::getpid();
  std::size_t memory_limit;

  template <typename Executor>
  void
  on_exec_setup(Executor&) const
  {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) // the parent ended before prctl()
      ::_exit(127);
    for (const int number : {SIGPIPE, SIGINT, SIGTERM, SIGHUP})
      ::signal(number, SIG_DFL);
    if (memory_limit > 0) {
      const rlimit limit{memory_limit, memory_limit};
      ::setrlimit(RLIMIT_DATA, &limit);
    }
  }
};
} // namespace

ChildProcess::ChildProcess(const ProcessStart& start) : time_limit_(start.time_limit)
{
  const bool is_open = start.log.parent_path() == "/proc/self/fd"; // without a name
  const int file =
      ::open(start.log.c_str(),
             O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | (is_open ? 0 : O_NOFOLLOW),
             0666);
  const std::unique_ptr<std::FILE, CloseFile> log(file < 0 ? nullptr
                                                           : ::fdopen(file, "w"));
  if (!log)
    throw IoFailed(start.log.string() + ": cannot write: " + std::strerror(errno));
  begin_ = Clock::now();
  try {
    bp::child child(start.program.string(),
                    bp::args(start.arguments),
                    bp::std_in<bp::null, (bp::std_out & bp::std_err)> log.get(),
                    OwnGroup(start.memory_limit));
    pid_ = child.id();
    child.detach(); // poll() calls wait4(), which also returns the resource usage
  } catch (const bp::process_error& error) {
    throw IoFailed(start.program.string() + ": cannot run: " + error.code().message());
  }
}

ChildProcess::~ChildProcess()
{
  if (pid_ <= 0)
    return;
  ::kill(-pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

void
ChildProcess::stop()
{
  if (pid_ <= 0 || asked_)
    return;
  asked_ = Clock::now();
  ::kill(-pid_, SIGTERM);
}

std::optional<ProcessEnd>
ChildProcess::poll()
{
  int status = 0;
  rusage used{};
  const pid_t ended = ::wait4(pid_, &status, WNOHANG, &used);
  const auto now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  if (ended != pid_) {
    if (time_limit_ > 0 && seconds > time_limit_ && !asked_) {
      timed_out_ = true;
      stop();
    }
    if (asked_ && now - *asked_ > kGrace)
      ::kill(-pid_, SIGKILL);
    return std::nullopt;
  }
  pid_ = -1;
  ProcessEnd end;
  end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  end.timed_out = timed_out_;
  end.seconds = seconds;
  end.cpu_seconds = secondsOf(used.ru_utime) + secondsOf(used.ru_stime);
  end.peak_memory_mb = 1024e-6 * static_cast<double>(used.ru_maxrss); // of KiB
  return end;
}

} // namespace pcl6d::app
