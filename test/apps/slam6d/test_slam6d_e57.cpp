// SPDX-License-Identifier: BSD-3-Clause
// An E57 file in place of a folder: the same map, and its poses written back.
#include "apps/convert/convert_test.h"
#include "apps/support/corridor_run.h"

#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/run/run_summary.h>
#include <pcl6d/sources/e57_source.h>

#include <gtest/gtest.h>

namespace {

using namespace pcl6d::test;
namespace fs = std::filesystem;

/** \brief Six scans of the corridor as a folder and as an E57 file, and the map of each. */
class Slam6dE57 : public testing::Test {
protected:
  static void
  SetUpTestSuite()
  {
    folder_ = new TempFolder;
    converted(
        {"scans", scans().string(), "-o", site().string(), "--last", "5", "--quiet"});
    const std::vector<std::string> options = {"--last", "5", "--quiet", "--no-picture"};
    of_folder_ = slam(scans(), *folder_ / "of_folder", options);
    of_site_ = slam(site(), *folder_ / "of_site", {"--quiet", "--no-picture"});
  }
  static void
  TearDownTestSuite()
  {
    delete folder_;
  }

  static fs::path
  site()
  {
    return *folder_ / "site.e57";
  }
  static fs::path
  run()
  {
    return *folder_ / "of_site";
  }

  static inline TempFolder* folder_ = nullptr;
  static inline Outcome of_folder_, of_site_;
};

TEST_F(Slam6dE57, GivesTheMapOfTheFolder)
{
  ASSERT_EQ(of_site_.exit_code, of_folder_.exit_code) << of_site_.err;
  const auto expected = pcl6d::readTrajectory(*folder_ / "of_folder/trajectory.kitti");
  const auto found = pcl6d::readTrajectory(run() / "trajectory.kitti");
  ASSERT_EQ(found.poses.size(), 6U);
  // E57 holds quaternions: initial poses differ in their last bits, and what follows from them.
  constexpr double kRounding = 1e-9;
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_LT((found.poses[i].matrix() - expected.poses[i].matrix()).norm(), kRounding)
        << i;
  const auto summary = pcl6d::readRunSummary(run() / "summary.json");
  EXPECT_EQ(summary.pose_source, "site.e57");
  EXPECT_EQ(summary.scans[5].file, "scan005");
  EXPECT_TRUE(fs::exists(run() / "scans/scan005.pcd"));
}

TEST_F(Slam6dE57, IsResumedAndGoesOn)
{
  const fs::path part = *folder_ / "part";
  ASSERT_EQ(slam(site(), part, {"--last", "3", "--quiet", "--no-picture"}).exit_code,
            0);
  const Outcome outcome = runProgram(
      "pcl_slam6d",
      {site().string(), "--continue", part.string(), "--quiet", "--no-picture"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto summary = pcl6d::readRunSummary(part / "summary.json");
  ASSERT_EQ(summary.scans.size(), 6U);
  EXPECT_EQ(summary.scans[5].file, "scan005");
}

TEST_F(Slam6dE57, PosesGoBackIntoTheFile)
{
  const fs::path out = *folder_ / "registered.e57";
  EXPECT_EQ(
      converted(
          {"poses", run().string(), "-o", out.string(), "--into", site().string()}),
      "6 poses of 6 scans written\n");
  const auto trajectory = pcl6d::readTrajectory(run() / "trajectory.kitti");
  const pcl6d::E57Source source(out);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_LT((source.scans()[i].pose->matrix() - trajectory.poses[i].matrix()).norm(),
              1e-13)
        << i;
  EXPECT_EQ(source.read(3).cloud.data, pcl6d::E57Source(site()).read(3).cloud.data);
}

TEST_F(Slam6dE57, PosesGoIntoNoOtherFile)
{
  const fs::path other = *folder_ / "other.e57", out = *folder_ / "no.e57";
  converted(
      {"scans", scans().string(), "-o", other.string(), "--first", "2", "--quiet"});
  expectConvertError(
      {"poses", run().string(), "-o", out.string(), "--into", other.string()},
      1,
      {"other.e57: is not the file that the run in ",
       "its scan 0 is called 'scan002', the run has 'scan000'"});
  expectConvertError(
      {"poses", run().string(), "-o", site().string(), "--into", site().string()},
      2,
      {"site.e57"});
  expectConvertError({"poses",
                      (*folder_ / "none").string(),
                      "-o",
                      out.string(),
                      "--into",
                      site().string()},
                     1,
                     {"none"});
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(Slam6dE57, WhatIsBrokenEndsInOneLine)
{
  const fs::path broken = *folder_ / "broken.e57";
  std::string bytes = readText(site());
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] + 1);
  writeText(broken, bytes);
  expectError(slam(broken, *folder_ / "out"),
              "pcl_slam6d",
              1,
              {"broken.e57: page ", "wrong checksum, the content is damaged"});
  expectError(slam(*folder_ / "missing.e57", *folder_ / "out"),
              "pcl_slam6d",
              1,
              {"missing.e57: No such file or directory"});
  expectError(slam(site(), *folder_ / "out", {"--format", "pcd"}),
              "pcl_slam6d",
              2,
              {"format = pcd, but ", "is a file of several scans"});
  expectError(slam(site(), *folder_ / "out", {"--deskew"}),
              "pcl_slam6d",
              1,
              {"site.e57: --deskew needs the time stamps"});
  EXPECT_FALSE(fs::exists(*folder_ / "out"));
}

} // namespace
