// SPDX-License-Identifier: BSD-3-Clause
#include "io_test.h"
#include "support/constants.h"

#include <pcl6d/io/range_lines_io.h>

#include <cmath>

using pcl6d::RangeLines;
using pcl6d::readRangeLines;
using pcl6d::test::expectIoFailed;
using pcl6d::test::kDegree;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

namespace {

struct Csv : TempFolder {
  RangeLines
  read(const std::string& lines, double unit = 1) const
  {
    writeText(file, lines);
    return readRangeLines(file, {}, unit);
  }
  RangeLines
  read(const std::string& lines, const std::string& drive) const
  {
    writeText(file, lines);
    writeText(angles, drive);
    return readRangeLines(file, angles);
  }
  void
  refuse(const std::string& lines, const std::string& message) const
  {
    expectIoFailed(file, message, [&] { read(lines); });
  }
  const std::filesystem::path file = *this / "l\u00e4ngs und quer.csv";
  const std::filesystem::path angles = *this / "angles.csv";
};
} // namespace

TEST(RangeLines, AreAnAngleInDegreesAndRanges)
{
  const RangeLines lines = Csv().read("-30,1,2.5\n# half way\n\n45,3,4e0\r\n");
  EXPECT_EQ(lines.angles, (std::vector<double>{-30 * kDegree, 45 * kDegree}));
  EXPECT_EQ(lines.samples_per_line, 2u);
  EXPECT_EQ(lines.ranges, (std::vector<double>{1, 2.5, 3, 4}));
  EXPECT_TRUE(lines.times.empty());
}

TEST(RangeLines, TakeUsualSeparators)
{
  for (const char* text :
       {"10,1,2\n", "10;1;2\n", "10 1 2\n", "10\t1\t 2", " 10 , 1 ,2"}) {
    const RangeLines lines = Csv().read(text);
    EXPECT_EQ(lines.ranges, (std::vector<double>{1, 2})) << text;
    EXPECT_EQ(lines.angles, std::vector<double>{10 * kDegree}) << text;
  }
}

TEST(RangeLines, NamesOfColumnsTellOfTimes)
{
  const Csv csv;
  const RangeLines timed = csv.read(
      "\xef\xbb\xbf# a comment\nAngle [deg],time,r0,r1\n1,10.5,3,4\n2,10.6,5,6\n");
  EXPECT_EQ(timed.times, (std::vector<double>{10.5, 10.6}));
  EXPECT_EQ(timed.ranges, (std::vector<double>{3, 4, 5, 6}));
  const RangeLines untimed = csv.read("angle,range,range\n1,3,4\n");
  EXPECT_TRUE(untimed.times.empty());
  EXPECT_EQ(untimed.ranges, (std::vector<double>{3, 4}));
}

TEST(RangeLines, AnglesMayComeFromAnotherFile)
{
  const Csv csv;
  const RangeLines lines =
      csv.read("range,range\n1,2\n3,4\n", "angle,time\n-5,1\n5,2\n");
  EXPECT_EQ(lines.angles, (std::vector<double>{-5 * kDegree, 5 * kDegree}));
  EXPECT_EQ(lines.times, (std::vector<double>{1, 2}));
  EXPECT_EQ(lines.ranges, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_TRUE(csv.read("1\n3\n", std::string("-5\n5\n")).times.empty());
}

TEST(RangeLines, MissingReturnsAreNaN)
{
  const RangeLines lines = Csv().read("0,1,,0,nan,inf,-0.0,2,\n");
  ASSERT_EQ(lines.samples_per_line, 8u);
  EXPECT_EQ(lines.ranges[0], 1);
  EXPECT_EQ(lines.ranges[6], 2);
  for (const std::size_t i : {1u, 2u, 3u, 4u, 5u, 7u})
    EXPECT_TRUE(std::isnan(lines.ranges[i])) << i;
}

TEST(RangeLines, HaveTheirUnit)
{
  EXPECT_DOUBLE_EQ(Csv().read("0,1500\n", 1e-3).ranges[0], 1.5);
  for (const double unit : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_THROW(Csv().read("0,1500\n", unit), pcl6d::BadArgument);
}

TEST(RangeLines, BrokenRowsAreNamed)
{
  const Csv csv;
  csv.refuse("0,1,2\n1,3\n", "line 2: 2 cells, but the first row has 3");
  csv.refuse("0,1,2\n\n1,x,3\n", "line 3: column 2: 'x' is not a number");
  csv.refuse("0,1,2\n1,1,-2\n", "line 2: column 3: the range is -2, but must be >= 0");
  csv.refuse("0,1\nnan,1\n", "line 2: the angle is nan, but must be finite");
  csv.refuse("0,1\n,1\n", "line 2: column 1: '' is not a number");
  csv.refuse("angle,time,r\n0,1,2\n0,1,2\n",
             "line 3: the time 1 does not follow the time of the row before; times "
             "must increase");
  csv.refuse("angle,time,r\n0,inf,2\n", "line 2: the time is inf, but must be finite");
  csv.refuse(
      "time,angle,r\n0,1,2\n",
      "line 1: the first column is 'time', but must be a number or the name angle");
  csv.refuse("0\n1\n", "line 1: there is no range");
  csv.refuse("# nothing\n", "holds no line");
  csv.refuse("", "holds no line");
}

TEST(RangeLines, AnglesOfAnotherNumberAreRefused)
{
  const Csv csv;
  const auto refuse = [&](const std::string& drive, const std::string& message) {
    expectIoFailed(csv.angles, message, [&] { csv.read("1,2\n3,4\n", drive); });
  };
  refuse("1\n", "1 angle, but " + csv.file.string() + " has 2 lines");
  refuse("1,2,3\n", "line 1: 3 cells, but must be an angle and at most a time");
  refuse("1\nx\n", "line 2: column 1: 'x' is not a number");
  expectIoFailed(
      csv.file,
      "line 1: the first column is 'angle', but must be a number or the name range",
      [&] { csv.read("angle,range\n1,2\n", std::string("1\n")); });
}
