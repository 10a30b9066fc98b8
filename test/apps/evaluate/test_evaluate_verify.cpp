// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_evaluate verify as a user runs it.
#include "apps/support/room_pair.h"
#include "support/data_folder.h"

#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/trajectory_io.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace fs = std::filesystem;

namespace {
using Json = nlohmann::json;
using pcl6d::planarPose;
using pcl6d::Random;
using pcl6d::Trajectory;
using pcl6d::test::Outcome;
using pcl6d::test::PillarRoom;
using pcl6d::test::readText;
using pcl6d::test::RoomPair;
using pcl6d::test::runProgram;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

constexpr const char* kName = "pcl_slam6d_evaluate";

Outcome
verify(std::vector<std::string> arguments)
{
  arguments.insert(arguments.begin(), "verify");
  arguments.emplace_back("--quiet");
  return runProgram(kName, arguments);
}

void
expectError(const Outcome& outcome, int code, const std::vector<std::string>& words)
{
  pcl6d::test::expectError(outcome, kName, code, words);
}

void
expectVerdict(const Outcome& outcome, int code, const std::string& verdict)
{
  EXPECT_EQ(outcome.exit_code, code) << outcome.err << outcome.out;
  EXPECT_NE(outcome.out.find("\n" + verdict + ": "), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.err.find("warning: ") != std::string::npos, verdict == "unverified")
      << outcome.err;
}

/** Scans of a drive through a room, their true poses and drifting ones. */
struct Drive : TempFolder {
  static constexpr int kScans = 6;

  Drive()
  {
    Random random(7);
    const PillarRoom room;
    fs::create_directory(*this / "scans");
    for (int i = 0; i < kScans; ++i) {
      truth.poses.push_back(planarPose(-1.5 + 0.5 * i, 0.2 * i, 0.1 * i));
      drifted.poses.push_back(planarPose(-1.5 + 0.7 * i, 0.2 * i, 0.2 * i));
      write("scans/scan00" + std::to_string(i) + ".xyz",
            room.scan(truth.poses.back(), random, 0.03));
    }
    writeTrajectoryKitti(*this / "groundtruth.txt", truth);
    writeTrajectoryKitti(*this / "drifted.txt", drifted);
  }

  void
  write(const std::string& name, const pcl6d::Points& points) const
  {
    std::ofstream file(*this / name);
    file.precision(9);
    for (const auto& p : points)
      file << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  }
  std::string
  scans() const
  {
    return *this / "scans";
  }
  std::string
  scan(int i) const
  {
    return *this / ("scans/scan00" + std::to_string(i) + ".xyz");
  }

  Trajectory truth, drifted;
};

const Drive&
drive()
{
  static const Drive made;
  return made;
}

/** \return --pose of a scan seen from another, turned by `yaw` [deg] from planarPose */
std::string
poseText(double x, double y, double yaw)
{
  return std::to_string(x) + " " + std::to_string(y) + " 0 0 0 " + std::to_string(yaw);
}

/** \return the true pose of scan 1 seen from scan 0, with the scanner off by so much */
std::string
poseOfSecond(double off)
{
  const Eigen::Isometry3d T = drive().truth.poses[0].inverse() * drive().truth.poses[1];
  return poseText(T.translation().x() + off, T.translation().y(), 0.1 * 180 / M_PI);
}

/** Words and counts are the same, numbers as far as poses of files have digits. */
void
expectAlike(const Json& a, const Json& b, const std::string& where)
{
  constexpr double kOfDigits = 1e-4;
  SCOPED_TRACE(where);
  ASSERT_EQ(a.type(), b.type());
  if (b.is_number_float())
    EXPECT_NEAR(
        a.get<double>(), b.get<double>(), kOfDigits * (1 + std::abs(b.get<double>())));
  else if (!b.is_structured())
    EXPECT_EQ(a, b);
  else {
    ASSERT_EQ(a.size(), b.size());
    for (const auto& [name, value] : b.items())
      expectAlike(b.is_array() ? a[std::stoul(name)] : a[name], value, name);
  }
}
} // namespace

TEST(EvaluateVerify, BelievesTheTruePosesOfAnyProgram)
{
  const TempFolder out;
  const Outcome outcome = verify(
      {drive().scans(), "--poses", drive() / "groundtruth.txt", "-o", out / "out"});
  expectVerdict(outcome, 0, "good");
  const Json j = Json::parse(readText(out / "out/verification.json"));
  EXPECT_EQ(j["verdict"], "good");
  EXPECT_EQ(j["generator"], kName);
  EXPECT_EQ(j["files"].size(), Drive::kScans);
  EXPECT_EQ(j["scans"].size(), Drive::kScans);
  EXPECT_EQ(j["inconsistent"], 0);
  EXPECT_EQ(j["doubts"], Json::array());
  const std::string csv = readText(out / "out/verification.csv");
  EXPECT_EQ(csv.rfind("from,to,result,probability_wrong,patches,", 0), 0u) << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + j["links"].get<int>());
  EXPECT_TRUE(fs::exists(out / "out/contradictions.ply"));
}

TEST(EvaluateVerify, DoubtsPosesThatDrift)
{
  const TempFolder out;
  const Outcome outcome =
      verify({drive().scans(), "--poses", drive() / "drifted.txt", "-o", out / "out"});
  expectVerdict(outcome, 3, "doubtful");
  EXPECT_NE(outcome.out.find("scan001.xyz"), std::string::npos) << outcome.out;
  const Json j = Json::parse(readText(out / "out/verification.json"));
  EXPECT_EQ(j["verdict"], "doubtful");
  EXPECT_FALSE(j["doubts"].empty());
  const auto points = pcl6d::readScan(out / "out/contradictions.ply");
  EXPECT_GT(points.points.size(), 100u);
  for (const auto& p : points.points)
    ASSERT_LT(p.norm(), 30) << "in the world, near the room";
}

TEST(EvaluateVerify, HasTheSameBytesForAnyNumberOfThreads)
{
  const TempFolder out;
  for (const std::string threads : {"1", "3"})
    verify({drive().scans(),
            "--poses",
            drive() / "drifted.txt",
            "-o",
            out / threads,
            "--threads",
            threads});
  for (const char* file :
       {"verification.csv", "verification.json", "contradictions.ply"})
    EXPECT_EQ(readText(out / "1" / file), readText(out / "3" / file)) << file;
}

TEST(EvaluateVerify, TakesPosesOfTheScansThatAreTaken)
{
  const TempFolder out;
  Trajectory some;
  some.poses = {drive().truth.poses[1], drive().truth.poses[3]};
  writeTrajectoryKitti(out / "some.txt", some);
  const std::vector<std::string> selection = {
      drive().scans(), "--first", "1", "--last", "4", "--every", "2", "--poses"};
  for (const std::string poses : {out / "some.txt", drive() / "groundtruth.txt"}) {
    std::vector<std::string> arguments = selection;
    arguments.push_back(poses);
    expectVerdict(verify(arguments), 0, "good");
  }
}

TEST(EvaluateVerify, TellsARightPoseOfAPairFromAWrongOne)
{
  const std::string a = drive().scan(0), b = drive().scan(1);
  const Outcome right = verify({a, b, "--pose", poseOfSecond(0)});
  expectVerdict(right, 0, "good");
  EXPECT_NE(right.out.find("scan000.xyz - scan001.xyz"), std::string::npos);
  const Outcome wrong = verify({a, b, "--pose", poseOfSecond(0.5)});
  expectVerdict(wrong, 3, "doubtful");
  EXPECT_NE(wrong.out.find("contradict"), std::string::npos) << wrong.out;
}

TEST(EvaluateVerify, ReadsThePoseOfAPairFromAFile)
{
  const TempFolder out;
  const std::string a = drive().scan(0), b = drive().scan(1);
  Trajectory pose;
  pose.poses = {drive().truth.poses[0].inverse() * drive().truth.poses[1]};
  writeTrajectoryKitti(out / "pose.txt", pose);
  expectVerdict(verify({a, b, "--pose", out / "pose.txt"}), 0, "good");
  writeText(out / "16.txt", readText(out / "pose.txt") + " 0 0 0 1\n");
  expectVerdict(verify({a, b, "--pose", out / "16.txt"}), 0, "good");
  writeText(out / "bad.txt", "1 0 0 0 0 2 0 0 0 0 1 0");
  expectError(verify({a, b, "--pose", out / "bad.txt"}), 1, {"bad.txt", "rigid"});
  writeText(out / "few.txt", "1 0 0");
  expectError(verify({a, b, "--pose", out / "few.txt"}), 1, {"few.txt", "3 numbers"});
  writeText(out / "word.txt", "1 0 x");
  expectError(verify({a, b, "--pose", out / "word.txt"}), 1, {"word.txt", "'x'"});
}

TEST(EvaluateVerify, IsNeverGoodWithoutEvidence)
{
  const std::string a = drive().scan(0), b = drive().scan(1);
  const Outcome apart = verify({a, b, "--pose", "500 0 0 0 0 0"});
  expectVerdict(apart, 3, "doubtful");
  EXPECT_NE(apart.out.find("no surfaces in common"), std::string::npos) << apart.out;

  const Outcome same = verify({a, a, "--pose", "0 0 0 0 0 0"});
  expectVerdict(same, 0, "unverified");
  EXPECT_NE(same.out.find("both scans hold the very same points"), std::string::npos)
      << same.out;

  const Outcome one = verify({drive().scans(), "--last", "0"});
  expectVerdict(one, 0, "unverified");
  EXPECT_NE(one.out.find("a single scan"), std::string::npos) << one.out;

  const TempFolder folder;
  fs::create_directory(folder / "in");
  for (const char* name : {"in/a.xyz", "in/b.xyz"})
    fs::copy_file(a, folder / name);
  const auto pose = drive().truth.poses.front();
  Trajectory still;
  still.poses = {pose, pose};
  writeTrajectoryKitti(folder / "poses.txt", still);
  expectVerdict(
      verify({folder / "in", "--poses", folder / "poses.txt"}), 0, "unverified");
}

TEST(EvaluateVerify, TakesARunInWhichNothingMoved)
{
  const TempFolder folder;
  fs::create_directory(folder / "in");
  for (const char* name : {"in/scan000.xyz", "in/scan001.xyz"})
    fs::copy_file(drive().scan(0), folder / name);
  const std::string run = folder / "run";
  const Outcome made = pcl6d::test::runProgram(
      "pcl_slam6d", {folder / "in", "-o", run, "--no-picture", "--quiet"});
  ASSERT_TRUE(fs::exists(run + "/summary.json")) << made.err;
  expectVerdict(verify({run}), 0, "unverified");
}

TEST(EvaluateVerify, AScanThatTheRunCouldNotMatchIsNotConnected)
{
  const TempFolder folder;
  const std::string run = folder / "run";
  const Outcome made = pcl6d::test::runProgram("pcl_slam6d",
                                               {drive().scans(),
                                                "--poses",
                                                drive() / "groundtruth.txt",
                                                "-o",
                                                run,
                                                "--no-picture",
                                                "--quiet"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  expectVerdict(verify({run}), 0, "good");
  Json summary = Json::parse(readText(run + "/summary.json"));
  summary["scans"][3]["state"] = "predicted"; // the pose is the true one
  writeText(run + "/summary.json", summary.dump());
  expectVerdict(verify({run, "-o", folder / "out"}), 3, "doubtful");
  const Json scans = Json::parse(readText(folder / "out/verification.json"))["scans"];
  for (std::size_t i = 0; i < scans.size(); ++i)
    EXPECT_EQ(scans[i]["connected"], i != 3) << i;
}

TEST(EvaluateVerify, NamesWhatIsWrongWithTheInput)
{
  const std::string a = drive().scan(0), b = drive().scan(1);
  const TempFolder folder;
  expectError(verify({"/nowhere"}), 1, {"/nowhere"});
  expectError(
      verify({a, "/nowhere.pcd", "--pose", "0 0 0 0 0 0"}), 1, {"/nowhere.pcd"});
  expectError(verify({a, drive().scans(), "--pose", "0 0 0 0 0 0"}), 1, {"scans"});
  expectError(verify({drive().scans()}), 1, {"--poses"});
  expectError(verify({a, b}), 1, {"--pose"});
  expectError(verify({drive().scans(), "--poses", "/no.txt"}), 1, {"/no.txt"});
  writeText(folder / "two.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 0\n");
  expectError(verify({drive().scans(), "--poses", folder / "two.txt"}),
              1,
              {"two.txt", "2 poses", "6 scans"});
  writeText(folder / "shear.txt", "1 0 0 0 0 2 0 0 0 0 1 0\n");
  expectError(verify({drive().scans(), "--poses", folder / "shear.txt"}),
              1,
              {"shear.txt", "line 1", "rigid"});
  writeText(folder / "few.xyz", "1 2 3\n2 3 4\n");
  expectError(verify({folder / "few.xyz", b, "--pose", "0 0 0 0 0 0"}),
              1,
              {"few.xyz", "2 points", "3"});
  expectError(verify({a, b, "--pose", "0 0 0 0 0 0", "--max-range", "0.3"}),
              1,
              {"scan000.xyz", "range gate"});
}

TEST(EvaluateVerify, RefusesAWrongCommandLine)
{
  const std::string a = drive().scan(0), b = drive().scan(1);
  expectError(verify({}), 2, {"INPUT"});
  expectError(verify({a, b, a}), 2, {"3 inputs"});
  expectError(verify({a, b, "--pose", "0 0 0"}), 2, {"--pose", "six"});
  expectError(verify({a, b, "--pose", "0 0 nan 0 0 0"}), 2, {"--pose", "finite"});
  expectError(verify({a, b, "--pose", "0 0 0 0 0 0", "--first", "1"}), 2, {"--first"});
  expectError(verify({drive().scans(), "--pose", "0 0 0 0 0 0"}), 2, {"--poses"});
  expectError(verify({drive().scans(), "--voxel", "0"}), 2, {"--voxel = 0"});
  const Outcome help = verify({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_NE(help.out.find("SCAN_A SCAN_B"), std::string::npos);
}

TEST(EvaluateVerify, AgreesWithTheVerdictOfARun)
{
  const TempFolder out;
  runProgram("pcl_slam6d",
             {drive().scans(), "--poses", drive() / "drifted.txt", "-o", out / "run"});
  const Json run = Json::parse(readText(out / "run/summary.json"))["verification"];
  ASSERT_TRUE(run.is_object());
  const Outcome outcome = verify({out / "run", "-o", out / "out"});
  EXPECT_EQ(outcome.exit_code, run["verdict"] == "good" ? 0 : 3) << outcome.out;
  const Json j = Json::parse(readText(out / "out/verification.json"));
  for (const auto& [name, value] : run.items())
    expectAlike(j[name], value, name);
  EXPECT_EQ(readText(out / "run/verification.csv"),
            readText(out / "out/verification.csv"));
}

TEST(EvaluateVerify, NeverWritesIntoItsInput)
{
  const Outcome outcome = verify(
      {drive().scans(), "--poses", drive() / "groundtruth.txt", "-o", drive().scans()});
  expectError(outcome, 1, {"scans"});
}
