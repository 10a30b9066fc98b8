// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_evaluate place SCAN RUN as a user runs it: where in a map was this scan taken?
#include "apps/support/joined_rooms.h"
#include "apps/support/program_names.h"
#include "apps/support/room_run.h"

#include <string>
#include <vector>

namespace {
namespace fs = std::filesystem;
using pcl6d::distanceBetween;
using pcl6d::MotionSize;
using pcl6d::poseFromEuler;
using pcl6d::test::expectError;
using pcl6d::test::JoinedRooms;
using pcl6d::test::kEvaluate;
using pcl6d::test::kPlaceTol;
using pcl6d::test::kTurnTol;
using pcl6d::test::Outcome;
using pcl6d::test::placeInRoom;
using pcl6d::test::readText;
using pcl6d::test::runProgram;
using pcl6d::test::writeText;
using Json = nlohmann::json;
using Drive = JoinedRooms::Drive;

const Eigen::Isometry3d kWorld = poseFromEuler({20, -3, 1}, {0.1, -0.2, 2});

/** A run through a room, and scans that are no part of it. */
class PlaceInRun : public testing::Test {
protected:
  static void
  SetUpTestSuite()
  {
    rooms_ = new JoinedRooms;
    rooms_->run("map", {{0, 2, 3, 5}, kWorld});
    Drive left_out{{4, 1}, Eigen::Isometry3d::Identity()};
    left_out.seed = 17;
    rooms_->writeScans("left_out", left_out);
  }
  static void
  TearDownTestSuite()
  {
    delete rooms_;
    rooms_ = nullptr;
  }

  static std::string
  at(const std::string& name)
  {
    return *rooms_ / name;
  }
  static Outcome
  place(const std::string& scan,
        const std::string& run,
        std::vector<std::string> more = {"--quiet"})
  {
    more.insert(more.begin(), {"place", at(scan), at(run)});
    return runProgram(kEvaluate, more);
  }
  static Json
  json(const std::string& name)
  {
    return Json::parse(readText(at(name)));
  }
  static Eigen::Isometry3d
  poseInWorld(const Json& candidate)
  {
    Eigen::Isometry3d pose;
    for (int k = 0; k < 16; ++k)
      pose.matrix()(k / 4, k % 4) =
          candidate["T_world_scan"][static_cast<std::size_t>(k)];
    return pose;
  }
  /** \return the place in the world that the run's own first scan has moved to */
  static Eigen::Isometry3d
  truth(const std::string& run, int first, int scan)
  {
    return rooms_->poses(run)[0] * placeInRoom(first).inverse() * placeInRoom(scan);
  }

  static JoinedRooms* rooms_;
};
JoinedRooms* PlaceInRun::rooms_ = nullptr;
} // namespace

TEST_F(PlaceInRun, FindsAScanThatWasLeftOut)
{
  const Outcome outcome =
      place("left_out.scans/scan000.xyz", "map", {"-o", at("left_out.json")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("\nunique: "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("meets scan002.xyz: good"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("standard deviations: "), std::string::npos)
      << outcome.out;
  const Json found = json("left_out.json");
  EXPECT_EQ(found["answer"], "unique");
  EXPECT_EQ(found["same_as"], Json());
  EXPECT_EQ(found["scans_compared"], 4);
  const Json& best = found["candidates"][0];
  EXPECT_EQ(best["result"], "good");
  EXPECT_EQ(best["links"].size(), 4u);
  const MotionSize off = distanceBetween(truth("map", 0, 4), poseInWorld(best));
  EXPECT_LT(off.translation, kPlaceTol);
  EXPECT_LT(off.rotation, kTurnTol);
}

TEST_F(PlaceInRun, SaysHowExactlyThePlaceIsKnown)
{
  place("left_out.scans/scan001.xyz", "map", {"-o", at("exact.json"), "--quiet"});
  const Json found = json("exact.json");
  ASSERT_EQ(found["covariance"].size(), 36u);
  Eigen::Matrix<double, 6, 6> covariance;
  for (std::size_t k = 0; k < 36; ++k)
    covariance(k / 6, k % 6) = found["covariance"][k];
  EXPECT_TRUE(covariance.isApprox(covariance.transpose(), 1e-9));
  EXPECT_GT(covariance.ldlt().vectorD().minCoeff(), 0);
  const MotionSize off =
      distanceBetween(truth("map", 0, 1), poseInWorld(found["candidates"][0]));
  const double bound = found["bound"];
  EXPECT_LT(off.translation, 2 * bound) << "as the map itself is off, too";
  EXPECT_LT(bound, 0.2);
  // The sphere with 95 % of the errors is at least as wide as the 95 % interval of any axis.
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_GE(bound, 1.93 * std::sqrt(covariance(axis, axis)));
}

TEST_F(PlaceInRun, GivesTheSameBytesForAnyNumberOfThreads)
{
  for (const char* threads : {"1", "8"})
    place("left_out.scans/scan000.xyz",
          "map",
          {"-o", at(std::string(threads) + ".json"), "--threads", threads, "--quiet"});
  EXPECT_EQ(readText(at("1.json")), readText(at("8.json")));
}

TEST_F(PlaceInRun, AScanOfTheRunIsNamedAndLookedForByTheOthers)
{
  const Outcome outcome =
      place("map.scans/scan002.xyz", "map", {"-o", at("own.json"), "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.err.find("is scan002.xyz of "), std::string::npos) << outcome.err;
  const Json found = json("own.json");
  EXPECT_EQ(found["same_as"], "scan002.xyz");
  EXPECT_EQ(found["scans_compared"], 3);
  const MotionSize off =
      distanceBetween(rooms_->poses("map")[2], poseInWorld(found["candidates"][0]));
  EXPECT_LT(off.translation, kPlaceTol);
  EXPECT_LT(off.rotation, kTurnTol);
  // A run of this scan alone has nothing to say of it.
  rooms_->run("alone", {{4}, kWorld});
  expectError(
      place("alone.scans/scan000.xyz", "alone"), kEvaluate, 1, {"but this one"});
}

TEST_F(PlaceInRun, AnswersInFullCoordinates)
{
  const Eigen::Isometry3d far = poseFromEuler({3.3e6, 5.8e6, 400}, {0, 0, 1});
  rooms_->run("far", {{0, 2, 3}, far});
  const Outcome outcome =
      place("left_out.scans/scan001.xyz", "far", {"-o", at("far.json"), "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const MotionSize off = distanceBetween(
      truth("far", 0, 1), poseInWorld(json("far.json")["candidates"][0]));
  EXPECT_LT(off.translation, kPlaceTol);
  EXPECT_LT(off.rotation, kTurnTol);
}

TEST_F(PlaceInRun, ScansWithoutASurePlaceAreNoPartOfTheMap)
{
  fs::copy(at("map"), at("lost"), fs::copy_options::recursive);
  Json summary = json("lost/summary.json");
  summary["scans"][3]["state"] = "predicted";
  writeText(at("lost/summary.json"), summary.dump());
  const Outcome outcome =
      place("left_out.scans/scan001.xyz", "lost", {"-o", at("lost.json"), "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.err.find("1 scan without a reliable pose"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(json("lost.json")["scans_compared"], 3);
}

TEST_F(PlaceInRun, AScanOfElsewhereHasNoPlace)
{
  Drive elsewhere{{2}, kWorld};
  elsewhere.room.walls = {Eigen::Vector3d(-3, -2, -1), Eigen::Vector3d(17, 2, 3)};
  elsewhere.room.pillars = {{Eigen::Vector3d(6, -2, -1), Eigen::Vector3d(7, -1, 3)}};
  rooms_->writeScans("elsewhere", elsewhere);
  const Outcome outcome = place("elsewhere.scans/scan000.xyz", "map");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
  EXPECT_EQ(outcome.out.rfind("none: ", 0), 0u) << outcome.out;
}

TEST_F(PlaceInRun, ARoomThatHalfATurnMapsToItselfIsAmbiguous)
{
  Drive half{{0, 2, 3}, kWorld};
  half.room.walls = {Eigen::Vector3d(-5, -4, -1), Eigen::Vector3d(5, 4, 2)};
  half.room.pillars = {{Eigen::Vector3d(-3, -2, -1), Eigen::Vector3d(-2, -1, 2)},
                       {Eigen::Vector3d(2, 1, -1), Eigen::Vector3d(3, 2, 2)}};
  rooms_->run("half", half);
  half.places = {1};
  half.seed = 5;
  rooms_->writeScans("turned", half);
  const Outcome outcome =
      place("turned.scans/scan000.xyz", "half", {"-o", at("half.json"), "--quiet"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
  EXPECT_EQ(outcome.out.rfind("ambiguous: ", 0), 0u) << outcome.out;
  const Json found = json("half.json");
  EXPECT_GE(found["candidates"].size(), 2u);
  EXPECT_GT(found["ambiguity"], 0.6);
  EXPECT_EQ(found["covariance"], Json()) << "of which of them?";
}

TEST_F(PlaceInRun, DrawsTheCandidatesSideBySide)
{
  const std::string picture = at("places.png");
  const Outcome outcome =
      place("left_out.scans/scan000.xyz", "map", {"--picture", picture, "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto [width, height] = pcl6d::test::sizeOfPng(picture);
  EXPECT_EQ(width, 1600u);
  EXPECT_GT(height, 300u);
  const Outcome pair = runProgram(kEvaluate,
                                  {"place",
                                   at("map.scans/scan000.xyz"),
                                   at("left_out.scans/scan000.xyz"),
                                   "--picture",
                                   at("pair.png"),
                                   "--quiet"});
  EXPECT_EQ(pair.exit_code, 0) << pair.out << pair.err;
  EXPECT_EQ(pcl6d::test::sizeOfPng(at("pair.png")).first, 1600u);
}

TEST_F(PlaceInRun, RefusesWhatItCannotUse)
{
  const std::string scan = "left_out.scans/scan000.xyz";
  expectError(
      place(scan, "map.scans"), kEvaluate, 1, {"map.scans", "no run", "summary.json"});
  expectError(place("none.xyz", "map"), kEvaluate, 1, {"none.xyz"});
  expectError(
      place(scan, "map", {"--picture", "x.jpg"}), kEvaluate, 2, {"--picture", ".png"});
  expectError(
      place(scan, "map", {"--picture", at(scan)}), kEvaluate, 2, {"--picture", ".png"});
  fs::copy(at("map"), at("stopped"), fs::copy_options::recursive);
  Json summary = json("stopped/summary.json");
  summary["verdict"]["complete"] = false;
  writeText(at("stopped/summary.json"), summary.dump());
  expectError(place(scan, "stopped"), kEvaluate, 1, {"interrupted"});
  fs::copy(at("map"), at("damaged"), fs::copy_options::recursive);
  std::string bytes = readText(at("damaged/scans/scan001.pcd"));
  bytes[bytes.size() / 2] ^= 1;
  writeText(at("damaged/scans/scan001.pcd"), bytes);
  expectError(place(scan, "damaged"), kEvaluate, 1, {"scan001.pcd"});
}

TEST_F(PlaceInRun, RefusesOtherUnitsAndNamesThem)
{
  Drive millimetres{{4}, kWorld};
  millimetres.unit = 1e-3;
  rooms_->writeScans("millimetres", millimetres);
  expectError(place("millimetres.scans/scan000.xyz", "map"),
              kEvaluate,
              1,
              {"scan000.xyz: its scans reach", "as if they were in millimetres"});
}
