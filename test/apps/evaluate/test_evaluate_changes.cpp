// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_evaluate changes: what differs between two runs of one room, each in a world of
// its own, and what is refused.
#include "apps/support/joined_rooms.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace {
namespace fs = std::filesystem;
using namespace pcl6d;
using namespace pcl6d::test;
using Drive = JoinedRooms::Drive;
using Json = nlohmann::json;
using Vector = Eigen::Vector3d;

constexpr const char* kName = "pcl_slam6d_evaluate";
const Eigen::AlignedBox3d kCrate(Vector(-1, 2.4, -1), Vector(-0.2, 3.2, 0));
const Eigen::AlignedBox3d kCase(Vector(2.2, -3.4, -1), Vector(2.8, -2.2, -0.3));

PillarRoom
roomWith(const std::vector<Eigen::AlignedBox3d>& more)
{
  PillarRoom room = closetRoom();
  room.pillars.insert(room.pillars.end(), more.begin(), more.end());
  return room;
}

class EvaluateChanges : public testing::Test {
protected:
  static void
  SetUpTestSuite()
  {
    rooms_ = new JoinedRooms;
    rooms_->run("before", {{0, 2, 4}, kMonday, 0.03, "scan", roomWith({kCrate})});
    Drive after{{5, 3, 1}, kTuesday, 0.04, "scan", roomWith({kCase})};
    after.seed = 8;
    rooms_->run("after", after);
    Drive again{{1, 3, 5}, kTuesday, 0.03, "scan", roomWith({kCrate})};
    again.seed = 5;
    rooms_->run("again", again);
  }
  static void
  TearDownTestSuite()
  {
    delete rooms_;
    rooms_ = nullptr;
  }

  static const JoinedRooms&
  rooms()
  {
    return *rooms_;
  }
  static Outcome
  changes(const std::string& a,
          const std::string& b,
          const std::vector<std::string>& more = {})
  {
    std::vector<std::string> all{
        "changes", rooms() / a, rooms() / b, "--voxel", "0.12"};
    all.insert(all.end(), more.begin(), more.end());
    return runProgram(kName, all);
  }
  static Json
  json(const std::string& file)
  {
    return Json::parse(readText(rooms() / file));
  }

  /** \return a place of the room in the world of a run, as its first scan has it */
  static Vector
  inWorld(const std::string& run, int first_place, const Vector& in_room)
  {
    return rooms().poses(run)[0] * placeInRoom(first_place).inverse() * in_room;
  }

  static Vector
  centreOf(const Json& change)
  {
    const auto& c = change["box"]["centre"];
    return Vector(c[0].get<double>(), c[1].get<double>(), c[2].get<double>());
  }

  static JoinedRooms* rooms_;
};
JoinedRooms* EvaluateChanges::rooms_ = nullptr;
} // namespace

TEST_F(EvaluateChanges, TellsWhatVanishedAndAppearedInTheWorldOfTheFirst)
{
  const Outcome outcome = changes("before", "after", {"-o", rooms() / "told"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
  EXPECT_NE(outcome.out.find("0 moved, 1 appeared, 1 vanished, 0 shifted"),
            std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("placed without a guess"), std::string::npos);
  for (const char* file : {"changes.json", "changes.ply", "changes.png"})
    EXPECT_TRUE(fs::exists(rooms() / "told" / file)) << file;
  const Json told = json("told/changes.json");
  EXPECT_EQ(told["schema_version"], 2);
  EXPECT_EQ(told["world"]["source"], "search");
  ASSERT_EQ(told["changes"].size(), 2u);
  // Half of a thing is seen from where the scanner stood, or a little more.
  const double kHalf = 0.5; // [m]
  const Json& appeared = told["changes"][0];
  EXPECT_EQ(appeared["kind"], "appeared");
  EXPECT_LT((centreOf(appeared) - inWorld("before", 0, kCase.center())).norm(), kHalf);
  const Json& vanished = told["changes"][1];
  EXPECT_EQ(vanished["kind"], "vanished");
  EXPECT_LT((centreOf(vanished) - inWorld("before", 0, kCrate.center())).norm(), kHalf);
  EXPECT_GT(vanished["confidence"].get<double>(), 0.99);
  EXPECT_GT(vanished["box"]["volume"].get<double>(), 0);
  EXPECT_GT(told["first"]["changed"].get<int>(), 20);
  EXPECT_GT(told["surfaces"]["core_points"].get<int>(), 100);
}

TEST_F(EvaluateChanges, FindsNoneInARoomThatIsAsItWas)
{
  const Outcome outcome =
      changes("before", "again", {"--json", rooms() / "again.json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
  EXPECT_NE(outcome.out.find("0 moved, 0 appeared, 0 vanished, 0 shifted"),
            std::string::npos)
      << outcome.out;
  const Json told = json("again.json");
  EXPECT_TRUE(told["changes"].empty());
  EXPECT_EQ(told["first"]["changed"], 0);
  EXPECT_EQ(told["second"]["changed"], 0);
}

TEST_F(EvaluateChanges, FindsNoneBetweenARunAndItself)
{
  const Outcome outcome = changes("before", "before", {"--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
  EXPECT_NE(outcome.out.find("by scans in both runs"), std::string::npos);
  EXPECT_NE(outcome.out.find("0 moved, 0 appeared, 0 vanished, 0 shifted"),
            std::string::npos);
}

TEST_F(EvaluateChanges, AreTheSameForAnyNumberOfThreads)
{
  for (const char* threads : {"1", "3"})
    ASSERT_EQ(changes("before",
                      "after",
                      {"--threads",
                       threads,
                       "--quiet",
                       "--json",
                       rooms() / (std::string("by") + threads + ".json")})
                  .exit_code,
              0);
  EXPECT_EQ(readText(rooms() / "by1.json"), readText(rooms() / "by3.json"));
}

TEST_F(EvaluateChanges, AreMirroredWhenTheRunsChangePlaces)
{
  ASSERT_EQ(changes("after", "before", {"--quiet", "--json", rooms() / "back.json"})
                .exit_code,
            0);
  const Json told = json("back.json");
  ASSERT_EQ(told["changes"].size(), 2u);
  EXPECT_EQ(told["changes"][0]["kind"], "appeared");
  EXPECT_LT(
      (centreOf(told["changes"][0]) - inWorld("after", 5, kCrate.center())).norm(),
      0.5);
}

TEST_F(EvaluateChanges, TellsOfNoneWhereGivenPosesAreNotToBeBelieved)
{
  const Outcome outcome =
      changes("before", "after", {"--given", "-o", rooms() / "given"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("the pose in"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("is doubtful: "), std::string::npos);
  EXPECT_EQ(outcome.out.find("vanished"), std::string::npos);
  EXPECT_FALSE(fs::exists(rooms() / "given"));
}

TEST_F(EvaluateChanges, RefusesRunsThatDoNotMeet)
{
  PillarRoom other;
  other.walls = {Vector(-3, -3, -1), Vector(9, 2.5, 3)};
  other.pillars = {{Vector(-2, -2.5, -1), Vector(-1, -1.2, 1)},
                   {Vector(4, 1.6, -1), Vector(6, 2.2, 2.4)},
                   {Vector(6.5, -2, -1), Vector(7.1, -1.1, 3)}};
  Drive elsewhere{{0, 1, 2}, kTuesday, 0.03, "scan", other};
  elsewhere.seed = 12;
  rooms().run("elsewhere", elsewhere);
  expectError(changes("before", "elsewhere", {"-o", rooms() / "none"}),
              kName,
              1,
              {"elsewhere: does not meet ", "before", "nothing is compared"});
  EXPECT_FALSE(fs::exists(rooms() / "none"));
}

TEST_F(EvaluateChanges, ComparesRunsOfOneScan)
{
  rooms().run("one", {{1}, kMonday, 0.02, "scan", roomWith({kCrate})});
  Drive after{{2}, kMonday, 0.02, "scan", roomWith({})};
  after.seed = 9;
  rooms().run("other", after);
  const Outcome outcome = changes("one", "other");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
  EXPECT_NE(outcome.out.find("0 moved, 0 appeared, 1 vanished, 0 shifted"),
            std::string::npos)
      << outcome.out;
}

TEST_F(EvaluateChanges, RefusesWhatIsNoRun)
{
  expectError(changes("before", "nowhere"), kName, 1, {"nowhere"});
  expectError(
      changes("before.scans", "before"),
      kName,
      1,
      {"before.scans: is a folder, but no run of pcl_slam6d (no summary.json)"});
  fs::create_directory(rooms() / "empty");
  expectError(changes("before", "empty"), kName, 1, {"empty", "no summary.json"});
}

TEST_F(EvaluateChanges, RefusesARunWithoutScans)
{
  fs::copy(rooms() / "again", rooms() / "bare", fs::copy_options::recursive);
  Json summary = json("bare/summary.json");
  for (auto& scan : summary["scans"])
    scan["state"] = "predicted";
  writeText(rooms() / "bare/summary.json", summary.dump());
  expectError(changes("before", "bare"),
              kName,
              1,
              {"bare: holds no scan with a reliable pose"});
}

TEST_F(EvaluateChanges, RefusesRunsInOtherUnits)
{
  Drive millimetres{{0, 2, 4}, Eigen::Isometry3d::Identity()};
  millimetres.unit = 0.001;
  rooms().run("millimetres", millimetres);
  expectError(
      changes("before", "millimetres"), kName, 1, {"millimetres", "not in metres"});
}

TEST_F(EvaluateChanges, RefusesAGateThatLeavesNothing)
{
  expectError(changes("before", "after", {"--max-range", "0.2"}),
              kName,
              1,
              {"before: scan000.xyz: 0 points within the range gate of",
               "to 0.2 m, but at least 3 are needed"});
}

TEST_F(EvaluateChanges, RefusesWrongOptions)
{
  expectError(changes("before", "after", {"--min-confidence", "1"}),
              kName,
              2,
              {"--min-confidence = 1, but must be in [0, 1)"});
  expectError(changes("before", "after", {"--least-size", "0"}),
              kName,
              2,
              {"--least-size = 0"});
  expectError(changes("before", "after", {"--json", "told.txt"}),
              kName,
              2,
              {"--json", ".json"});
  expectError(
      changes("before", "after", {"--rows", "-1"}), kName, 2, {"--rows", ">= 0"});
  expectError(runProgram(kName, {"changes", rooms() / "before"}), kName, 2, {"RUN_B"});
  expectError(changes("before", "after", {"--force=yes"}), kName, 2, {"--force"});
}
