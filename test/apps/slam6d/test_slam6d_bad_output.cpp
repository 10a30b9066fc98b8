// SPDX-License-Identifier: BSD-3-Clause
// Output folders that are refused, and what a failure leaves in them.
#include "apps/support/bad_input.h"

namespace {
namespace fs = std::filesystem;
using pcl6d::test::BadInput;
using pcl6d::test::contentOf;
using pcl6d::test::kName;
using pcl6d::test::pcd;
using pcl6d::test::readText;
using pcl6d::test::writeText;
} // namespace

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

TEST_F(BadInput, LinksOfScansAndGivenLinksInsideTheOutput)
{
  ASSERT_EQ(pcl6d::test::runProgram(kName, {in.string(), "-o", out.string()}).exit_code,
            0);
  const auto before = contentOf(out);
  const std::string graph = out / "graph.g2o";
  pcl6d::test::expectError(
      pcl6d::test::runProgram(kName,
                              {in.string(), "-o", out.string(), "--graph-in", graph}),
      kName,
      1,
      {graph, "inside"});
  fs::create_directory(folder / "links");
  for (const auto& entry : fs::directory_iterator(out / "scans"))
    fs::create_symlink(entry.path(), folder / "links" / entry.path().filename());
  pcl6d::test::expectError(
      pcl6d::test::runProgram(kName, {folder / "links", "-o", out.string()}),
      kName,
      1,
      {"links/scan000.pcd", "inside"});
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
  auto after = contentOf(out);
  EXPECT_EQ(after.erase(".pcl6d-journal"), 1U); // what was computed is kept
  EXPECT_EQ(after, before);
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
