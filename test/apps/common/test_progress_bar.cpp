// SPDX-License-Identifier: BSD-3-Clause
// The progress that a run shows: on a pseudo terminal, in a file, and not at all.
#include "apps/support/corridor_run.h"
#include "common/progress_bar.h"
#include "support/folders.h"

#include <gtest/gtest.h>

#include <csignal>
#include <pty.h>
#include <regex>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <thread>

namespace {
using pcl6d::app::durationText;
using pcl6d::app::ProgressBar;
using pcl6d::app::StepRate;
using pcl6d::test::TempFolder;
using std::chrono::milliseconds;

/** A child of ours on a terminal of so many columns. */
class OnTerminal {
public:
  template <typename Body>
  OnTerminal(unsigned short columns, const char* kind, const Body& body)
  {
    winsize size{};
    size.ws_row = 25;
    size.ws_col = columns;
    pid_ = ::forkpty(&terminal_, nullptr, nullptr, &size);
    if (pid_ == 0) {
      ::setenv("TERM", kind, 1);
      body();
      ::_exit(0);
    }
  }
  ~OnTerminal() { ::close(terminal_); }
  OnTerminal(const OnTerminal&) = delete;
  OnTerminal&
  operator=(const OnTerminal&) = delete;

  /** Reads until a text has been seen, or the child has ended. */
  std::string
  readUntil(const std::string& text)
  {
    std::string read;
    char buffer[4096];
    for (ssize_t n = 0; read.find(text) == std::string::npos &&
                        (n = ::read(terminal_, buffer, sizeof(buffer))) > 0;)
      read.append(buffer, static_cast<std::size_t>(n));
    return read;
  }
  std::string
  readAll()
  {
    const std::string all = readUntil("\1");
    ::waitpid(pid_, &status_, 0);
    return all;
  }
  void
  resize(unsigned short columns)
  {
    winsize size{};
    size.ws_col = columns;
    ::ioctl(terminal_, TIOCSWINSZ, &size);
  }
  pid_t
  pid() const
  {
    return pid_;
  }
  int
  exitCode() const
  {
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
  }

private:
  int terminal_ = -1;
  pid_t pid_ = -1;
  int status_ = 0;
};

/** \return what each state of the bar was, and the lines between */
std::vector<std::string>
statesOf(const std::string& shown)
{
  const std::regex end("(\r\x1b\\[K|\r\n)+");
  std::vector<std::string> states;
  for (std::sregex_token_iterator i(shown.begin(), shown.end(), end, -1), none;
       i != none;
       ++i)
    if (i->length() > 0)
      states.push_back(*i);
  return states;
}

/** Steps of the stages one and two, each as long as a redraw takes to be due. */
void
show(ProgressBar& bar, const std::string& stage, std::size_t from, std::size_t to)
{
  for (std::size_t i = from; i <= to; ++i) {
    std::this_thread::sleep_for(milliseconds(110));
    bar.show({stage, i, 20});
  }
}

bool
matches(const std::string& text, const std::string& pattern)
{
  return std::regex_match(text, std::regex(pattern));
}
} // namespace

TEST(StepRate, IsTheMeanOfTheLastSeconds)
{
  const StepRate::Clock::time_point start;
  StepRate rate;
  EXPECT_FALSE(rate.perSecond());
  for (int i = 0; i <= 20; ++i)
    rate.update(static_cast<std::size_t>(i), start + milliseconds(500 * i));
  EXPECT_NEAR(*rate.perSecond(), 2, 1e-9);
  // Ten times as slow from now on: the older steps are soon forgotten.
  for (int i = 1; i <= 20; ++i)
    rate.update(static_cast<std::size_t>(20 + i),
                start + milliseconds(10000 + 5000 * i));
  EXPECT_NEAR(*rate.perSecond(), 0.2, 0.001);
}

TEST(StepRate, SaysNothingBeforeItKnows)
{
  const StepRate::Clock::time_point start;
  StepRate rate;
  rate.update(0, start);
  rate.update(5, start + milliseconds(900));
  EXPECT_FALSE(rate.perSecond()) << "too early";
  StepRate idle;
  idle.update(3, start);
  idle.update(3, start + milliseconds(60000));
  EXPECT_FALSE(idle.perSecond()) << "no step";
}

TEST(Duration, IsToldAsAPersonWould)
{
  EXPECT_EQ(durationText(0.4), "0 s");
  EXPECT_EQ(durationText(59.4), "59 s");
  EXPECT_EQ(durationText(59.6), "1 min 0 s");
  EXPECT_EQ(durationText(3599), "59 min 59 s");
  EXPECT_EQ(durationText(7500), "2 h 5 min");
}

TEST(ProgressBar, ShowsRateAndTimeLeftOnATerminal)
{
  OnTerminal terminal(80, "xterm", [] {
    ProgressBar bar(false);
    show(bar, "one", 1, 20);
    show(bar, "two", 1, 3);
    bar.say("a line between");
    show(bar, "two", 4, 5); // and no more: cut short
  });
  const auto states = statesOf(terminal.readAll());
  ASSERT_GE(states.size(), 25u);
  EXPECT_EQ(states[0].find("one [#"), 0u) << states[0];
  for (const auto& state : states)
    EXPECT_LT(state.size(), 80u) << state;
  // 20 steps of 110 ms; the machine may be slower, not faster.
  EXPECT_TRUE(matches(states[14], R"(one \[#+\.+\] 15/20  [1-9]\.\d/s  [0-3] s left)"))
      << states[14];
  EXPECT_TRUE(matches(states[20], R"(one \[#{40}\] 20/20  [2-9] s)")) << states[20];
  const auto line = std::find(states.begin(), states.end(), "a line between");
  ASSERT_NE(line, states.end());
  EXPECT_EQ((line - 1)->find("two ["), 0u);
  EXPECT_EQ(*(line + 1), *(line - 1)) << "the bar stands below the line again";
  EXPECT_TRUE(matches(states.back(), R"(two \[#{10}\.{30}\] 5/20  \d s)"))
      << states.back();
}

TEST(ProgressBar, NeverWrapsHoweverNarrowTheTerminalIsOrBecomes)
{
  for (const unsigned short columns : {1, 7, 20, 34, 50}) {
    OnTerminal terminal(columns, "xterm", [] {
      ProgressBar bar(false);
      show(bar, "stage", 1, 12);
    });
    for (const auto& state : statesOf(terminal.readAll()))
      EXPECT_LT(state.size(), columns) << state;
  }
  OnTerminal terminal(100, "xterm", [] {
    ProgressBar bar(false);
    show(bar, "stage", 1, 15);
  });
  const std::string wide = terminal.readUntil(" 3/20");
  terminal.resize(30);
  terminal.readUntil(" 6/20"); // one or two states may be on their way
  EXPECT_GT(statesOf(wide).back().size(), 50u);
  for (const auto& state : statesOf(terminal.readAll()))
    EXPECT_LT(state.size(), 30u) << state;
}

TEST(ProgressBar, OnADumbTerminalPrintsPlainLines)
{
  OnTerminal terminal(80, "dumb", [] {
    ProgressBar bar(false);
    show(bar, "stage", 1, 20);
    bar.warn("careful");
  });
  EXPECT_EQ(terminal.readAll(),
            "stage 1/20\r\nstage 5/20\r\nstage 10/20\r\nstage 15/20\r\nstage 20/20\r\n"
            "warning: careful\r\n");
}

TEST(ProgressBar, WhenQuietShowsWarningsOnly)
{
  OnTerminal terminal(80, "xterm", [] {
    ProgressBar bar(true);
    show(bar, "stage", 1, 2);
    bar.say("hello");
    bar.warn("careful");
  });
  EXPECT_EQ(terminal.readAll(), "warning: careful\r\n");
}

TEST(PclSlam6d, OnATerminalShowsEachStageAndWritesNoColours)
{
  const TempFolder folder;
  const std::string in = pcl6d::test::scans().string(), out = folder / "out";
  OnTerminal terminal(90, "xterm", [&] {
    ::execl(PCL6D_BIN_DIR "/pcl_slam6d",
            "pcl_slam6d",
            in.c_str(),
            "-o",
            out.c_str(),
            "--last",
            "9",
            static_cast<char*>(nullptr));
  });
  const std::string shown = terminal.readAll();
  EXPECT_EQ(terminal.exitCode(), 0) << shown;
  for (const char* stage : {"reading", "matching"})
    EXPECT_TRUE(std::regex_search(
        shown, std::regex(std::string(stage) + R"( \[#{40}\] 10/10  \d+ s\r\n)")))
        << shown;
  for (const auto& state : statesOf(shown)) {
    if (state.find("##") != std::string::npos) {
      EXPECT_LT(state.size(), 90u) << state;
    }
  }
  EXPECT_EQ(shown.find("\x1b[3"), std::string::npos) << "no colours";
}

TEST(PclSlam6d, OnATerminalStopsAtControlC)
{
  const TempFolder folder;
  const std::string in = pcl6d::test::scans().string(), out = folder / "out";
  OnTerminal terminal(90, "xterm", [&] {
    ::execl(PCL6D_BIN_DIR "/pcl_slam6d",
            "pcl_slam6d",
            in.c_str(),
            "-o",
            out.c_str(),
            static_cast<char*>(nullptr));
  });
  terminal.readUntil("matching");
  ::kill(-terminal.pid(), SIGINT); // its whole group, as the terminal does
  const std::string shown = terminal.readAll();
  EXPECT_EQ(terminal.exitCode(), 130) << shown;
  EXPECT_TRUE(std::filesystem::exists(out + "/summary.json"));
}
