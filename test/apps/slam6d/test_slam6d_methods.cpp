// SPDX-License-Identifier: BSD-3-Clause
// The methods of pcl_slam6d as words of its command line, and what it does not believe.
#include "slam6d/room_scans.h"
#include "support/constants.h"
#include "support/run_program.h"

#include <pcl6d/io/trajectory_io.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sstream>

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using pcl6d::Points;
using pcl6d::test::kIdentity;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;
using pcl6d::test::TurnedScans;
using pcl6d::test::writeText;

/** A folder of scans, and what pcl_slam6d makes of it. */
class Methods : public testing::Test {
protected:
  Methods() { fs::create_directory(in_); }

  void
  write(const std::vector<Points>& scans) const
  {
    for (std::size_t i = 0; i < scans.size(); ++i) {
      std::ostringstream text;
      for (const auto& p : scans[i])
        text << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
      writeText(in_ / ("scan" + std::to_string(i) + ".xyz"), text.str());
    }
  }

  void
  writeOdometry(const std::vector<Eigen::Isometry3d>& poses) const
  {
    pcl6d::Trajectory odometry;
    odometry.poses = poses;
    pcl6d::writeTrajectoryKitti(in_ / "odometry.txt", odometry);
  }

  /** Runs the program, expects the exit code and reads the summary. */
  void
  run(int exit_code, std::vector<std::string> more = {})
  {
    more.insert(more.begin(), {in_.string(), "-o", out_.string()});
    outcome_ = pcl6d::test::runProgram("pcl_slam6d", more);
    ASSERT_EQ(outcome_.exit_code, exit_code) << outcome_.err;
    summary_ = json::parse(readText(out_ / "summary.json"));
  }

  std::vector<Eigen::Isometry3d>
  poses() const
  {
    return pcl6d::readTrajectory(out_ / "trajectory.kitti").poses;
  }

  void
  expectOption(const std::string& name,
               const std::string& value,
               const std::string& source) const
  {
    EXPECT_EQ(summary_["options"][name]["value"], value) << name;
    EXPECT_EQ(summary_["options"][name]["source"], source) << name;
  }

  void
  expectPredicted(int scan, const std::string& reason) const
  {
    EXPECT_EQ(summary_["scans"][scan]["state"], "predicted");
    const auto rejection = summary_["scans"][scan]["rejections"][0];
    EXPECT_EQ(rejection["reason"], reason) << summary_["scans"][scan]["reason"];
    EXPECT_FALSE(summary_["verdict"]["reliable"]);
    EXPECT_NE(outcome_.out.find("NOT TO BE TRUSTED"), std::string::npos)
        << outcome_.out;
    const std::string file = "scan" + std::to_string(scan) + ".xyz";
    EXPECT_NE(outcome_.out.find(file), std::string::npos) << outcome_.out;
  }

  /** Expects the path, seen from the first scan, within 5 cm. */
  void
  expectPath(const std::vector<Eigen::Isometry3d>& truth) const
  {
    const auto found = poses();
    ASSERT_EQ(found.size(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const auto error = pcl6d::distanceBetween(truth[0].inverse() * truth[i],
                                                found[0].inverse() * found[i]);
      EXPECT_LT(error.translation, 0.05) << "scan " << i;
      EXPECT_LT(error.rotation, 0.01) << "scan " << i;
    }
  }

  const TempFolder folder_;
  const fs::path in_ = folder_ / "in", out_ = folder_ / "out";
  Outcome outcome_;
  json summary_;
};

const TurnedScans&
turned()
{
  static const TurnedScans scans;
  return scans;
}

constexpr const char* kNoPoses = "no initial poses were found";
constexpr const char* kOrderKept =
    "start in the order of the files: 4 of 4 scans registered, 4 connected, kept";
} // namespace

TEST_F(Methods, WithoutPosesScansAreJoinedByWhatTheySee)
{
  write(turned().scans);
  run(0);
  expectOption("initial-guess", "global", "default");
  EXPECT_EQ(summary_["pose_source"], "identity");
  EXPECT_EQ(summary_["warnings"], json::array({kNoPoses, kOrderKept}));
  EXPECT_NE(outcome_.err.find(kOrderKept), std::string::npos) << outcome_.err;
  expectPath(turned().truth);
}

TEST_F(Methods, TheTimeOfManyScansWithoutPosesIsSaidBeforeItIsSpent)
{
  const Points corner = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  write(std::vector<Points>(100, corner));
  run(3, {"--no-picture"});
  const auto said = outcome_.err.find("all pairs of 100 scans are compared");
  EXPECT_NE(said, std::string::npos) << outcome_.err;
  EXPECT_LT(said, outcome_.err.find("comparing")) << outcome_.err;
  expectPredicted(0, "not-joined");
}

TEST_F(Methods, WithPosesMatchingStartsAtTheOdometry)
{
  write({turned().scans[0], turned().scans[1]});
  writeOdometry({turned().truth[0], turned().truth[1]});
  run(0);
  expectOption("initial-guess", "odometry", "default");
  EXPECT_TRUE(summary_["warnings"].empty());
  expectPath({turned().truth[0], turned().truth[1]});
}

TEST_F(Methods, FeaturesCanBeAskedForWherePosesAreWrong)
{
  write(turned().scans);
  writeOdometry({kIdentity,
                 pcl6d::poseFromEuler({9, 0, 0}, {}),
                 pcl6d::poseFromEuler({0, 20, 0}, {0, 0, 3}),
                 pcl6d::poseFromEuler({0, 0, 5}, {1, 0, 0})});
  run(0, {"--initial-guess", "features", "--seed", "4"});
  expectOption("initial-guess", "features", "given");
  expectPath(turned().truth);
}

TEST_F(Methods, OdometryWithoutPosesStartsWhereTheScanBeforeIs)
{
  write({turned().scans[0], turned().scans[1]});
  run(3, {"--initial-guess", "odometry", "--recovery", "off"}); // turned by 60 degrees
  expectOption("initial-guess", "odometry", "given");
  ASSERT_EQ(summary_["warnings"].size(), 1u);
  const std::string warning = summary_["warnings"][0];
  EXPECT_NE(warning.find("each scan starts at the pose of the scan before"),
            std::string::npos)
      << warning;
  run(0, {"--initial-guess", "odometry"});
  expectPath({turned().truth[0], turned().truth[1]});
  EXPECT_EQ(summary_["scans"][1]["recovered"], "search");
}

TEST_F(Methods, OdometryWithoutPosesFitsScansTakenCloseTogether)
{
  pcl6d::Random random(1);
  const pcl6d::test::PillarRoom room;
  const Eigen::Isometry3d truth = pcl6d::poseFromEuler({0.1, -0.1, 0}, {0, 0, 0.05});
  write({room.scan(kIdentity, random), room.scan(truth, random)});
  run(0, {"--initial-guess", "odometry"});
  expectPath({kIdentity, truth});
}

TEST_F(Methods, UnrelatedScansWithoutPosesArePredicted)
{
  pcl6d::Random random(5);
  write({turned().scans[0], pcl6d::test::heap(random)});
  run(3);
  expectOption("initial-guess", "global", "default");
  expectPredicted(1, "not-joined");
  EXPECT_NE(outcome_.out.find("2 scans without a clear place"), std::string::npos)
      << outcome_.out;
  const auto found = poses();
  EXPECT_GT(pcl6d::distanceBetween(found[0], found[1]).translation, 1)
      << "beside the other, not in it";
}

TEST_F(Methods, TwoSitesInOneFolderAreBothDelivered)
{
  pcl6d::Random random(5);
  pcl6d::test::PillarRoom other;
  other.walls = {Eigen::Vector3d(-2.6, -9, -1), Eigen::Vector3d(2.5, 4, 1.4)};
  other.pillars = {{Eigen::Vector3d(-1, 2.5, -1), Eigen::Vector3d(-0.2, 3.3, 1.4)},
                   {Eigen::Vector3d(1.3, -6, -1), Eigen::Vector3d(1.9, -5, 0.7)}};
  const std::vector<Eigen::Isometry3d> truth = {
      kIdentity, pcl6d::poseFromEuler({0.7, -1.2, 0.05}, {0, 0, 2})};
  std::vector<Points> scans = turned().scans;
  for (const auto& pose : truth)
    scans.push_back(other.scan(pose, random));
  write(scans);
  run(3, {"--no-picture"});
  EXPECT_NE(outcome_.out.find("2 scans not joined to the others"), std::string::npos)
      << outcome_.out;
  EXPECT_EQ(summary_["graph"]["disconnected"], json::array({"scan4.xyz", "scan5.xyz"}));
  const auto found = poses();
  const auto error = pcl6d::distanceBetween(truth[0].inverse() * truth[1],
                                            found[4].inverse() * found[5]);
  EXPECT_LT(error.translation, 0.05) << "right in itself";
}

TEST_F(Methods, OverlapRepairsOdometryThatIsFarOff)
{
  pcl6d::Random random(1);
  const pcl6d::test::PillarRoom room;
  const Eigen::Isometry3d truth = pcl6d::poseFromEuler({0.8, 0.3, 0}, {0, 0, 0.2});
  write({room.scan(kIdentity, random, 0.03), room.scan(truth, random, 0.03)});
  Eigen::Isometry3d wrong = truth;
  wrong.translation() += Eigen::Vector3d(0.9, -1.2, 0); // 1.5 m
  writeOdometry({kIdentity, wrong});
  const std::vector<std::string> narrow = {
      "--voxel", "0.1", "--max-distance-start", "0.3"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), narrow.begin(), narrow.end());
    return more;
  };
  run(3, with({"--no-recovery"})); // the former word
  expectOption("recovery", "off", "given");
  const std::vector<std::string> overlap =
      with({"--recovery", "off", "--initial-guess", "overlap"});
  run(0, overlap);
  expectOption("initial-guess", "overlap", "given");
  expectPath({kIdentity, truth});
  run(0, narrow); // found again where it was lost
  expectPath({kIdentity, truth});
}

TEST_F(Methods, AMatchThatLetsFewerPointsMeetIsPredicted)
{
  const pcl6d::test::TornPair pair;
  write({pair.first, pair.second});
  writeOdometry({kIdentity, pair.truth});
  const std::vector<std::string> wide = {"--metric",
                                         "point",
                                         "--voxel",
                                         "0.1",
                                         "--max-distance",
                                         "3",
                                         "--max-distance-start",
                                         "0"};
  run(3, wide);
  expectPredicted(1, "agreement-lost");
  EXPECT_TRUE(summary_["scans"][1]["covariance"].is_null());
  expectPath({kIdentity, pair.truth}); // as the odometry has it
}

TEST_F(Methods, AScanOfAPipeIsPredicted)
{
  pcl6d::Random random(6);
  write({pcl6d::test::smoothPipe(random, 0), pcl6d::test::smoothPipe(random, 1.3)});
  const Eigen::Isometry3d odometry = pcl6d::poseFromEuler({1, 0.02, 0.01}, {});
  writeOdometry({kIdentity, odometry});
  run(3);
  expectPredicted(1, "icp-failed");
  EXPECT_EQ(summary_["scans"][1]["status"], "rank-deficient");
  EXPECT_LT(pcl6d::distanceBetween(poses()[1], odometry).translation, 1e-12);
}

TEST_F(Methods, TheConfigTakesTheSameWords)
{
  write({turned().scans[0], turned().scans[1]});
  writeOdometry({turned().truth[0], turned().truth[1]});
  const std::string config = folder_ / "run.cfg";
  writeText(config,
            "metric = plane\nminimiser = svd\nplane-minimiser = linear\n"
            "search = octree\nrobust = huber\ninitial-guess = overlap\n");
  run(0, {"--config", config, "--robust", "cauchy"});
  expectOption("metric", "plane", "given");
  expectOption("minimiser", "svd", "given");
  expectOption("plane-minimiser", "linear", "given");
  expectOption("search", "octree", "given");
  expectOption("initial-guess", "overlap", "given");
  expectOption("robust", "cauchy", "given"); // the command line wins
  const std::string of_config = readText(out_ / "trajectory.kitti");
  const std::vector<std::string> words = {"--metric=plane",
                                          "--plane-minimiser=linear",
                                          "--robust=cauchy",
                                          "--initial-guess=overlap"};
  run(0, words); // searched otherwise, and with another minimiser of points
  EXPECT_EQ(readText(out_ / "trajectory.kitti"), of_config);
  expectOption("search", "remembered", "default");
  run(0);
  EXPECT_NE(readText(out_ / "trajectory.kitti"), of_config) << "the words do count";
  expectOption("metric", "gicp", "default");
}

TEST(MethodsHelp, ListsTheWords)
{
  const Outcome outcome = pcl6d::test::runProgram("pcl_slam6d", {"--help"});
  for (const char* words :
       {"point|plane|gicp",
        "kdtree|cached-tree|remembered|approximate|octree|brute-force|", // a line ends
        "flann: search",
        "none|huber|cauchy|geman-mcclure",
        "auto|odometry|overlap|features|global",
        "linear|helix",
        "(=gicp)",
        "(=remembered)"})
    EXPECT_NE(outcome.out.find(words), std::string::npos) << words;
}
