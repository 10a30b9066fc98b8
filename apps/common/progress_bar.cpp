// SPDX-License-Identifier: BSD-3-Clause
#include "common/printable.h"
#include "common/progress_bar.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <sys/ioctl.h>
#include <unistd.h>

namespace pcl6d::app {

namespace {
constexpr double kMemory = 10; ///< [s] after which a step counts 1/e
constexpr std::chrono::milliseconds kRedraw{100};
constexpr int kMostCells = 40;
constexpr int kFewestCells = 10; ///< a shorter bar is of no use
constexpr int kUnknownColumns = 80;
constexpr const char* kEraseLine = "\r\033[K";

bool
isTerminal()
{
  const char* kind = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && kind && std::string(kind) != "dumb";
}

int
columns()
{
  winsize size{};
  const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : kUnknownColumns;
}

std::string
rateText(double per_second)
{
  const bool slow = per_second < 1;
  char text[32];
  std::snprintf(text,
                sizeof(text),
                slow              ? "%.1f s each"
                : per_second < 10 ? "%.1f/s"
                                  : "%.0f/s",
                slow ? 1 / per_second : per_second);
  return text;
}

/** \return stage, bar, count and estimate in one line; a narrow terminal loses the
 * estimate first, then the bar */
std::string
lineOf(const Progress& progress, const std::string& estimate, int width)
{
  const std::string count =
      std::to_string(progress.done) + "/" + std::to_string(progress.total);
  const std::string behind = estimate.empty() ? "" : "  " + estimate;
  std::string line = progress.stage + ' ' + count;
  const auto free = [&](std::size_t needed) {
    return width - 1 - static_cast<int>(line.size() + needed);
  };
  if (free(behind.size()) < 0)
    return line.substr(0, static_cast<std::size_t>(std::max(width - 1, 0)));
  const int cells = std::min(kMostCells, free(behind.size() + 3));
  if (cells < kFewestCells)
    return line + behind;
  const auto filled =
      static_cast<int>(static_cast<double>(cells) * static_cast<double>(progress.done) /
                       static_cast<double>(progress.total));
  return progress.stage + " [" + std::string(filled, '#') +
         std::string(cells - filled, '.') + "] " + count + behind;
}
} // namespace

void
StepRate::update(std::size_t done, Clock::time_point now)
{
  if (last_) {
    const double passed = std::chrono::duration<double>(now - *last_).count();
    const double weight = std::exp(-passed / kMemory);
    steps_ = weight * steps_ + static_cast<double>(done) - static_cast<double>(done_);
    seconds_ = weight * seconds_ + passed;
    watched_ += passed;
  }
  last_ = now;
  done_ = done;
}

std::optional<double>
StepRate::perSecond() const
{
  if (watched_ < 1 || steps_ <= 0)
    return std::nullopt;
  return steps_ / seconds_;
}

std::string
durationText(double seconds)
{
  const auto all = static_cast<long>(std::lround(seconds));
  const long hours = all / 3600, minutes = all / 60 % 60;
  if (hours > 0)
    return std::to_string(hours) + " h " + std::to_string(minutes) + " min";
  return (minutes > 0 ? std::to_string(minutes) + " min " : "") +
         std::to_string(all % 60) + " s";
}

ProgressBar::ProgressBar(bool quiet)
: quiet_(quiet), terminal_(isTerminal()), last_(StepRate::Clock::now())
{}

ProgressBar::~ProgressBar()
{
  end();
}

void
ProgressBar::print(const std::string& line)
{
  if (!bar_.empty())
    std::cerr << kEraseLine;
  std::cerr << printableLines(line) << '\n' << bar_ << std::flush;
}

void
ProgressBar::say(const std::string& line)
{
  if (!quiet_)
    print(line);
}

void
ProgressBar::warn(const std::string& line)
{
  print("warning: " + line);
}

void
ProgressBar::begin(const std::string& stage)
{
  end();
  state_.stage = stage;
  quarter_ = -1;
  began_ = last_;
  rate_ = StepRate();
  rate_.update(0, began_);
  drawn_ = {};
}

/** Leaves a line with the duration of the stage, also of an interrupted stage. */
void
ProgressBar::end()
{
  if (bar_.empty())
    return;
  draw(durationText(std::chrono::duration<double>(last_ - began_).count()));
  std::cerr << '\n';
  bar_.clear();
}

void
ProgressBar::draw(const std::string& estimate)
{
  bar_ = lineOf(state_, estimate, columns());
  std::cerr << kEraseLine << bar_ << std::flush;
  drawn_ = StepRate::Clock::now();
}

std::string
ProgressBar::timeLeft() const
{
  const auto rate = rate_.perSecond();
  if (!rate)
    return {};
  const auto left = static_cast<double>(state_.total - state_.done);
  return rateText(*rate) + "  " + durationText(left / *rate) + " left";
}

void
ProgressBar::show(const Progress& progress)
{
  if (quiet_ || progress.total == 0)
    return;
  if (progress.stage != state_.stage)
    begin(progress.stage);
  state_ = progress;
  last_ = StepRate::Clock::now();
  if (!terminal_) {
    const auto quarter = static_cast<int>(4 * progress.done / progress.total);
    if (quarter != quarter_)
      std::cerr << state_.stage << ' ' << progress.done << '/' << progress.total
                << '\n';
    quarter_ = quarter;
    return;
  }
  rate_.update(progress.done, last_);
  const bool over = progress.done >= progress.total;
  if (over || last_ - drawn_ >= kRedraw)
    draw(timeLeft());
  if (over)
    end();
}

ProgressCallback
watched(const Interrupt& interrupt)
{
  return [&interrupt](const Progress&) {
    if (interrupt.requested())
      throw Interrupted();
  };
}

ProgressCallback
watched(ProgressBar& bar, const Interrupt& interrupt)
{
  return [&bar, watch = watched(interrupt)](const Progress& progress) {
    watch(progress);
    bar.show(progress);
  };
}

} // namespace pcl6d::app
