// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/peers/limited_run.h"

#include <pcl6d/common/error.h>

#include <pcl/console/print.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <poll.h>
#include <regex>
#include <sstream>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace pcl6d::app {

namespace {
using Clock = std::chrono::steady_clock;
constexpr char kStageMark = '\x01';

/** A pipe that is closed at destruction. */
struct Pipe {
  Pipe()
  {
    if (::pipe(ends.data()) != 0)
      throw IoFailed(std::string("cannot make a pipe: ") + std::strerror(errno));
  }
  ~Pipe()
  {
    close(0);
    close(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe&
  operator=(const Pipe&) = delete;

  void
  close(std::size_t end)
  {
    if (ends[end] >= 0)
      ::close(ends[end]);
    ends[end] = -1;
  }

  std::array<int, 2> ends{-1, -1}; ///< to read from, to write to
};

void
writeAll(int file, const std::string& text)
{
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(file, text.data() + done, text.size() - done);
    if (count <= 0)
      return; // the reader has closed the pipe
    done += static_cast<std::size_t>(count);
  }
}

/** Main function of the child: never returns, and runs no destructors of the parent. */
[[noreturn]] void
beChild(const std::function<nlohmann::json()>& work, int result, int said, pid_t parent)
{
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) // the parent ended before prctl()
    ::_exit(127);
  for (const int number : {SIGPIPE, SIGINT, SIGTERM, SIGHUP})
    ::signal(number, SIG_DFL);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  ::dup2(said, STDOUT_FILENO);
  ::dup2(said, STDERR_FILENO);
  pcl::console::setVerbosityLevel(pcl::console::L_WARN);
  nlohmann::json answer = nlohmann::json::object();
  try {
    answer["result"] = work();
  } catch (const std::exception& e) {
    answer["threw"] = e.what();
  } catch (...) {
    answer["threw"] = "an object that is no std::exception";
  }
  std::fflush(nullptr);
  writeAll(result,
           answer.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace));
  ::_exit(0);
}

/** \return the output of a run without stage marks \param[out] stage the last stage */
std::string
withoutStages(const std::string& text, std::string& stage)
{
  std::string rest;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t mark = line.find(kStageMark);
    rest += line.substr(0, mark) + '\n';
    if (mark != std::string::npos)
      stage = line.substr(mark + 1);
  }
  return rest;
}

/** \return the first lines of an output, on one line, without colours; of a failed
 * assertion its message */
std::string
shortened(const std::string& text)
{
  constexpr std::size_t kMost = 200;
  static const std::regex kColour("\x1b\\[[0-9;]*m"), kBlank("[\\s]+");
  const std::size_t assertion = text.rfind("Assertion `");
  const std::size_t begin = assertion == std::string::npos ? 0 : assertion;
  std::string line = std::regex_replace(text.substr(begin, 4 * kMost), kColour, "");
  line = std::regex_replace(line, kBlank, " ");
  if (line.size() > kMost)
    line = line.substr(0, kMost) + " ...";
  while (!line.empty() && line.back() == ' ')
    line.pop_back();
  return line.substr(std::min(line.find_first_not_of(' '), line.size()));
}

/** Reads the available bytes. \return false at the end */
bool
readSome(int file, std::string& text, std::size_t most)
{
  std::array<char, 4096> bytes;
  const ssize_t count = ::read(file, bytes.data(), bytes.size());
  if (count > 0 && text.size() < most)
    text.append(bytes.data(), static_cast<std::size_t>(count));
  return count > 0 || (count < 0 && errno == EINTR);
}

/** Listens until both ends are closed. \return kDone, kTimeOut or kInterrupted */
RunEnd
listen(double seconds,
       const Interrupt& interrupt,
       std::array<int, 2> files,
       std::array<std::string, 2>& texts)
{
  constexpr int kLook = 50; // [ms]
  const auto begin = Clock::now();
  std::array<pollfd, 2> watched{pollfd{files[0], POLLIN, 0},
                                pollfd{files[1], POLLIN, 0}};
  while (watched[0].fd >= 0 || watched[1].fd >= 0) {
    if (interrupt.requested())
      return RunEnd::kInterrupted;
    if (std::chrono::duration<double>(Clock::now() - begin).count() > seconds)
      return RunEnd::kTimeOut;
    if (::poll(watched.data(), watched.size(), kLook) <= 0)
      continue;
    for (std::size_t i = 0; i < 2; ++i) {
      const std::size_t most = i == 0 ? std::size_t(-1) : 1 << 16;
      if (watched[i].fd >= 0 && watched[i].revents != 0 &&
          !readSome(watched[i].fd, texts[i], most))
        watched[i].fd = -1;
    }
  }
  return RunEnd::kDone;
}

/** \return the result of a process that ended by itself */
LimitedRun
evaluated(int status, const std::string& answer)
{
  LimitedRun run;
  const auto json = nlohmann::json::parse(answer, nullptr, false);
  if (WIFSIGNALED(status)) {
    run.end = RunEnd::kCrashed;
    run.words = std::string(::strsignal(WTERMSIG(status)));
  }
  else if (json.is_discarded()) {
    run.end = RunEnd::kCrashed;
    run.words = "it called exit(" + std::to_string(WEXITSTATUS(status)) + ")";
  }
  else if (json.contains("threw")) {
    run.end = RunEnd::kThrew;
    run.words = json["threw"].get<std::string>();
  }
  else
    run.result = json["result"];
  return run;
}
} // namespace

void
enterStage(const char* name)
{
  std::fflush(stdout);
  std::fprintf(stderr, "%c%s\n", kStageMark, name);
}

LimitedRun
runLimited(double seconds,
           const Interrupt& interrupt,
           const std::function<nlohmann::json()>& work)
{
  Pipe result, said;
  std::fflush(nullptr);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0)
    throw IoFailed(std::string("cannot make a process: ") + std::strerror(errno));
  if (child == 0)
    beChild(work, result.ends[1], said.ends[1], parent);
  result.close(1);
  said.close(1);
  std::array<std::string, 2> texts;
  const RunEnd end = listen(seconds, interrupt, {result.ends[0], said.ends[0]}, texts);
  if (end != RunEnd::kDone)
    ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {}
  LimitedRun run = end == RunEnd::kDone ? evaluated(status, texts[0]) : LimitedRun();
  if (end != RunEnd::kDone)
    run.end = end;
  run.said = shortened(withoutStages(texts[1], run.stage));
  return run;
}

} // namespace pcl6d::app
