// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d --live-view, on a private X server in the place of the user's display.
#include "apps/support/corridor_run.h"
#include "support/folders.h"
#include "support/x_server.h"

#include <boost/process.hpp>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>

namespace {
namespace bp = boost::process;
namespace fs = std::filesystem;
using pcl6d::test::readText;
using pcl6d::test::scans;
using pcl6d::test::soon;
using pcl6d::test::TempFolder;
using pcl6d::test::XServer;

/** A run with a live view. */
class LiveRun {
public:
  explicit LiveRun(const std::string& display, const std::string& last = "12")
  : process_(PCL6D_BIN_DIR "/pcl_slam6d",
             bp::args = {scans().string(),
                         "-o",
                         (folder_ / "out").string(),
                         "--last",
                         last,
                         "--live-view"},
             environment(display),
             bp::std_out > (folder_ / "stdout").string(),
             bp::std_err > (folder_ / "stderr").string())
  {}
  ~LiveRun()
  {
    std::error_code ignored;
    process_.terminate(ignored);
  }
  LiveRun(const LiveRun&) = delete;
  LiveRun&
  operator=(const LiveRun&) = delete;

  std::string
  errors() const
  {
    return readText(folder_ / "stderr");
  }
  bool
  hasSaid(const std::string& words) const
  {
    return errors().find(words) != std::string::npos;
  }
  void
  signal(int number)
  {
    ::kill(process_.id(), number);
  }
  int
  exitCode()
  {
    process_.wait();
    return process_.exit_code();
  }
  fs::path
  out() const
  {
    return folder_ / "out";
  }

private:
  static bp::environment
  environment(const std::string& display)
  {
    bp::environment environment = boost::this_process::environment();
    environment["DISPLAY"] = display;
    return environment;
  }

  TempFolder folder_;
  bp::child process_;
};

std::size_t
brightPixels(const XServer& server)
{
  return server.count([](const XServer::Colour& c) {
    const auto [low, high] = std::minmax({c[0], c[1], c[2]});
    return high > 150 && high - low > 60;
  });
}
} // namespace

TEST(PclSlam6dLive, ShowsTheMapWhileItGrowsAndAtTheEndUntilTheWindowIsClosed)
{
  const XServer server;
  LiveRun run(server.name());
  ASSERT_TRUE(soon([&] { return run.hasSaid("matching 4/13"); })) << run.errors();
  EXPECT_EQ(server.windows().size(), 1u);
  EXPECT_TRUE(soon([&] { return brightPixels(server) > 2000; }));
  ASSERT_TRUE(soon([&] { return run.hasSaid("close the window"); })) << run.errors();
  EXPECT_TRUE(fs::exists(run.out() / "summary.json"))
      << "all is written before the wait";
  EXPECT_TRUE(fs::exists(run.out() / "top_view.png"));
  EXPECT_GT(brightPixels(server), 2000u);
  server.close(server.windows().at(0));
  EXPECT_EQ(run.exitCode(), 0) << run.errors();
  EXPECT_TRUE(server.windows().empty());
}

TEST(PclSlam6dLive, GoesOnWhenTheWindowIsClosedOrItsClientCutOff)
{
  for (const bool kindly : {true, false}) {
    const XServer server;
    LiveRun run(server.name());
    ASSERT_TRUE(soon([&] { return run.hasSaid("reading 13/13"); })) << run.errors();
    ASSERT_EQ(server.windows().size(), 1u);
    if (kindly)
      server.close(server.windows()[0]);
    else
      server.cutOff(server.windows()[0]);
    EXPECT_EQ(run.exitCode(), 0) << run.errors();
    EXPECT_FALSE(run.hasSaid("close the window"));
    EXPECT_TRUE(fs::exists(run.out() / "top_view.png"));
  }
}

TEST(PclSlam6dLive, StopsAtControlCAsWithoutAWindow)
{
  const XServer server;
  LiveRun run(server.name(), "39");
  ASSERT_TRUE(soon([&] { return run.hasSaid("matching"); })) << run.errors();
  run.signal(SIGINT);
  EXPECT_EQ(run.exitCode(), 130) << run.errors();
  EXPECT_TRUE(fs::exists(run.out() / "summary.json"));
  EXPECT_TRUE(server.windows().empty());
}

TEST(PclSlam6dLive, EndsTheWaitAtControlC)
{
  const XServer server;
  LiveRun run(server.name(), "2");
  ASSERT_TRUE(soon([&] { return run.hasSaid("close the window"); })) << run.errors();
  run.signal(SIGINT);
  EXPECT_EQ(run.exitCode(), 0) << "the run was complete: " << run.errors();
}

TEST(PclSlam6dLive, LeavesNoWindowWhenItIsKilled)
{
  const XServer server;
  LiveRun run(server.name(), "39");
  ASSERT_TRUE(soon([&] { return server.windows().size() == 1; })) << run.errors();
  run.signal(SIGKILL);
  run.exitCode();
  EXPECT_TRUE(soon([&] { return server.windows().empty(); }));
}

TEST(PclSlam6dLive, WithoutADisplaySaysSoFirstAndRuns)
{
  for (const std::string display : {"", ":9999"}) {
    LiveRun run(display, "2");
    EXPECT_EQ(run.exitCode(), 0) << run.errors();
    EXPECT_EQ(run.errors().find("warning: no live view: "), 0u) << run.errors();
    EXPECT_TRUE(run.hasSaid("the run goes on without\n"));
    EXPECT_TRUE(fs::exists(run.out() / "map.pcd"));
  }
}
