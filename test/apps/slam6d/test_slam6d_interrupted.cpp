// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d when it cannot do all: interrupted, without a display, without poses.
#include "apps/support/corridor_run.h"
#include "support/folders.h"
#include "support/signalled_program.h"

#include <pcl6d/io/trajectory_io.h>

#include <boost/process.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <set>
#include <thread>

namespace {
namespace bp = boost::process;
namespace fs = std::filesystem;
using pcl6d::test::contentOf;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::scans;
using pcl6d::test::slam;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;
} // namespace

TEST(PclSlam6d, WithoutXvfbTheRunIsWholeAndSaysThatThePictureIsMissing)
{
  const TempFolder folder;
  const std::string err = folder / "err", out = folder / "out";
  const int code =
      bp::system(PCL6D_BIN_DIR "/pcl_slam6d",
                 bp::args = {scans().string(), "-o", out, "--last", "1", "--quiet"},
                 bp::env["PATH"] = folder.path().string(),
                 bp::std_err > err);
  EXPECT_EQ(code, 3);
  for (const auto& word :
       {std::string("not drawn: top_view.png"), std::string("xvfb"), "--draw " + out})
    EXPECT_NE(readText(err).find(word), std::string::npos) << readText(err);
  const auto json = nlohmann::json::parse(readText(folder / "out" / "summary.json"));
  EXPECT_EQ(json["warnings"].size(), 0u);
  EXPECT_TRUE(json["verdict"]["complete"]);
  EXPECT_FALSE(fs::exists(folder / "out" / "top_view.png"));
  EXPECT_TRUE(fs::exists(folder / "out" / "map.pcd"));
  const Outcome again = pcl6d::test::runProgram("pcl_slam6d", {"--draw", out});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(fs::exists(folder / "out" / "top_view.png"));
}

TEST(PclSlam6d, AServerOfPicturesThatDiesCostsThePicturesAlone)
{
  const std::string real = bp::search_path("Xvfb").string();
  if (real.empty())
    GTEST_SKIP() << "no Xvfb";
  for (const char* const delay : {"0.02", "0.2", "0.4", "0.6"}) {
    SCOPED_TRACE(delay);
    const TempFolder folder;
    const fs::path out = folder / "out", server = folder / "Xvfb";
    writeText(server,
              "#!/bin/sh\n" + real + " \"$@\" &\nsleep " + delay + "\nkill -KILL $!\n");
    fs::permissions(server, fs::perms::owner_all);
    const int code = bp::system(
        PCL6D_BIN_DIR "/pcl_slam6d",
        bp::args = {scans().string(), "-o", out.string(), "--last", "1", "--quiet"},
        bp::env["PATH"] = folder.path().string() + ":/usr/bin:/bin",
        bp::std_err > (folder / "err").string());
    const bool is_drawn = fs::exists(out / "top_view.png"); // it was quicker
    const std::string said = readText(folder / "err");
    EXPECT_EQ(code, is_drawn ? 0 : 3) << said;
    EXPECT_EQ(said.find("not drawn: top_view.png") == std::string::npos, is_drawn);
    EXPECT_TRUE(fs::exists(out / "map.pcd"));
    EXPECT_EQ(pcl6d::readTrajectory(out / "trajectory.kitti").poses.size(), 2u);
  }
}

TEST(PclSlam6d, InterruptedItGoesBesideACompleteRun)
{
  const TempFolder folder;
  const fs::path out = folder / "out";
  const Outcome first = slam(scans(), out, {"--last", "2", "--no-picture"});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const auto before = contentOf(out);
  const std::string err = folder / "err";
  const int code =
      pcl6d::test::signalledAt("matching",
                               SIGINT,
                               "pcl_slam6d",
                               {scans().string(), "-o", out.string(), "--last", "17"},
                               err);
  EXPECT_EQ(code, 130) << readText(err);
  auto after = contentOf(out);
  after.erase(".pcl6d-journal");
  EXPECT_EQ(after, before);
  EXPECT_NE(readText(err).find("keeps the complete run"), std::string::npos)
      << readText(err);
  const auto json =
      nlohmann::json::parse(readText(folder / "out.partial" / "summary.json"));
  EXPECT_FALSE(json["verdict"]["complete"]);
}

TEST(PclSlam6d, WarnsWhenThereAreNoInitialPoses)
{
  const TempFolder folder;
  fs::create_directory(folder / "in");
  writeText(folder / "in" / "scan0.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
  fs::copy(folder / "in" / "scan0.xyz", folder / "in" / "scan1.xyz");
  const Outcome outcome = slam(folder / "in", folder / "out");
  EXPECT_NE(outcome.err.find("warning: no initial poses"), std::string::npos)
      << outcome.err;
}

TEST(PclSlam6d, InterruptedWhileWritingLeavesPosesAndNoScans)
{
  const TempFolder folder;
  const fs::path out = folder / "out";
  const std::string err = folder / "err";
  bp::child program(PCL6D_BIN_DIR "/pcl_slam6d",
                    bp::args = {scans().string(), "-o", out.string(), "--last", "17"},
                    bp::std_out > bp::null,
                    bp::std_err > err);
  while (program.running() && readText(err).find("matching 18/18") == std::string::npos)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  ::kill(program.id(), SIGINT);
  program.wait();
  EXPECT_EQ(program.exit_code(), 130) << readText(err);
  const auto json = nlohmann::json::parse(readText(out / "summary.json"));
  EXPECT_FALSE(json["verdict"]["complete"]);
  EXPECT_EQ(json["scans"][17]["state"], "matched");
  EXPECT_FALSE(fs::exists(out / "scans"));
  EXPECT_FALSE(fs::exists(out / "map.pcd"));
}

TEST(PclSlam6d, InterruptedWritesPosesSoFarAndMarksThemPartial)
{
  const TempFolder folder;
  const fs::path out = folder / "out";
  bp::child program(PCL6D_BIN_DIR "/pcl_slam6d",
                    bp::args = {scans().string(), "-o", out.string(), "--threads", "1"},
                    bp::std_out > bp::null,
                    bp::std_err > (folder / "err").string());
  // Wait until the first scans are matched.
  for (int i = 0; i < 600 && program.running(); ++i) {
    if (readText(folder / "err").find("matching") != std::string::npos)
      break;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  ::kill(program.id(), SIGINT);
  program.wait();
  EXPECT_EQ(program.exit_code(), 130) << readText(folder / "err");
  const auto json = nlohmann::json::parse(readText(out / "summary.json"));
  EXPECT_FALSE(json["verdict"]["complete"]);
  EXPECT_EQ(json["scans"][39]["state"], "pending");
  EXPECT_EQ(pcl6d::readTrajectory(out / "trajectory.kitti").poses.size(), 40u);
  std::set<std::string> names;
  for (const auto& [name, content] : contentOf(out))
    if (name.find('/') == std::string::npos)
      names.insert(name);
  EXPECT_EQ(names,
            (std::set<std::string>{".pcl6d-journal",
                                   "frames",
                                   "summary.json",
                                   "trajectory.kitti",
                                   "trajectory.tum"}));
}
