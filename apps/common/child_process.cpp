// SPDX-License-Identifier: BSD-3-Clause
#include "common/child_process.h"

#include <pcl6d/common/error.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace pcl6d::app {

namespace {
double
secondsOf(const timeval& time)
{
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/** Closes its file at the end of its scope. */
struct File {
  File(const char* path, int flags) : number(::open(path, flags | O_CLOEXEC, 0666)) {}
  ~File()
  {
    if (number >= 0)
      ::close(number);
  }
  File(const File&) = delete;
  File&
  operator=(const File&) = delete;
  int number;
};

std::vector<char*>
wordsOf(const ProcessStart& start)
{
  std::vector<char*> words = {const_cast<char*>(start.program.c_str())};
  for (const auto& argument : start.arguments)
    words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  return words;
}

/** In the child, where only calls that are safe in a signal handler are allowed.
 * \param[in] answer gets errno if the program cannot be run */
[[noreturn]] void
becomeProgram(char* const* words, pid_t parent, int input, int log, int answer)
{
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) // it ended before the line above
    ::_exit(127);
  ::dup2(input, STDIN_FILENO);
  ::dup2(log, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  for (const int number : {SIGPIPE, SIGINT, SIGTERM, SIGHUP})
    ::signal(number, SIG_DFL);
  ::execv(words[0], words);
  const int error = errno;
  [[maybe_unused]] const auto written = ::write(answer, &error, sizeof error);
  ::_exit(127);
}
} // namespace

ChildProcess::ChildProcess(const ProcessStart& start) : time_limit_(start.time_limit)
{
  const File log(start.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC);
  if (log.number < 0)
    throw IoFailed(start.log.string() + ": cannot write: " + std::strerror(errno));
  const File input("/dev/null", O_RDONLY);
  std::array<int, 2> answer{}; // closed by a successful exec, which then says nothing
  if (::pipe2(answer.data(), O_CLOEXEC) != 0)
    throw IoFailed(start.program.string() + ": cannot run: " + std::strerror(errno));
  const auto words = wordsOf(start);
  const pid_t parent = ::getpid();
  begin_ = Clock::now();
  pid_ = ::fork();
  if (pid_ == 0)
    becomeProgram(words.data(), parent, input.number, log.number, answer[1]);
  int error = pid_ < 0 ? errno : 0;
  ::close(answer[1]);
  if (pid_ > 0) {
    ::setpgid(pid_, pid_); // whoever of the two comes first
    if (::read(answer[0], &error, sizeof error) > 0)
      ::waitpid(pid_, nullptr, 0);
  }
  ::close(answer[0]);
  if (error != 0) {
    pid_ = -1;
    throw IoFailed(start.program.string() + ": cannot run: " + std::strerror(error));
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
