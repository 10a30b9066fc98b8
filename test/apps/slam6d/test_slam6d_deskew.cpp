// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d --deskew: scans that were taken on the move.
#include "apps/support/bad_input.h"
#include "apps/support/corridor_run.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/trajectory_io.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace {
namespace fs = std::filesystem;
using pcl6d::test::contentOf;
using pcl6d::test::kName;
using pcl6d::test::Outcome;
using pcl6d::test::runProgram;
using pcl6d::test::slam;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

// The corridor scanned on the move, 0.6 m per scan, made once for all tests.
const fs::path&
movingScans()
{
  static const TempFolder folder;
  static const fs::path path = folder / "scans";
  if (!fs::exists(path))
    runProgram("pcl_slam6d_simulate",
               {"corridor",
                "-o",
                path.string(),
                "--motion",
                "continuous",
                "--scans",
                "80",
                "--resolution",
                "2",
                "--quiet"});
  return path;
}

// Position rms [m] against the truth, without alignment.
double
positionRms(const fs::path& run)
{
  const auto truth = pcl6d::readTrajectory(movingScans() / "groundtruth.txt");
  const auto poses = pcl6d::readTrajectory(run / "trajectory.kitti").poses;
  double sum_sq = 0;
  for (std::size_t i = 0; i < poses.size(); ++i)
    sum_sq += (poses[i].translation() - truth.poses[i].translation()).squaredNorm();
  return std::sqrt(sum_sq / static_cast<double>(poses.size()));
}

bool
holds(const pcl::PCLPointCloud2& cloud, const std::string& field)
{
  return std::any_of(cloud.fields.begin(), cloud.fields.end(), [&](const auto& f) {
    return f.name == field;
  });
}
} // namespace

TEST(Deskew, BringsScansOnTheMoveNearerToTheTruth)
{
  const TempFolder folder;
  const std::vector<std::string> part = {"--last", "15"};
  slam(movingScans(), folder / "raw", part);
  const Outcome outcome =
      slam(movingScans(), folder / "deskewed", {"--last", "15", "--deskew"});
  EXPECT_NE(outcome.err.find("field t, in s since the scan's stamp"), std::string::npos)
      << outcome.err;
  const double raw = positionRms(folder / "raw");
  const double deskewed = positionRms(folder / "deskewed");
  RecordProperty("rms", std::to_string(raw) + " m to " + std::to_string(deskewed));
  EXPECT_LT(deskewed, 0.7 * raw);
  EXPECT_LT(deskewed, 0.03);
  const auto scan = pcl6d::readPcd(folder / "deskewed" / "scans" / "scan003.pcd");
  EXPECT_TRUE(holds(scan, "t"));
  EXPECT_TRUE(holds(scan, "intensity"));
  const auto measured = pcl6d::readPcd(folder / "raw" / "scans" / "scan003.pcd");
  ASSERT_EQ(scan.data.size(), measured.data.size());
  EXPECT_TRUE(scan.data != measured.data) << "scans/ holds the corrected points";
  // Its stamps are those of the scans.
  const auto stamps = pcl6d::readStamps(movingScans() / "times.txt");
  const auto tum = pcl6d::readTrajectory(folder / "deskewed" / "trajectory.tum");
  EXPECT_EQ(tum.stamps, std::vector<double>(stamps.begin(), stamps.begin() + 16));
}

TEST(Deskew, HasTheSameBytesForEveryThreadCount)
{
  const TempFolder folder;
  const auto bytes = [&](const std::string& threads) {
    const fs::path out = folder / threads;
    slam(movingScans(),
         out,
         {"--last", "5", "--deskew", "--interpolation", "cubic", "--threads", threads});
    auto content = contentOf(out);
    EXPECT_EQ(content.erase("summary.json"), 1u); // holds times
    return content;
  };
  const auto expected = bytes("1");
  EXPECT_TRUE(bytes("2") == expected); // megabytes, not to be printed
  EXPECT_TRUE(bytes("8") == expected);
}

TEST(Deskew, InterpolationWithoutItIsToldToBeOfNoUse)
{
  const TempFolder folder;
  const Outcome outcome =
      slam(movingScans(), folder / "out", {"--last", "1", "--interpolation", "cubic"});
  EXPECT_NE(outcome.err.find("interpolation"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("--deskew"), std::string::npos) << outcome.err;
}

namespace {
// Three scans, 1 s and 1 m apart, whose points have a time.
class DeskewInput : public pcl6d::test::BadInput {
protected:
  void
  SetUp() override
  {
    fs::create_directory(in);
    for (int i = 0; i < 3; ++i)
      writeScan(i, [](int k) { return std::to_string(0.01 * k); });
    writeText(in / "times.txt", "10\n11\n12\n");
    writeText(in / "odometry.txt",
              "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 1 0 1 0 0 0 0 1 0\n"
              "1 0 0 2 0 1 0 0 0 0 1 0\n");
  }

  // \param[in] type of the field t: F or U, 4 bytes
  void
  writeScan(int i,
            const std::function<std::string(int)>& time,
            const std::string& type = "F",
            const std::string& name = "t")
  {
    std::string body;
    for (int k = 0; k < 64; ++k)
      body += std::to_string(k % 4) + " " + std::to_string(k / 4 % 4) + " " +
              std::to_string(k / 16) + " " + time(k) + "\n";
    std::string text = pcl6d::test::pcd("x y z t", 64, body);
    text.replace(text.find("TYPE F F F F"), 12, "TYPE F F F " + type);
    text.replace(text.find("x y z t"), 7, "x y z " + name);
    writeText(in / ("scan00" + std::to_string(i) + ".pcd"), text);
  }

  Outcome
  deskew() const
  {
    return slam(in, out, {"--deskew"});
  }

  void
  expectDeskewRefused(const std::vector<std::string>& words)
  {
    pcl6d::test::expectError(deskew(), kName, 1, words);
    EXPECT_FALSE(fs::exists(out));
  }
};
} // namespace

TEST_F(DeskewInput, UnitsFollowFromTypeAndRange)
{
  const auto expectUnit = [&](const std::string& unit) {
    const Outcome outcome = deskew();
    EXPECT_NE(outcome.err.find(unit), std::string::npos) << outcome.err;
    const auto scan = pcl6d::readScan(out / "scans" / "scan001.pcd");
    // Point 63 was measured 0.63 s and 0.63 m after the stamp.
    EXPECT_NEAR(scan.points[63].x(), 3 + 0.63, 1e-6);
    EXPECT_EQ(scan.points[0].x(), 0);
  };
  expectUnit("field t, in s since");
  for (int i = 0; i < 3; ++i)
    writeScan(
        i, [](int k) { return std::to_string(10'000'000 * k); }, "U");
  expectUnit("field t, in ns since");
  for (int i = 0; i < 3; ++i)
    writeScan(
        i, [](int k) { return std::to_string(10'000 * k); }, "U", "time");
  expectUnit("field time, in us since");
}

TEST_F(DeskewInput, PointsMeasuredAtTheStampStayWhereTheyAre)
{
  for (int i = 0; i < 3; ++i)
    writeScan(i, [](int) { return "0"; });
  const Outcome raw = slam(in, folder / "raw");
  ASSERT_NE(raw.exit_code, 1) << raw.err;
  deskew();
  auto expected = contentOf(folder / "raw");
  auto content = contentOf(out);
  expected.erase("summary.json");
  content.erase("summary.json");
  EXPECT_TRUE(content == expected);
}

TEST_F(DeskewInput, NoTimeField)
{
  writeText(in / "scan002.pcd", pcl6d::test::grid());
  expectDeskewRefused({"scan002.pcd", "no field t or time", "fields: x y z"});
  writeText(in / "scan000.pcd", pcl6d::test::grid());
  expectDeskewRefused({"scan000.pcd", "no field t or time"});
}

TEST_F(DeskewInput, NoStamps)
{
  fs::remove(in / "times.txt");
  expectDeskewRefused({in.string(), "time stamps", "times.txt", "odometry.txt"});
}

TEST_F(DeskewInput, NoPoses)
{
  fs::remove(in / "odometry.txt");
  for (int i = 0; i < 3; ++i) { // VIEWPOINT would be a pose
    auto text = pcl6d::test::readText(in / ("scan00" + std::to_string(i) + ".pcd"));
    text.replace(text.find("VIEWPOINT 1"), 11, "VIEWPOINT 0");
    writeText(in / ("scan00" + std::to_string(i) + ".pcd"), text);
  }
  expectDeskewRefused({in.string(), "no poses"});
}

TEST_F(DeskewInput, OneScan)
{
  fs::remove(in / "scan001.pcd");
  fs::remove(in / "scan002.pcd");
  writeText(in / "times.txt", "10\n");
  writeText(in / "odometry.txt", pcl6d::test::kIdentityRow);
  expectDeskewRefused({in.string(), "number of poses = 1"});
}

TEST_F(DeskewInput, TimesThatAreNoNumbers)
{
  writeScan(1, [](int k) { return k == 5 || k == 6 ? "nan" : "0.1"; });
  expectDeskewRefused({"scan001.pcd", "field t is not finite", "= 2"});
}

TEST_F(DeskewInput, TimesOutsideTheScansPeriod)
{
  writeScan(1, [](int k) { return k == 5 ? "1.75" : "0.1"; });
  expectDeskewRefused({"scan001.pcd", "field t", "1.75", "period of 1.0"});
  writeScan(1, [](int k) { return k == 5 ? "-1.75" : "0.1"; });
  expectDeskewRefused({"scan001.pcd", "field t", "1.75", "period of 1.0"});
  writeScan(0, [](int k) { return k == 5 ? "1.75" : "0.1"; });
  expectDeskewRefused({"scan000.pcd", "field t", "1.75", "period of 1.0"});
}

TEST_F(DeskewInput, NegativeAndUnorderedTimesWithinThePeriodAreFine)
{
  for (int i = 0; i < 3; ++i) // the stamp in the middle of the scan, rings one by one
    writeScan(i, [](int k) { return std::to_string(0.1 * (k % 8) - 0.4); });
  const Outcome outcome = deskew();
  EXPECT_NE(outcome.exit_code, 1) << outcome.err;
  const auto scan = pcl6d::readScan(out / "scans" / "scan001.pcd");
  EXPECT_NEAR(scan.points[0].x(), -0.4, 1e-6);
  EXPECT_NEAR(scan.points[7].x(), 3 + 0.3, 1e-6);
}

TEST_F(DeskewInput, BrokenStamps)
{
  writeText(in / "times.txt", "10\n12\n11\n");
  expectDeskewRefused({"times.txt", "line 3", "increase"});
  writeText(in / "times.txt", "10\n12\n");
  expectDeskewRefused({"times.txt", "2 time stamps", "3 scans"});
}

TEST_F(DeskewInput, UnknownInterpolation)
{
  expectUsageError(
      {in.string(), "-o", out.string(), "--deskew", "--interpolation", "magic"},
      {"--interpolation = magic", "linear or cubic"});
}

TEST(Deskew, GoesOnWithScansOfOneASecond)
{
  // The run's trajectory has 0, 1, 2, ... where it knows no stamps, too.
  const TempFolder folder;
  const fs::path in = folder / "in", run = folder / "run";
  runProgram("pcl_slam6d_simulate",
             {"corridor",
              "--motion",
              "continuous",
              "--scans",
              "8",
              "--scanner",
              "ouster",
              "--period",
              "1",
              "--resolution",
              "2",
              "--quiet",
              "-o",
              in.string()});
  slam(in, run, {"--last", "3", "--deskew", "--no-picture"});
  ASSERT_TRUE(fs::exists(run / "summary.json"));
  const Outcome outcome = runProgram(
      kName, {in.string(), "--continue", run.string(), "--last", "5", "--no-picture"});
  EXPECT_NE(outcome.exit_code, 1) << outcome.err;
  EXPECT_TRUE(fs::exists(run / "scans" / "scan005.pcd"));
}
