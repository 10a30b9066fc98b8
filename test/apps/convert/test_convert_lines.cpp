// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_convert lines as a user runs it.
#include "support/constants.h"
#include "support/run_program.h"

#include <pcl6d/io/pcd_io.h>

#include <pcl/conversions.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace {
using pcl6d::test::kDegree;
using pcl6d::test::Outcome;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

constexpr const char* kName = "pcl_slam6d_convert";

Outcome
convert(std::vector<std::string> arguments)
{
  arguments.insert(arguments.begin(), "lines");
  return pcl6d::test::runProgram(kName, arguments);
}

struct Files : TempFolder {
  std::string
  name(const std::string& file) const
  {
    return (*this / file).string();
  }
  pcl::PointCloud<pcl::PointXYZ>
  cloud() const
  {
    pcl::PointCloud<pcl::PointXYZ> points;
    pcl::fromPCLPointCloud2(pcl6d::readPcd(*this / "out.pcd"), points);
    return points;
  }
};

// A wall 2 m ahead, seen by a nodding fan with a lever arm.
std::string
wallLines(double lever)
{
  std::ostringstream csv;
  csv.precision(17);
  csv << "# drive angle [deg], ranges [m]\n";
  for (int theta = -20; theta <= 20; theta += 5) {
    csv << theta;
    for (int beam = -40; beam <= 40; beam += 10) {
      const double reach = 2 - lever * std::cos(theta * kDegree);
      csv << ',' << reach / (std::cos(theta * kDegree) * std::cos(beam * kDegree));
    }
    csv << '\n';
  }
  return csv.str();
}
} // namespace

TEST(ConvertLines, PutsAWallTogether)
{
  const Files files;
  writeText(files / "lines.csv", wallLines(0.1));
  const Outcome outcome = convert({files.name("lines.csv"),
                                   "-o",
                                   files.name("out.pcd"),
                                   "--beam-first",
                                   "-40",
                                   "--beam-last",
                                   "40",
                                   "--lever-arm",
                                   "0.1,0,0",
                                   "--axis-position",
                                   "0,0,0.5"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("9 lines of 9 ranges, 81 returns"), std::string::npos)
      << outcome.out;
  const auto cloud = files.cloud();
  ASSERT_EQ(cloud.height, 9u);
  ASSERT_EQ(cloud.width, 9u);
  for (const auto& point : cloud)
    EXPECT_NEAR(point.x, 2, 1e-6);
  EXPECT_NEAR(cloud(4, 4).z, 0.5, 1e-6);
  EXPECT_NEAR(cloud(8, 4).y, 1.9 * std::tan(40 * kDegree), 1e-6); // to the left
  EXPECT_GT(cloud(4, 8).z, cloud(4, 0).z);                        // looks up at last
  EXPECT_EQ(pcl6d::readPcd(files / "out.pcd").fields.size(), 3u);
}

TEST(ConvertLines, MissingReturnsAreNaN)
{
  const Files files;
  writeText(files / "lines.csv", "0,1,,3\n5,0,2,nan\n");
  ASSERT_EQ(convert({files.name("lines.csv"), "-o", files.name("out.pcd")}).exit_code,
            0);
  const auto cloud = files.cloud();
  ASSERT_EQ(cloud.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_EQ(std::isnan(cloud[i].x), i == 1 || i == 3 || i == 5) << i;
}

TEST(ConvertLines, StandsAYawingFanUpright)
{
  const Files files;
  writeText(files / "lines.csv", "2000 2000 2000\n2000 2000 2000\n");
  writeText(files / "angles.csv", "angle;time\n0;7.25\n90;7.5\n");
  ASSERT_EQ(convert({files.name("lines.csv"),
                     "--angles",
                     files.name("angles.csv"),
                     "--drive",
                     "yawing",
                     "--range-unit",
                     "0.001",
                     "-o",
                     files.name("out.pcd")})
                .exit_code,
            0);
  const auto cloud = files.cloud();
  const float expected[][3] = {
      {0, 0, -2}, {2, 0, 0}, {0, 0, 2}, {0, 0, -2}, {0, 2, 0}, {0, 0, 2}};
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_LT((cloud[i].getVector3fMap() - Eigen::Vector3f(expected[i])).norm(), 1e-6f)
        << i;
  const auto fields = pcl6d::readPcd(files / "out.pcd");
  ASSERT_EQ(fields.fields.size(), 4u);
  EXPECT_EQ(fields.fields[3].name, "t");
  float t = -1;
  std::memcpy(&t, &fields.data[3 * fields.point_step + fields.fields[3].offset], 4);
  EXPECT_EQ(t, 0.25f);
}

TEST(ConvertLines, TurnsOnDuringALineOfAContinuousDrive)
{
  const Files files;
  // Half a turn of the mirror a line: the last beam sees the drive halfway on.
  writeText(files / "lines.csv", "0,1,1,1\n20,1,1,1\n");
  const std::vector<std::string> arguments = {files.name("lines.csv"),
                                              "-o",
                                              files.name("out.pcd"),
                                              "--drive",
                                              "rolling",
                                              "--continuous"};
  ASSERT_EQ(convert(arguments).exit_code, 0);
  const double roll = 20 * kDegree * (180.0 / 360);
  EXPECT_NEAR(files.cloud()(2, 0).y, std::cos(roll), 1e-6);
  EXPECT_NEAR(files.cloud()(2, 0).z, std::sin(roll), 1e-6);
}

TEST(ConvertLines, NamesWhatIsWrong)
{
  const Files files;
  const std::string in = files.name("lines.csv");
  const std::string out = files.name("out.pcd");
  writeText(in, "0,1,2\n1,1\n");
  pcl6d::test::expectError(
      convert({in, "-o", out}), kName, 1, {in + ": line 2: 2 cells"});
  writeText(in, "0,1,2\n1,1,abc\n");
  pcl6d::test::expectError(
      convert({in, "-o", out}), kName, 1, {in + ": line 2: column 3: 'abc'"});
  writeText(in, "1e9,1,2\n");
  pcl6d::test::expectError(convert({in, "-o", out}), kName, 1, {"drive angle 0"});
  pcl6d::test::expectError(
      convert({files.name("no.csv"), "-o", out}), kName, 1, {"no.csv"});
  writeText(in, "0,1,2\n");
  const auto expectUsage = [&](const std::vector<std::string>& options,
                               const std::string& part) {
    std::vector<std::string> arguments = {in, "-o", out};
    arguments.insert(arguments.end(), options.begin(), options.end());
    pcl6d::test::expectError(convert(arguments), kName, 2, {part});
  };
  expectUsage({"--drive", "hopping"}, "hopping");
  expectUsage({"--beam-first", "nan"}, "--beam-first");
  expectUsage({"--lever-arm", "1,2"}, "1,2");
  expectUsage({"--mounting", "nan,0,0"}, "nan");
  expectUsage({"--range-unit", "0"}, "--range-unit");
  expectUsage({"--min-range", "5", "--max-range", "2"}, "--max-range");
  pcl6d::test::expectError(convert({in, "-o", in}), kName, 2, {"is an input"});
  pcl6d::test::expectError(convert({in}), kName, 2, {"output"});
  EXPECT_FALSE(std::filesystem::exists(out));
}
