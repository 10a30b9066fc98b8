// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d --join: what cannot be joined is refused in words, and nothing is written.
#include "apps/support/joined_rooms.h"
#include "apps/support/program_names.h"
#include "support/signalled_program.h"

#include <boost/process.hpp>

#include <csignal>
#include <thread>

namespace {
namespace fs = std::filesystem;
namespace bp = boost::process;
using pcl6d::test::contentOf;
using pcl6d::test::expectError;
using pcl6d::test::Join;
using pcl6d::test::kMonday;
using pcl6d::test::kSlam6d;
using pcl6d::test::kTuesday;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::runProgram;
using pcl6d::test::writeText;
using Drive = pcl6d::test::JoinedRooms::Drive;

} // namespace

TEST_F(Join, RefusesRunsThatDoNotMeet)
{
  Drive elsewhere{{0, 2, 4}, kTuesday};
  elsewhere.room.walls = {Eigen::Vector3d(-3, -2, -1), Eigen::Vector3d(17, 2, 3)};
  elsewhere.room.pillars = {{Eigen::Vector3d(6, -2, -1), Eigen::Vector3d(7, -1, 3)}};
  rooms().run("elsewhere", elsewhere);
  expectRefused({"monday", "elsewhere"},
                "nothing",
                1,
                {"elsewhere", "does not meet", "monday", "nothing is written"});
}

TEST_F(Join, RefusesRunsThatMeetInSeveralWays)
{
  Drive half{{0, 2}, kMonday}; // half a turn maps the room to itself
  half.room.walls = {Eigen::Vector3d(-5, -4, -1), Eigen::Vector3d(5, 4, 2)};
  half.room.pillars = {{Eigen::Vector3d(-3, -2, -1), Eigen::Vector3d(-2, -1, 2)},
                       {Eigen::Vector3d(2, 1, -1), Eigen::Vector3d(3, 2, 2)}};
  Drive other = half;
  other.places = {3, 5};
  other.T_world_room = kTuesday;
  other.seed = 5;
  rooms().run("half", half);
  rooms().run("other_half", other);
  expectRefused({"half", "other_half"}, "nothing", 1, {"other_half", "nearly as well"});
}

TEST_F(Join, RefusesTheSameScans)
{
  fs::copy(rooms() / "monday", rooms() / "copy", fs::copy_options::recursive);
  expectRefused(
      {"monday", "copy"}, "nothing", 1, {"copy", "3 scans", "identical points"});
  expectRefused({"monday", "monday/../monday"}, "nothing", 2, {"one folder"});
}

TEST_F(Join, RefusesOtherUnitsAndNamesThem)
{
  Drive millimetres{{5, 3}, kTuesday};
  millimetres.unit = 1e-3;
  rooms().run("millimetres", millimetres);
  expectRefused({"monday", "millimetres"},
                "nothing",
                1,
                {"millimetres: its scans reach",
                 "times as far",
                 "as if they were in millimetres"});
  expectRefused(
      {"millimetres", "monday"}, "nothing", 1, {"as if they were in millimetres"});
}

TEST_F(Join, RefusesWhatIsNoFinishedRun)
{
  expectRefused({"monday", "tuesday.scans"}, "nothing", 1, {"summary.json"});
  expectRefused({"monday", "missing"}, "nothing", 1, {"missing"});
  fs::copy(rooms() / "tuesday", rooms() / "stopped", fs::copy_options::recursive);
  auto summary = rooms().summary("stopped");
  summary["verdict"]["complete"] = false;
  writeText(rooms() / "stopped/summary.json", summary.dump());
  expectRefused({"monday", "stopped"}, "nothing", 1, {"interrupted", "then join"});
  const fs::path scan = rooms() / "damaged/scans/scan001.pcd";
  fs::copy(rooms() / "tuesday", rooms() / "damaged", fs::copy_options::recursive);
  std::string bytes = readText(scan);
  bytes[bytes.size() / 2] ^= 1;
  writeText(scan, bytes);
  expectRefused({"monday", "damaged"}, "nothing", 1, {"scan001.pcd"});
  fs::remove(scan);
  expectRefused({"damaged", "monday"}, "nothing", 1, {"scan001.pcd"});
}

TEST_F(Join, NeverWritesIntoARun)
{
  expectRefused({"monday", "tuesday"}, "monday", 1, {"monday", "input"});
  expectRefused({"monday", "tuesday"}, "tuesday", 1, {"tuesday", "input"});
  expectRefused({"monday", "tuesday"}, "monday/inside", 1, {"lies inside", "monday"});
  expectRefused({"monday", "tuesday"}, ".", 1, {"lies inside the output folder"});
}

TEST_F(Join, RefusesACommandLineThatMakesNoSense)
{
  expectRefused({"monday"}, "nothing", 2, {"--join", "two finished runs"});
  const std::string a = rooms() / "monday", b = rooms() / "tuesday";
  const auto usage = [](std::vector<std::string> words) {
    words.insert(words.end(), {"-o", (rooms() / "nothing").string()});
    return runProgram(kSlam6d, words);
  };
  expectError(usage({a, b}), kSlam6d, 2, {"SCAN_DIR", "--join"});
  expectError(usage({"--join", a, b, "--continue", a}), kSlam6d, 2, {"contradict"});
  EXPECT_FALSE(fs::exists(rooms() / "nothing"));
  const Outcome outcome =
      rooms().join({"monday", "tuesday"}, "extra", {"--first", "1", "--no-picture"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("no effect in this run: --first"), std::string::npos)
      << outcome.err;
}

TEST_F(Join, InterruptedItWritesNothing)
{
  const std::string err = rooms() / "err", out = rooms() / "nothing";
  const auto interrupted = [&] {
    fs::remove_all(out);
    return pcl6d::test::signalledAt("comparing",
                                    SIGINT,
                                    kSlam6d,
                                    {"--join",
                                     rooms() / "monday",
                                     rooms() / "tuesday",
                                     "-o",
                                     out,
                                     "--threads",
                                     "1"},
                                    err);
  };
  int code = interrupted(); // on a busy machine the signal may come when all is done
  for (int i = 0; i < 10 && (code == 0 || code == 3); ++i)
    code = interrupted();
  EXPECT_EQ(code, 130) << readText(err);
  EXPECT_NE(readText(err).find("nothing is written"), std::string::npos)
      << readText(err);
  EXPECT_FALSE(fs::exists(out));
}
