// SPDX-License-Identifier: BSD-3-Clause
#include "drawing.h"
#include "support/folders.h"
#include "support/temp_folder.h"

#include <boost/process.hpp>
#include <gtest/gtest.h>

#include <unistd.h>

namespace {
using namespace pcl6d::test;
} // namespace

TEST(PrivateDisplay, LeavesNothingBehindAtTheEnd)
{
  const TempFolder folder;
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
  const TempFolder folder;
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
  const TempFolder folder;
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
  const TempFolder folder;
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
  const TempFolder folder;
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
  const TempFolder folder;
  Drawing drawing(
      folder / "a.png", "end", environmentWith("PATH", folder.path().string()));
  EXPECT_EQ(drawing.wait(), 1);
  EXPECT_NE(drawing.line().find("install the package xvfb"), std::string::npos)
      << drawing.line();
  EXPECT_FALSE(fs::exists(folder / "a.png"));
}

TEST(PrivateDisplay, ThatDoesNotStartIsAnError)
{
  const TempFolder folder;
  writeText(folder / "Xvfb", "#!/bin/sh\nexit 1\n");
  fs::permissions(folder / "Xvfb", fs::perms::owner_all);
  Drawing drawing(
      folder / "a.png", "end", environmentWith("PATH", folder.path().string()));
  EXPECT_EQ(drawing.wait(), 1);
  EXPECT_NE(drawing.line().find("Xvfb did not start"), std::string::npos)
      << drawing.line();
}

TEST(PrivateDisplay, ThatNeverAnswersIsAnErrorAfterItsTime)
{
  const TempFolder folder; // the server halts as soon as it can be connected to
  writeText(folder / "Xvfb",
            "#!/bin/sh\n"
            "cd \"$(/usr/bin/dirname \"$0\")\"\n"
            "/usr/bin/Xvfb \"$@\" > number &\n"
            "until [ -s number ]; do /bin/sleep 0.1; done\n"
            "kill -STOP $!\n"
            "/bin/cat number\n"
            "wait\n");
  fs::permissions(folder / "Xvfb", fs::perms::owner_all);
  Drawing drawing(
      folder / "a.png", "end", environmentWith("PATH", folder.path().string()));
  EXPECT_EQ(drawing.wait(), 1);
  EXPECT_NE(drawing.line().find("Xvfb did not start within"), std::string::npos)
      << drawing.line();
}

TEST(PrivateDisplay, ThatEndedBeforeUsIsAnError)
{
  const TempFolder folder;
  Drawing drawing(folder / "a.png", "kill-server");
  const std::string message = drawing.nextLine();
  EXPECT_EQ(drawing.wait(), 1);
  EXPECT_NE(message.find("has ended"), std::string::npos) << message;
}

TEST(PrivateDisplay, SaysThatItCannotStartForWantOfDescriptors)
{
  const TempFolder folder;
  const std::string said = folder / "said";
  int times = 0;
  for (int most = 5; most <= 9; ++most) {
    const std::string command = "ulimit -n " + std::to_string(most) +
                                "; exec " PCL6D_BUILD_DIR
                                "/test/bin/draw_and_wait a.png end";
    const int code = bp::system(bp::exe = "/bin/sh",
                                bp::args = {"-c", command},
                                bp::start_dir = folder.path().string(),
                                bp::std_out > said);
    if (code == 127) // not even libraries can be opened
      continue;
    ++times;
    std::ifstream file(said);
    std::string line;
    std::getline(file, line);
    EXPECT_EQ(code, 1) << line;
    EXPECT_TRUE(line.rfind("cannot draw pictures: ", 0) == 0 ||
                line.rfind("cannot start ", 0) == 0)
        << line;
  }
  EXPECT_GT(times, 0);
}
