// SPDX-License-Identifier: BSD-3-Clause
#include "support/temp_folder.h"

#include <boost/process.hpp>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <signal.h>
#include <string>
#include <thread>
#include <unistd.h>

namespace bp = boost::process;
namespace fs = std::filesystem;

namespace {
constexpr std::chrono::seconds kPatience(10); // for a server to end on a busy machine

/** Whether a process runs; one that nobody has waited for (a zombie) does not. */
bool
runs(int pid)
{
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string word, state;
  return static_cast<bool>(stat >> word >> word >> state) && state != "Z";
}

bool
endsSoon(int pid)
{
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (runs(pid) && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  return !runs(pid);
}

bp::environment
environmentWith(const std::string& name, const std::string& value)
{
  bp::environment environment = boost::this_process::environment();
  environment[name] = value;
  return environment;
}

/** A draw_and_wait process and the first line that it says. */
class Drawing {
public:
  Drawing(const fs::path& picture,
          const std::string& then,
          const bp::environment& environment = boost::this_process::environment())
  : process_(PCL6D_BUILD_DIR "/test/bin/draw_and_wait",
             picture.string(),
             then,
             environment,
             bp::std_out > output_,
             bp::std_err > errors_)
  {
    std::getline(output_, line_);
    std::istringstream(line_) >> server_pid_ >> display_;
  }
  ~Drawing() { end(SIGKILL); }
  Drawing(const Drawing&) = delete;
  Drawing&
  operator=(const Drawing&) = delete;

  void
  end(int signal)
  {
    if (process_.valid() && process_.running())
      ::kill(process_.id(), signal);
    wait();
  }
  int
  wait()
  {
    std::error_code ignored;
    process_.wait(ignored);
    return process_.exit_code();
  }
  std::string
  nextLine()
  {
    std::string line;
    std::getline(output_, line);
    return line;
  }
  std::string
  errors()
  {
    return {std::istreambuf_iterator<char>(errors_), {}};
  }
  int
  pid() const
  {
    return process_.id();
  }
  int
  serverPid() const
  {
    return server_pid_;
  }
  const std::string&
  display() const
  {
    return display_;
  }
  const std::string&
  line() const
  {
    return line_;
  }

private:
  bp::ipstream output_;
  bp::ipstream errors_;
  bp::child process_;
  std::string line_;
  int server_pid_ = 0;
  std::string display_;
};

fs::path
lockFile(const Drawing& drawing)
{
  return "/tmp/.X" + drawing.display().substr(1) + "-lock";
}
} // namespace

TEST(PrivateDisplay, LeavesNothingBehindAtTheEnd)
{
  const pcl6d::test::TempFolder folder;
  Drawing drawing(folder / "a.png", "end");
  EXPECT_EQ(drawing.wait(), 0) << drawing.line();
  ASSERT_GT(drawing.serverPid(), 0) << drawing.line();
  // The process waits for its server, so both are gone at once.
  EXPECT_FALSE(runs(drawing.serverPid()));
  EXPECT_FALSE(fs::exists(lockFile(drawing)));
  EXPECT_EQ(drawing.errors(), "") << "VTK must not chat";
}

TEST(PrivateDisplay, LeavesNothingBehindWhenTheProcessIsKilled)
{
  const pcl6d::test::TempFolder folder;
  for (const int signal : {SIGKILL, SIGTERM, SIGINT}) {
    Drawing drawing(folder / "a.png", "wait");
    ASSERT_GT(drawing.serverPid(), 0) << drawing.line();
    EXPECT_TRUE(runs(drawing.serverPid()));
    drawing.end(signal);
    EXPECT_TRUE(endsSoon(drawing.serverPid())) << "signal " << signal;
    EXPECT_FALSE(fs::exists(lockFile(drawing)));
  }
}

TEST(PrivateDisplay, NeitherReadsNorNeedsTheUsersDisplay)
{
  const pcl6d::test::TempFolder folder;
  const bp::environment nowhere = environmentWith("DISPLAY", ":9999");
  Drawing wrong(folder / "a.png", "end", nowhere);
  EXPECT_EQ(wrong.wait(), 0) << wrong.line();
  bp::environment unset = boost::this_process::environment();
  unset.erase("DISPLAY");
  Drawing missing(folder / "b.png", "end", unset);
  EXPECT_EQ(missing.wait(), 0) << missing.line();
  EXPECT_TRUE(fs::exists(folder / "a.png"));
  EXPECT_TRUE(fs::exists(folder / "b.png"));
}

TEST(PrivateDisplay, IsOnePerProcess)
{
  const pcl6d::test::TempFolder folder;
  Drawing first(folder / "a.png", "wait"), second(folder / "b.png", "wait");
  EXPECT_TRUE(runs(first.serverPid()));
  EXPECT_TRUE(runs(second.serverPid()));
  EXPECT_NE(first.display(), second.display());
  first.end(SIGKILL);
  EXPECT_TRUE(endsSoon(first.serverPid()));
  EXPECT_TRUE(runs(second.serverPid())) << "must not depend on the other";
}

TEST(PrivateDisplay, KeepsNoFileOfOursOpenAndNoTerminal)
{
  const pcl6d::test::TempFolder folder;
  const Drawing drawing(folder / "a.png", "wait");
  ASSERT_GT(drawing.serverPid(), 0) << drawing.line();
  EXPECT_NE(::getsid(drawing.serverPid()), ::getsid(drawing.pid()));
  const std::string proc = "/proc/" + std::to_string(drawing.pid()) + "/fd/";
  const std::string server = "/proc/" + std::to_string(drawing.serverPid()) + "/fd";
  for (const char* file : {"1", "2"}) {
    const fs::path ours = fs::read_symlink(proc + file);
    for (const auto& entry : fs::directory_iterator(server))
      EXPECT_NE(fs::read_symlink(entry.path()), ours);
  }
}

TEST(PrivateDisplay, WithoutXvfbNamesThePackage)
{
  const pcl6d::test::TempFolder folder;
  Drawing drawing(
      folder / "a.png", "end", environmentWith("PATH", folder.path().string()));
  EXPECT_EQ(drawing.wait(), 1);
  EXPECT_NE(drawing.line().find("install the package xvfb"), std::string::npos)
      << drawing.line();
  EXPECT_FALSE(fs::exists(folder / "a.png"));
}

TEST(PrivateDisplay, ThatDoesNotStartIsAnError)
{
  const pcl6d::test::TempFolder folder;
  pcl6d::test::writeText(folder / "Xvfb", "#!/bin/sh\nexit 1\n");
  fs::permissions(folder / "Xvfb", fs::perms::owner_all);
  Drawing drawing(
      folder / "a.png", "end", environmentWith("PATH", folder.path().string()));
  EXPECT_EQ(drawing.wait(), 1);
  EXPECT_NE(drawing.line().find("Xvfb did not start"), std::string::npos)
      << drawing.line();
}

TEST(PrivateDisplay, ThatEndedBeforeUsIsAnError)
{
  const pcl6d::test::TempFolder folder;
  Drawing drawing(folder / "a.png", "kill-server");
  const std::string message = drawing.nextLine();
  EXPECT_EQ(drawing.wait(), 1);
  EXPECT_NE(message.find("has ended"), std::string::npos) << message;
}
