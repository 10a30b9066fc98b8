// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d that is killed, and started again.
#include "apps/support/corridor_run.h"
#include "support/folders.h"
#include "support/signalled_program.h"

#include <boost/process.hpp>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <regex>
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
using pcl6d::test::withoutTimes;

const std::vector<std::string> kOptions = {"--last", "14", "--no-picture"};

const std::map<std::string, std::string>&
undisturbed()
{
  static const std::map<std::string, std::string> files =
      pcl6d::test::filesAlone(kOptions);
  return files;
}

class Resume : public testing::Test {
protected:
  /** Starts a run and ends it with a signal when a line appears. */
  int
  endAt(const std::string& line, int signal)
  {
    std::vector<std::string> arguments = {scans().string(), "-o", out.string()};
    arguments.insert(arguments.end(), kOptions.begin(), kOptions.end());
    const std::string err = folder / "err";
    return pcl6d::test::signalledAt(line, signal, "pcl_slam6d", arguments, err);
  }

  Outcome
  again(std::vector<std::string> more = {}) const
  {
    more.insert(more.begin(), kOptions.begin(), kOptions.end());
    return slam(scans(), out, more);
  }

  const TempFolder folder;
  const fs::path out = folder / "out", journal = out / ".pcl6d-journal";
};
} // namespace

TEST_F(Resume, KilledAtAnyMomentItEndsWithTheBytesOfAnUndisturbedRun)
{
  for (const std::string line :
       {"reading 15/15", "matching 8/15", "matching 15/15", "relaxing", "writing"}) {
    fs::remove_all(out);
    endAt(line, SIGKILL);
    EXPECT_FALSE(fs::exists(out / "summary.json")) << line;
    const Outcome outcome = again();
    EXPECT_EQ(outcome.exit_code, 0) << line << outcome.err;
    EXPECT_EQ(withoutTimes(out), undisturbed()) << line;
    EXPECT_FALSE(fs::exists(journal)) << line;
  }
}

TEST_F(Resume, SaysHowMuchWasDone)
{
  endAt("matching 15/15", SIGKILL);
  ASSERT_TRUE(fs::exists(journal));
  const Outcome outcome = again({"--resume"});
  EXPECT_NE(outcome.err.find("going on with an interrupted run: matched 15 scans"),
            std::string::npos)
      << outcome.err;
}

TEST_F(Resume, StoppedByTheUserItGoesOnToo)
{
  EXPECT_EQ(endAt("matching 15/15", SIGINT), 130);
  EXPECT_TRUE(fs::exists(journal));
  EXPECT_NE(readText(folder / "err").find("the same command goes on"),
            std::string::npos);
  const Outcome outcome = again();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(withoutTimes(out), undisturbed());
}

TEST_F(Resume, OtherOptionsAreRefusedAndFreshDropsWhatWasDone)
{
  endAt("matching 15/15", SIGKILL);
  ASSERT_TRUE(fs::exists(journal));
  const Outcome refused = again({"--min-overlap", "0.2"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(
      refused.err.find("--min-overlap was 0.1, and is 0.2 now (--fresh drops it)"),
      std::string::npos)
      << refused.err;
  EXPECT_TRUE(fs::exists(journal));
  const Outcome fresh = again({"--min-overlap", "0.2", "--fresh"});
  EXPECT_EQ(fresh.exit_code, 0) << fresh.err;
  EXPECT_EQ(fresh.err.find("going on"), std::string::npos) << fresh.err;
}

TEST_F(Resume, WhatFailedForItsOptionsLeavesNothingThatRefusesBetterOnes)
{
  const Outcome failed = again({"--voxel", "1e100"});
  EXPECT_EQ(failed.exit_code, 1) << failed.err;
  EXPECT_FALSE(fs::exists(out)) << "the folder was not there before";
  EXPECT_EQ(again().exit_code, 0);
}

TEST_F(Resume, NothingToGoOnWithIsSaid)
{
  const Outcome outcome = again({"--resume"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("no interrupted run to go on with"), std::string::npos)
      << outcome.err;
  const Outcome both = again({"--resume", "--fresh"});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_NE(both.err.find("--resume and --fresh contradict"), std::string::npos)
      << both.err;
}

TEST_F(Resume, KilledWhileFilesMoveToTheirPlacesItGoesOnToo)
{
  endAt("matching 15/15", SIGKILL);
  ASSERT_TRUE(fs::exists(journal));
  fs::create_directories(out / "frames"); // as after the first renames
  std::ofstream(out / "frames" / "scan000.frames") << "half";
  std::ofstream(out / "map.pcd") << "half";
  const Outcome outcome = again();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(withoutTimes(out), undisturbed());
}

TEST_F(Resume, AForeignFileBesideTheJournalIsStillRefused)
{
  endAt("matching 15/15", SIGKILL);
  std::ofstream(out / "notes.txt") << "mine";
  const Outcome outcome = again();
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(fs::exists(journal));
  EXPECT_TRUE(fs::exists(out / "notes.txt"));
}

TEST_F(Resume, ARunThatGoesOnInItsOwnFolderIsNotReplacedByAPart)
{
  ASSERT_EQ(slam(scans(), out, {"--last", "9", "--no-picture"}).exit_code, 0);
  const auto before = contentOf(out);
  const std::string err = folder / "err";
  const std::vector<std::string> arguments = {
      scans().string(), "--continue", out.string(), "--last", "30", "--no-picture"};
  const int code =
      pcl6d::test::signalledAt("matching", SIGINT, "pcl_slam6d", arguments, err);
  EXPECT_EQ(code, 130) << readText(err);
  auto after = contentOf(out);
  after.erase(".pcl6d-journal");
  EXPECT_EQ(after, before);
  const Outcome outcome = pcl6d::test::runProgram("pcl_slam6d", arguments);
  EXPECT_NE(outcome.exit_code, 1) << outcome.err;
  EXPECT_TRUE(fs::exists(out / "scans" / "scan030.pcd")) << outcome.err;
  EXPECT_FALSE(fs::exists(journal));
}

TEST_F(Resume, TwoRunsIntoOneFolderAreOneTooMany)
{
  const std::string err = folder / "err";
  bp::child program(PCL6D_BIN_DIR "/pcl_slam6d",
                    bp::args = {scans().string(), "-o", out.string(), "--no-picture"},
                    bp::std_out > bp::null,
                    bp::std_err > err);
  while (program.running() && readText(err).find("reading") == std::string::npos)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  const Outcome outcome = again();
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("another run is writing into this folder"),
            std::string::npos)
      << outcome.err;
  program.terminate();
  program.wait();
}
