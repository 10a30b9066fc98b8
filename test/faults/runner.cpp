// SPDX-License-Identifier: BSD-3-Clause
#include "runner.h"
#include "support/temp_folder.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <optional>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace pcl6d::faults {

namespace {
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr auto kGrace = std::chrono::seconds(3); // for servers that end by themselves
constexpr std::size_t kKeptText = 1'000'000;     // [B] of what a program prints

double
secondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/** A place in which one case runs at a time. */
class Slot {
public:
  Slot(const RunnerOptions& options, std::size_t number)
  : options_(&options), place_(options.scratch / std::to_string(number))
  {}

  bool
  isFree() const
  {
    return case_ == nullptr;
  }

  void
  start(const Case& one)
  {
    fs::remove_all(place_);
    fs::create_directories(place_ / "tmp");
    prepare(one, options_->samples, place_ / "in");
    trace_ = {};
    trace_.before = listingOf(place_ / "in");
    trace_.input_size = sizeOf(place_ / "in");
    command_ = commandOf(one, options_->programs, place_);
    case_ = &one;
    begin_ = Clock::now();
    child_ = startChild(command_, options_->limits);
    ended_.reset();
    killed_ = false;
  }

  /** Takes note of the end of a process, if it is that of this case. */
  void
  note(pid_t process, int status, const rusage& used)
  {
    if (case_ == nullptr || process != child_)
      return;
    trace_.end = endOf(status, static_cast<double>(used.ru_maxrss));
    trace_.end.timed_out = killed_;
    trace_.end.seconds = secondsSince(begin_);
    ended_ = Clock::now();
  }

  /** Kills what is too slow. \return whether the case is over */
  bool
  look()
  {
    if (case_ == nullptr)
      return false;
    if (!ended_) {
      if (!killed_ && secondsSince(begin_) > options_->limits.seconds)
        killed_ = ::kill(-child_, SIGKILL) == 0;
      return false;
    }
    const std::vector<pid_t> heirs = heirsOf(command_.mark);
    if (heirs.empty())
      return true;
    const bool last = killed_ || Clock::now() - *ended_ > kGrace;
    if (last)
      for (const pid_t heir : heirs)
        ::kill(heir, SIGKILL);
    if (last && !killed_)
      trace_.left_processes = heirs.size();
    killed_ = killed_ || last;
    return false; // once they are gone
  }

  /** \return the case, which is over, with what is known of it */
  std::pair<const Case*, Trace>
  finish()
  {
    trace_.out = test::readText(command_.out).substr(0, kKeptText);
    trace_.err = test::readText(command_.err).substr(0, kKeptText);
    trace_.after = listingOf(place_ / "in");
    for (const auto& [path, content] : listingOf(place_ / "tmp"))
      trace_.after["TMPDIR/" + path] = content;
    const Case* const one = case_;
    case_ = nullptr;
    return {one, std::move(trace_)};
  }

private:
  static std::size_t
  sizeOf(const fs::path& folder)
  {
    std::size_t size = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (!entry.is_symlink() && entry.is_regular_file())
        size += entry.file_size();
    return size;
  }

  const RunnerOptions* options_;
  fs::path place_;
  const Case* case_ = nullptr;
  Command command_;
  pid_t child_ = -1;
  Clock::time_point begin_;
  std::optional<Clock::time_point> ended_;
  bool killed_ = false;
  Trace trace_;
};

/** Waits a moment for the end of any process and tells the slots. */
void
waitForEnds(std::vector<Slot>& slots)
{
  sigset_t ends;
  ::sigemptyset(&ends);
  ::sigaddset(&ends, SIGCHLD);
  const timespec moment{0, 20'000'000};
  ::sigtimedwait(&ends, nullptr, &moment);
  int status = 0;
  rusage used{};
  for (pid_t process = 0; (process = ::wait4(-1, &status, WNOHANG, &used)) > 0;)
    for (Slot& slot : slots)
      slot.note(process, status, used);
}
} // namespace

Command
commandOf(const Case& one, const fs::path& programs, const fs::path& place)
{
  Command command;
  command.program = programs / one.program;
  command.arguments = one.arguments;
  command.folder = place / "in";
  command.out = place / "stdout";
  command.err = place / "stderr";
  command.temporary = place / "tmp";
  command.mark = place.string();
  return command;
}

void
prepare(const Case& one, const fs::path& samples, const fs::path& folder)
{
  fs::create_directories(folder);
  for (const std::string& input : one.inputs)
    fs::copy(samples / input, folder / input, fs::copy_options::recursive);
  if (one.prepare)
    one.prepare(folder);
}

void
runCases(const std::vector<Case>& cases,
         const RunnerOptions& options,
         const std::function<void(const Case&, const Trace&)>& told)
{
  inheritOrphans();
  sigset_t ends;
  ::sigemptyset(&ends);
  ::sigaddset(&ends, SIGCHLD);
  ::sigprocmask(SIG_BLOCK, &ends, nullptr); // for sigtimedwait(); a child unblocks it
  std::vector<Slot> slots;
  for (std::size_t i = 0; i < std::max<std::size_t>(1, options.jobs); ++i)
    slots.emplace_back(options, i);
  for (std::size_t next = 0, over = 0;;) {
    const bool may_start = next == 0 || Clock::now() < options.last_start;
    for (Slot& slot : slots)
      if (slot.isFree() && may_start && next < cases.size())
        slot.start(cases[next++]);
    if (over == next)
      return;
    waitForEnds(slots);
    for (Slot& slot : slots)
      if (slot.look()) {
        const auto [one, trace] = slot.finish();
        told(*one, trace);
        ++over;
      }
  }
}

} // namespace pcl6d::faults
