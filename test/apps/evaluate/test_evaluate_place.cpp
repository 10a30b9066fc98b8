// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_evaluate place as a user runs it.
#include "apps/support/program_names.h"
#include "apps/support/room_pair.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace {
using Json = nlohmann::json;
using pcl6d::distanceBetween;
using pcl6d::MotionSize;
using pcl6d::planarPose;
using pcl6d::Points;
using pcl6d::poseFromEuler;
using pcl6d::Random;
using pcl6d::test::expectError;
using pcl6d::test::kEvaluate;
using pcl6d::test::Outcome;
using pcl6d::test::PillarRoom;
using pcl6d::test::readText;
using pcl6d::test::RoomPair;
using pcl6d::test::runProgram;
using pcl6d::test::writeText;
using Vector = Eigen::Vector3d;

// A third of a voxel of 0.1 m, and the turn that moves walls 5 m away by as much.
constexpr double kPlaceTol = 0.035, kTurnTol = 0.007;

/** The same with a large turn, and scans fine enough for rays to speak. */
struct TurnedPair : RoomPair {
  explicit TurnedPair(const PillarRoom& room = {})
  {
    truth = poseFromEuler({1.4, -0.9, 0.05}, {0.02, -0.01, 2.5});
    Random random(3);
    const Eigen::Isometry3d first = planarPose(-1, 0.3, 0.1);
    write("a.xyz", room.scan(first, random, 0.025));
    write("b.xyz", room.scan(first * truth, random, 0.025));
  }

  Outcome
  place(std::vector<std::string> more = {}) const
  {
    std::vector<std::string> all = {
        "place", *this / "a.xyz", *this / "b.xyz", "--voxel", "0.1"};
    all.insert(all.end(), more.begin(), more.end());
    return runProgram(kEvaluate, all);
  }
};

Eigen::Isometry3d
poseOfPair(const Json& candidate)
{
  Eigen::Isometry3d pose;
  for (int k = 0; k < 16; ++k)
    pose.matrix()(k / 4, k % 4) = candidate["T_a_b"][static_cast<std::size_t>(k)];
  return pose;
}
} // namespace

TEST(EvaluatePlace, FindsTheOnePlace)
{
  const TurnedPair pair;
  const Outcome outcome = pair.place({"-o", pair / "out.json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
  EXPECT_NE(outcome.out.find("\nunique: "), std::string::npos) << outcome.out;
  const Json json = Json::parse(readText(pair / "out.json"));
  EXPECT_EQ(json["answer"], "unique");
  EXPECT_EQ(json["candidates"][0]["result"], "good");
  const MotionSize off = distanceBetween(pair.truth, poseOfPair(json["candidates"][0]));
  EXPECT_LT(off.translation, kPlaceTol);
  EXPECT_LT(off.rotation, kTurnTol);
}

TEST(EvaluatePlace, ItsAnswerIsAPoseForVerify)
{
  const TurnedPair pair;
  const std::string out = pair.place({"--quiet"}).out;
  ASSERT_EQ(out.rfind("unique: ", 0), 0u) << out;
  const std::string pose = out.substr(8, out.find('\n') - 8);
  const Outcome verdict = runProgram(kEvaluate,
                                     {"verify",
                                      pair / "a.xyz",
                                      pair / "b.xyz",
                                      "--voxel",
                                      "0.1",
                                      "--pose",
                                      pose,
                                      "--quiet"});
  EXPECT_EQ(verdict.exit_code, 0) << verdict.out << verdict.err;
}

TEST(EvaluatePlace, ListsAsManyCandidatesAsAreAskedFor)
{
  const TurnedPair pair;
  pair.place({"--candidates", "2", "-o", pair / "out.json", "--quiet"});
  EXPECT_EQ(Json::parse(readText(pair / "out.json"))["candidates"].size(), 2u);
}

TEST(EvaluatePlace, ARoomThatHalfATurnMapsToItselfIsAmbiguous)
{
  PillarRoom room;
  room.walls = {Vector(-5, -4, -1), Vector(5, 4, 2)};
  room.pillars = {{Vector(-3, -2, -1), Vector(-2, -1, 2)},
                  {Vector(2, 1, -1), Vector(3, 2, 2)}};
  const Outcome outcome = TurnedPair(room).place({"--quiet"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
  EXPECT_EQ(outcome.out.rfind("ambiguous: ", 0), 0u) << outcome.out;
}

TEST(EvaluatePlace, OfTheSamePointsSaysNothing)
{
  const TurnedPair pair;
  const Outcome outcome =
      runProgram(kEvaluate, {"place", pair / "a.xyz", pair / "a.xyz", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
  EXPECT_NE(outcome.out.find("the very same points"), std::string::npos) << outcome.out;
}

TEST(EvaluatePlace, OfFiftyPointsSaysWhy)
{
  const TurnedPair pair;
  Random random(7);
  const Points few = PillarRoom().scan(planarPose(0, 0, 0), random, 0.3);
  pair.write("b.xyz", {few.begin(), few.begin() + 50});
  const Outcome outcome = pair.place({"--quiet"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.out.rfind("none: ", 0), 0u) << outcome.out;
}

TEST(EvaluatePlace, RefusesWhatItCannotRead)
{
  const TurnedPair pair;
  const auto place = [](std::vector<std::string> words) {
    words.insert(words.begin(), "place");
    return runProgram(kEvaluate, words);
  };
  expectError(place({pair / "a.xyz", pair / "none.xyz"}), kEvaluate, 1, {"none.xyz"});
  writeText(pair / "two.xyz", "1 2 3\n4 5 6\n");
  expectError(
      place({pair / "a.xyz", pair / "two.xyz"}), kEvaluate, 1, {"two.xyz", "3"});
  expectError(place({pair / "a.xyz"}), kEvaluate, 2, {"SCAN_B"});
  expectError(
      pair.place({"--candidates", "0"}), kEvaluate, 2, {"--candidates", "[1, 30]"});
  expectError(pair.place({"--max-ambiguity", "2"}), kEvaluate, 2, {"--max-ambiguity"});
  expectError(pair.place({"-o", "x.csv"}), kEvaluate, 2, {".json"});
}
