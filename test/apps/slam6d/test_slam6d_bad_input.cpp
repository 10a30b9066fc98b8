// SPDX-License-Identifier: BSD-3-Clause
// What a user may get wrong: one line that says what and where, and nothing half-written.
#include "apps/support/bad_input.h"

#include <pcl6d/io/trajectory_io.h>

namespace {
namespace fs = std::filesystem;
using pcl6d::test::BadInput;
using pcl6d::test::grid;
using pcl6d::test::kIdentityRow;
using pcl6d::test::kName;
using pcl6d::test::pcd;
using pcl6d::test::writeText;
} // namespace

TEST_F(BadInput, TheGoodFolderIsNotRefused)
{
  const auto outcome =
      pcl6d::test::runProgram(kName, {in.string(), "-o", out.string()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST_F(BadInput, MissingFolder)
{
  fs::remove_all(in);
  fs::create_directory(folder / "other");
  const auto outcome =
      pcl6d::test::runProgram(kName, {in.string(), "-o", out.string()});
  pcl6d::test::expectError(outcome, kName, 1, {in.string(), "no such folder"});
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(BadInput, EmptyFolder)
{
  fs::remove_all(in);
  fs::create_directory(in);
  expectRefused({in.string(), "no scans"});
}

TEST_F(BadInput, ScanWithoutPoints)
{
  writeText(in / "scan001.pcd", pcd("x y z", 0, ""));
  expectRefused({"scan001.pcd", "0 points", "at least 3"});
}

TEST_F(BadInput, ScanWithTwoPoints)
{
  writeText(in / "scan001.pcd", pcd("x y z", 2, "1 2 3\n4 5 6\n"));
  expectRefused({"scan001.pcd", "2 points", "at least 3"});
}

TEST_F(BadInput, ScanOfNaN)
{
  writeText(in / "scan002.pcd",
            pcd("x y z", 4, "nan nan nan\nnan nan nan\nnan nan nan\nnan nan nan\n"));
  expectRefused({"scan002.pcd", "0 points", "4 without"});
}

TEST_F(BadInput, TruncatedHeader)
{
  writeText(in / "scan001.pcd", grid().substr(0, 40));
  expectRefused({"scan001.pcd"});
}

TEST_F(BadInput, TruncatedBody)
{
  writeText(in / "scan001.pcd", grid().substr(0, grid().size() - 60));
  expectRefused({"scan001.pcd", "64"});
}

TEST_F(BadInput, NoZ)
{
  writeText(in / "scan001.pcd", pcd("x y", 3, "1 2\n3 4\n5 6\n"));
  expectRefused({"scan001.pcd", "z"});
}

TEST_F(BadInput, TextWhereANumberBelongs)
{
  writeText(in / "scan001.pcd", pcd("x y z", 3, "1 2 3\n4 five 6\n7 8 9\n"));
  expectRefused({"scan001.pcd", "line 12", "five"});
}

TEST_F(BadInput, MeshWithoutVertices)
{
  for (const char* name : {"scan000.pcd", "scan001.pcd", "scan002.pcd"})
    fs::remove(in / name);
  writeText(in / "scan000.ply",
            "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\n"
            "property float y\nproperty float z\nelement face 0\n"
            "property list uchar int vertex_indices\nend_header\n");
  expectRefused({"scan000.ply", "0 points"});
}

TEST_F(BadInput, TooFewPoses)
{
  writeText(in / "odometry.txt", std::string(kIdentityRow) + kIdentityRow);
  expectRefused({"odometry.txt", "2", "scan002.pcd"});
}

TEST_F(BadInput, TooManyPoses)
{
  std::string rows;
  for (int i = 0; i < 4; ++i)
    rows += kIdentityRow;
  writeText(in / "odometry.txt", rows);
  expectRefused({"odometry.txt", "4", "3"});
}

TEST_F(BadInput, PoseThatIsNotRigid)
{
  writeText(in / "odometry.txt",
            std::string(kIdentityRow) + "2 0 0 0 0 1 0 0 0 0 1 0\n" + kIdentityRow);
  expectRefused({"odometry.txt", "line 2", "rigid"});
}

TEST_F(BadInput, FolderInTheFilesPlace) // unreadable, also for root
{
  fs::remove(in / "scan001.pcd");
  fs::create_directory(in / "scan001.pcd");
  expectRefused({"scan001.pcd"});
}

TEST_F(BadInput, UnknownOption)
{
  expectUsageError({in.string(), "-o", out.string(), "--voxle", "1"}, {"voxle"});
}

TEST_F(BadInput, OptionsOutOfRange)
{
  using Case = std::pair<std::string, std::string>;
  for (const auto& [option, value] : {Case("--voxel", "-1"),
                                      Case("--voxel", "nan"),
                                      Case("--voxel", "abc"),
                                      Case("--max-distance", "0"),
                                      Case("--min-range", "-0.1"),
                                      Case("--metascan", "0"),
                                      Case("--metascan", "few"),
                                      Case("--iterations", "0"),
                                      Case("--min-overlap", "2"),
                                      Case("--threads", "-1"),
                                      Case("--threads", "2000000000"),
                                      Case("--seed", "-1"),
                                      Case("--voxel", "inf"),
                                      Case("--every", "0"),
                                      Case("--first", "-1"),
                                      Case("--first", "3"),
                                      Case("--format", "dxf")}) {
    SCOPED_TRACE(option + " " + value);
    expectUsageError({in.string(), "-o", out.string(), option, value}, {value});
  }
}

TEST_F(BadInput, UnknownWordsOfMethods)
{
  const std::vector<std::pair<std::string, std::string>> lists = {
      {"metric", "point|plane|gicp"},
      {"minimiser",
       "svd|quaternion|orthonormal|dual-quaternion|helix|small-angle|euler|"
       "quaternion-linear"},
      {"plane-minimiser", "linear|helix"},
      {"search", "kdtree|cached-tree|remembered|approximate|octree|brute-force|flann"},
      {"robust", "none|huber|cauchy|geman-mcclure"},
      {"initial-guess", "odometry|overlap|features|global"}};
  for (const auto& [option, list] : lists)
    for (const std::string word : {"gicpp", "Point", "none "}) {
      SCOPED_TRACE(option + " '" + word + "'");
      expectUsageError({in.string(), "-o", out.string(), "--" + option + "=" + word},
                       {"--" + option, list});
    }
}

TEST_F(BadInput, AScale)
{
  const std::string config = folder / "run.cfg";
  writeText(config, "minimiser = scale-quaternion\n");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--minimiser", "scale-quaternion"},
        {"--minimiser=scale-quaternion"},
        {"--config", config},
        {"--scale"},
        {"--scale=1"}}) {
    SCOPED_TRACE(words.back());
    std::vector<std::string> arguments = {in.string(), "-o", out.string()};
    arguments.insert(arguments.end(), words.begin(), words.end());
    expectUsageError(arguments, {"one scale", "pcl_slam6d_evaluate icp"});
  }
}

TEST_F(BadInput, UnknownWordsOfMethodsInTheConfig)
{
  const std::string config = folder / "run.cfg";
  for (const char* option : {"metric",
                             "minimiser",
                             "plane-minimiser",
                             "search",
                             "robust",
                             "initial-guess"}) {
    writeText(config, std::string(option) + " = best\n");
    expectUsageError({in.string(), "-o", out.string(), "--config", config},
                     {std::string("--") + option + " = best"});
  }
}

TEST_F(BadInput, MissingArguments)
{
  expectUsageError({"--quiet"}, {"SCAN_DIR"});
  expectUsageError({in.string()}, {"-o"});
  expectUsageError({in.string(), "more", "-o", out.string()}, {"SCAN_DIR", "--help"});
}

TEST_F(BadInput, BrokenConfig)
{
  const std::string config = folder / "run.cfg";
  expectUsageError({in.string(), "-o", out.string(), "--config", config}, {"run.cfg"});
  writeText(config, "config = other.cfg\n");
  expectUsageError({in.string(), "-o", out.string(), "--config", config},
                   {"run.cfg", "config"});
  writeText(config, "voxle = 1\n");
  expectUsageError({in.string(), "-o", out.string(), "--config", config},
                   {"run.cfg", "voxle"});
}

TEST(PosesInFeet, AreNamedThoughRaysAreNoJudgesThere)
{
  // Where all places are wrong rays contradict as much as a bad scanner's: that alone is
  // "unverified".
  constexpr double kFeetPerMetre = 3.280839895;
  const pcl6d::test::TempFolder folder;
  const std::string scans = folder / "scans";
  pcl6d::test::runProgram("pcl_slam6d_simulate",
                          {"crowd",
                           "-o",
                           scans,
                           "--scans",
                           "30",
                           "--resolution",
                           "3",
                           "--seed",
                           "4",
                           "--quiet"});
  pcl6d::Trajectory odometry = pcl6d::readTrajectory(folder / "scans/odometry.txt");
  for (auto& pose : odometry.poses)
    pose.translation() *= kFeetPerMetre;
  pcl6d::writeTrajectoryKitti(folder / "feet.txt", odometry);
  const auto outcome = pcl6d::test::runProgram(kName,
                                               {scans,
                                                "-o",
                                                folder / "out",
                                                "--poses",
                                                folder / "feet.txt",
                                                "--last",
                                                "12",
                                                "--no-picture"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_NE(outcome.out.find("initial poses: positions are in feet"), std::string::npos)
      << outcome.out;
}
