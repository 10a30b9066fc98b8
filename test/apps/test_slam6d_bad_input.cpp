// SPDX-License-Identifier: BSD-3-Clause
// What a user may get wrong: one line that says what and where, and nothing half-written.
#include "support/run_program.h"

#include <gtest/gtest.h>

#include <functional>

namespace {
namespace fs = std::filesystem;
using pcl6d::test::contentOf;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

constexpr const char* kName = "pcl_slam6d";

/** A scan with a pose, from which matching starts. */
std::string
pcd(const std::string& fields, int count, const std::string& body)
{
  std::string sizes, types, counts;
  for (std::size_t i = 0; i < (fields.size() + 1) / 2; ++i) {
    sizes += " 4";
    types += " F";
    counts += " 1";
  }
  const std::string n = std::to_string(count);
  return "VERSION 0.7\nFIELDS " + fields + "\nSIZE" + sizes + "\nTYPE" + types +
         "\nCOUNT" + counts + "\nWIDTH " + n +
         "\nHEIGHT 1\nVIEWPOINT 1 0 0 1 0 0 0\nPOINTS " + n + "\nDATA ascii\n" + body;
}

std::string
grid()
{
  std::string body;
  for (int i = 0; i < 64; ++i)
    body += std::to_string(i % 4) + " " + std::to_string(i / 4 % 4) + " " +
            std::to_string(i / 16) + "\n";
  return pcd("x y z", 64, body);
}

constexpr const char* kIdentityRow = "1 0 0 0 0 1 0 0 0 0 1 0\n";

/** Three good scans in a folder "in", which each test then spoils. */
class BadInput : public testing::Test {
protected:
  void
  SetUp() override
  {
    fs::create_directory(in);
    for (const char* name : {"scan000.pcd", "scan001.pcd", "scan002.pcd"})
      writeText(in / name, grid());
  }

  /** Runs on "in" and expects an error with the words; nothing else may change. */
  void
  expectRefused(const std::vector<std::string>& words)
  {
    const auto before = contentOf(in);
    const auto outcome =
        pcl6d::test::runProgram(kName, {in.string(), "-o", out.string()});
    pcl6d::test::expectError(outcome, kName, 1, words);
    EXPECT_FALSE(fs::exists(out));
    EXPECT_EQ(contentOf(in), before);
  }

  void
  expectUsageError(std::vector<std::string> arguments,
                   const std::vector<std::string>& words)
  {
    const auto outcome = pcl6d::test::runProgram(kName, arguments);
    pcl6d::test::expectError(outcome, kName, 2, words);
    EXPECT_FALSE(fs::exists(out));
  }

  TempFolder folder;
  const fs::path in = folder / "in";
  const fs::path out = folder / "out";
};
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
  expectRefused({"scan000.ply", "vert"});
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

TEST_F(BadInput, OutputBelowAFile)
{
  writeText(folder / "file", "content");
  const auto outcome = pcl6d::test::runProgram(
      kName, {in.string(), "-o", (folder / "file" / "out").string()});
  pcl6d::test::expectError(outcome, kName, 1, {"file"});
  EXPECT_EQ(readText(folder / "file"), "content");
}

TEST_F(BadInput, OutputIsTheInput)
{
  const auto before = contentOf(in);
  const auto outcome =
      pcl6d::test::runProgram(kName, {in.string(), "-o", in.string() + "/", "--force"});
  pcl6d::test::expectError(outcome, kName, 1, {"input"});
  EXPECT_EQ(contentOf(in), before);
}

TEST_F(BadInput, InputInsideTheOutput) // whose old results would be removed
{
  const auto before = contentOf(folder.path());
  const auto outcome = pcl6d::test::runProgram(
      kName, {in.string(), "-o", folder.path().string(), "--force"});
  pcl6d::test::expectError(outcome, kName, 1, {in.string(), "inside"});
  EXPECT_EQ(contentOf(folder.path()), before);
}

TEST_F(BadInput, ForceKeepsForeignFilesOfTheSameName)
{
  fs::create_directories(out / "scans");
  writeText(out / "scans" / "raw.pcd", "a year of measurements");
  const auto outcome =
      pcl6d::test::runProgram(kName, {in.string(), "-o", out.string(), "--force"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(readText(out / "scans" / "raw.pcd"), "a year of measurements");
}

TEST_F(BadInput, OutputHoldsForeignFiles)
{
  fs::create_directory(out);
  writeText(out / "thesis.tex", "years of work");
  const auto outcome =
      pcl6d::test::runProgram(kName, {in.string(), "-o", out.string()});
  pcl6d::test::expectError(outcome, kName, 1, {out.string(), "--force"});
  EXPECT_EQ(contentOf(out).size(), 1u);
}

TEST_F(BadInput, LinkInTheOutputThatLeadsToTheInput)
{
  fs::create_directory(out);
  fs::create_directory_symlink(in, out / "scans");
  const auto before = contentOf(in);
  const auto outcome =
      pcl6d::test::runProgram(kName, {in.string(), "-o", out.string(), "--force"});
  pcl6d::test::expectError(outcome, kName, 1, {"link", "scans"});
  EXPECT_EQ(contentOf(in), before);
}

TEST_F(BadInput, PosesInsideTheOutput)
{
  ASSERT_EQ(pcl6d::test::runProgram(kName, {in.string(), "-o", out.string()}).exit_code,
            0);
  const auto before = contentOf(out);
  const std::string poses = out / "trajectory.kitti";
  const auto outcome = pcl6d::test::runProgram(
      kName, {in.string(), "-o", out.string(), "--poses", poses});
  pcl6d::test::expectError(outcome, kName, 1, {poses, "inside"});
  EXPECT_EQ(contentOf(out), before);
}

TEST_F(BadInput, SomebodyElsesSummaryIsNoLicence)
{
  fs::create_directories(out / "scans");
  writeText(out / "summary.json", "{\"mine\": 1}");
  writeText(out / "scans" / "mydata.txt", "mine too");
  const auto before = contentOf(out);
  const auto outcome =
      pcl6d::test::runProgram(kName, {in.string(), "-o", out.string()});
  pcl6d::test::expectError(outcome, kName, 1, {"--force"});
  EXPECT_EQ(contentOf(out), before);
}

TEST_F(BadInput, EarlierRunKeepsWhatIsNotOurs)
{
  ASSERT_EQ(pcl6d::test::runProgram(kName, {in.string(), "-o", out.string()}).exit_code,
            0);
  writeText(out / "scans" / "notes.txt", "mine");
  fs::remove(in / "scan002.pcd");
  ASSERT_EQ(pcl6d::test::runProgram(kName, {in.string(), "-o", out.string()}).exit_code,
            0);
  EXPECT_EQ(readText(out / "scans" / "notes.txt"), "mine");
  EXPECT_FALSE(fs::exists(out / "scans" / "scan002.pcd"));
}

TEST_F(BadInput, LateFailureKeepsAnEarlierRun)
{
  ASSERT_EQ(pcl6d::test::runProgram(kName, {in.string(), "-o", out.string()}).exit_code,
            0);
  fs::remove(out / "map.pcd");
  fs::create_directory(out / "map.pcd"); // found only when all is computed
  const auto before = contentOf(out);
  const auto outcome =
      pcl6d::test::runProgram(kName, {in.string(), "-o", out.string()});
  pcl6d::test::expectError(outcome, kName, 1, {"map.pcd"});
  EXPECT_EQ(contentOf(out), before);
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
                                      Case("--format", "las")}) {
    SCOPED_TRACE(option + " " + value);
    expectUsageError({in.string(), "-o", out.string(), option, value}, {value});
  }
}

TEST_F(BadInput, UnknownWordsOfMethods)
{
  const std::vector<std::pair<std::string, std::string>> lists = {
      {"metric", "point|plane|gicp"},
      {"minimiser",
       "svd|quaternion|orthonormal|dual-quaternion|scale-quaternion|helix|small-angle|"
       "euler|quaternion-linear"},
      {"plane-minimiser", "linear|helix"},
      {"search", "kdtree|cached|approximate|octree|brute-force"},
      {"robust", "none|huber|cauchy|geman-mcclure"},
      {"initial-guess", "odometry|overlap|features"}};
  for (const auto& [option, list] : lists)
    for (const std::string word : {"gicpp", "Point", "none "}) {
      SCOPED_TRACE(option + " '" + word + "'");
      expectUsageError({in.string(), "-o", out.string(), "--" + option + "=" + word},
                       {"--" + option, list});
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
  expectUsageError({}, {"SCAN_DIR"});
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

TEST_F(BadInput, FailureKeepsAnEarlierRun)
{
  ASSERT_EQ(pcl6d::test::runProgram(kName, {in.string(), "-o", out.string()}).exit_code,
            0);
  const auto before = contentOf(out);
  writeText(in / "scan001.pcd", "broken");
  const auto outcome =
      pcl6d::test::runProgram(kName, {in.string(), "-o", out.string()});
  pcl6d::test::expectError(outcome, kName, 1, {"scan001.pcd"});
  EXPECT_EQ(contentOf(out), before);
}
