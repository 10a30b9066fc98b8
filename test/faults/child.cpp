// SPDX-License-Identifier: BSD-3-Clause
#include "child.h"
#include "support/temp_folder.h"

#include <chrono>
#include <cstdlib>
#include <fcntl.h>
#include <sstream>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace pcl6d::faults {

namespace {
constexpr const char* kMarkName = "PCL6D_FAULTS_CASE=";

std::vector<std::string>
environmentOf(const Command& command)
{
  std::vector<std::string> result = {"LC_ALL=C",
                                     "LANG=C",
                                     "HOME=/nonexistent",
                                     "TMPDIR=" + command.temporary.string(),
                                     "COLUMNS=100",
                                     kMarkName + command.mark};
  for (const char* const name :
       {"PATH", "LD_LIBRARY_PATH", "ASAN_OPTIONS", "UBSAN_OPTIONS", "TSAN_OPTIONS"})
    if (const char* const value = std::getenv(name))
      result.push_back(std::string(name) + "=" + value);
  return result;
}

std::vector<char*>
pointersTo(std::vector<std::string>& texts)
{
  std::vector<char*> pointers;
  for (auto& text : texts)
    pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

void
limit(int what, rlim_t most)
{
  const rlimit value{most, most};
  ::setrlimit(what, &value);
}

void
redirect(const char* file, int flags, int to)
{
  const int opened = ::open(file, flags, 0600);
  if (opened >= 0)
    ::dup2(opened, to);
}

/** Only calls that are allowed between fork() and exec(). */
[[noreturn]] void
becomeProgram(const Command& command,
              const Limits& limits,
              char* const* arguments,
              char* const* environment)
{
  ::setsid();
  redirect("/dev/null", O_RDONLY, 0);
  redirect(command.out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 1);
  redirect(command.err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 2);
  limit(RLIMIT_DATA, limits.memory);
  limit(RLIMIT_FSIZE, limits.file);
  limit(RLIMIT_CORE, 0);
  if (::chdir(command.folder.c_str()) == 0)
    ::execve(command.program.c_str(), arguments, environment);
  ::_exit(127);
}
} // namespace

pid_t
startChild(const Command& command, const Limits& limits)
{
  std::vector<std::string> words = command.arguments;
  words.insert(words.begin(), command.program.string());
  std::vector<std::string> environment = environmentOf(command);
  const std::vector<char*> arguments = pointersTo(words);
  const std::vector<char*> variables = pointersTo(environment);
  const pid_t child = ::fork();
  if (child < 0)
    throw std::runtime_error("no process to be had");
  if (child == 0)
    becomeProgram(command, limits, arguments.data(), variables.data());
  return child;
}

Ended
endOf(int status, double peak_kib)
{
  Ended end;
  if (WIFSIGNALED(status))
    end.signal = WTERMSIG(status);
  else
    end.exit_code = WEXITSTATUS(status);
  end.peak_memory = static_cast<std::size_t>(peak_kib * 1024);
  return end;
}

namespace {
/** \return the environment of a process; empty of one that has ended. While a process
 * begins another program it seems to have none, so that is looked at again. */
std::string
environmentIn(const std::string& process)
{
  for (int tries = 0; tries < 40; ++tries) {
    const std::string environment = test::readText(process + "/environ");
    const std::string state = test::readText(process + "/stat");
    const std::size_t name_end = state.rfind(')'); // "pid (name) state ..."
    if (!environment.empty() || name_end == std::string::npos ||
        state.compare(name_end, 3, ") Z") == 0)
      return environment;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return {};
}
} // namespace

std::vector<pid_t>
heirsOf(const std::string& mark)
{
  std::vector<pid_t> heirs;
  const std::string self = std::to_string(::getpid());
  std::istringstream children(
      test::readText("/proc/" + self + "/task/" + self + "/children"));
  for (pid_t child = 0; children >> child;) {
    const std::string environment = environmentIn("/proc/" + std::to_string(child));
    if (environment.find(kMarkName + mark + '\0') != std::string::npos)
      heirs.push_back(child);
  }
  return heirs;
}

void
inheritOrphans()
{
  ::prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0);
}

Ended
runToEnd(const Command& command, const Limits& limits)
{
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const auto passed = [&start] {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  const pid_t child = startChild(command, limits);
  int status = 0;
  rusage used{};
  bool killed = false;
  while (::wait4(child, &status, WNOHANG, &used) == 0) {
    if (!killed && passed() > limits.seconds)
      killed = ::kill(-child, SIGKILL) == 0;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  Ended end = endOf(status, static_cast<double>(used.ru_maxrss));
  end.timed_out = killed;
  end.seconds = passed();
  return end;
}

std::string
shellLine(const Command& command)
{
  std::string line = command.program.string();
  for (const std::string& argument : command.arguments) {
    std::string quoted;
    for (const char c : argument.substr(0, 300))
      quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    const bool plain =
        !argument.empty() && argument.find_first_not_of(
                                 "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                 "0123456789-_./=:,+") == std::string::npos;
    line += ' ' + (plain ? quoted : "'" + quoted + "'");
    if (argument.size() > 300)
      line += "...(" + std::to_string(argument.size()) + " bytes)";
  }
  return line;
}

} // namespace pcl6d::faults
