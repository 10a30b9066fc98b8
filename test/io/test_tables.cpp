// SPDX-License-Identifier: BSD-3-Clause
// Text tables of points: headings, counts, separators, decimal commas, given columns.
#include "io_test.h"

#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/scan_reader.h>

#include <cmath>

using pcl6d::Points;
using pcl6d::readScan;
using pcl6d::ScanReaderOptions;
using pcl6d::test::expectIoFailed;
using pcl6d::test::messageOf;
using pcl6d::test::TempFolder;
using pcl6d::test::valueOf;
using pcl6d::test::writeText;

namespace {

class Tables : public testing::Test {
protected:
  /** \return the cloud of a text with this content */
  pcl6d::ScanCloud
  read(const std::string& content,
       const std::vector<std::string>& columns = {},
       const std::string& name = "scan.csv")
  {
    file_ = folder_ / name;
    pcl6d::test::replaceText(file_, content);
    ScanReaderOptions options;
    options.columns = columns;
    return pcl6d::readScanCloud(file_, options);
  }

  void
  expectRefused(const std::string& content,
                const std::string& message,
                const std::string& name = "scan.csv")
  {
    expectIoFailed(folder_ / name, message, [&] { read(content, {}, name); });
  }

  static std::string
  fieldsOf(const pcl6d::ScanCloud& scan)
  {
    std::string names;
    for (const auto& field : scan.cloud.fields)
      names += field.name + " ";
    return names;
  }

  TempFolder folder_;
  std::filesystem::path file_;
};

std::uint32_t
colourOf(const pcl6d::ScanCloud& scan, std::size_t point)
{
  return valueOf<std::uint32_t>(scan.cloud, point, "rgb");
}
} // namespace

TEST_F(Tables, AHeadingNamesTheColumnsInAnyOrder)
{
  const auto scan = read(
      "Time,Intensity,Z,Y,X,Label\r\n1600000000.25,7,3,2,1,wall\r\n2,8,6,5,4,\r\n");
  EXPECT_EQ(fieldsOf(scan), "x y z intensity time ");
  ASSERT_EQ(scan.cloud.width, 2U);
  EXPECT_EQ(pcl6d::readScan(file_).points, (Points{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(valueOf<float>(scan.cloud, 1, "intensity"), 8);
  EXPECT_EQ(valueOf<double>(scan.cloud, 0, "time"), 1600000000.25);
  EXPECT_EQ(scan.left_out, (std::vector<std::string>{"column 'Label'"}));
}

TEST_F(Tables, WordsOfUsualProgramsAreKnown)
{
  for (const std::string heading : {"//X Y Z Intensity",
                                    "# x y z reflectance",
                                    "x y z i",
                                    "\xEF\xBB\xBFX Y Z \"Intensity\"",
                                    "X[m] Y[m] Z[m] Intensity[1]",
                                    "Points_m_XYZ:0 Points_m_XYZ:1 Points_m_XYZ:2 "
                                    "intensity",
                                    "Easting Northing Elevation Intensity"}) {
    SCOPED_TRACE(heading);
    const auto scan = read(heading + "\n1 2 3 9\n");
    EXPECT_EQ(fieldsOf(scan), "x y z intensity ");
    EXPECT_EQ(valueOf<float>(scan.cloud, 0, "z"), 3);
    EXPECT_EQ(valueOf<float>(scan.cloud, 0, "intensity"), 9);
  }
}

TEST_F(Tables, SeparatorsAreTakenFromTheRows)
{
  for (const std::string row : {"1;2;3;9",
                                "1\t2\t3\t9",
                                "1,2,3,9",
                                "1 2 3 9",
                                " 1 ; 2;3 ;\"9\"",
                                "1, 2, 3, 9"}) {
    SCOPED_TRACE(row);
    for (const std::string heading : {"x;y;z;i", "x,y,z,i", "x\ty\tz\ti"}) {
      const auto scan = read(heading + "\n" + row + "\n" + row);
      ASSERT_EQ(scan.cloud.width, 2U);
      EXPECT_EQ(valueOf<float>(scan.cloud, 1, "y"), 2);
      EXPECT_EQ(valueOf<float>(scan.cloud, 1, "intensity"), 9);
    }
  }
}

TEST_F(Tables, DecimalCommasAreReadBesideSemicolonsAndTabs)
{
  for (const char* const name : {"scan.csv", "scan.xyz"})
    for (const std::string content : {"1,0039;0,0000;-1,1964\n0;1;2\n",
                                      "1,0039\t0,0000\t-1,1964\n0\t1\t2\n",
                                      "X;Y;Z\n1,0039;0,0000;-1,1964\n0;1;2\n",
                                      "1,0039 ; 0,0000 ; -1,1964\n0;1;2"}) {
      SCOPED_TRACE(content);
      read(content, {}, name);
      EXPECT_EQ(readScan(file_).points, (Points{{1.0039f, 0, -1.1964f}, {0, 1, 2}}));
    }
}

TEST_F(Tables, DecimalCommasElsewhereAreNamed)
{
  const std::string rule = " has a decimal comma, but decimal commas need a semicolon "
                           "or a tab between numbers";
  for (const char* const name : {"scan.csv", "scan.xyz", "scan.pts"}) {
    expectRefused("1,0039 0,0000 -1,1964\n", "line 1: '1,0039'" + rule, name);
    expectRefused("1,0039,0,0000,-1,1964\n", "line 1: '1,0039'" + rule, name);
    expectRefused("0 0 0\n0 0,5 0\n", "line 2: '0,5'" + rule, name);
  }
  expectRefused("x y z i\n0 0 0 1\n0 0,5 0 1\n", "line 3: '0,5'" + rule);
}

TEST_F(Tables, ColumnsAreNamedByTheCaller)
{
  const auto scan = read("1,2,3,foo,200\n4,5,6,bar,7\n", {"z", "-", "x", "", "y"});
  EXPECT_EQ(readScan(file_).points, (Points{{1, 2, 3}, {4, 5, 6}})); // without them
  EXPECT_EQ(fieldsOf(scan), "x y z ");
  EXPECT_EQ(valueOf<float>(scan.cloud, 0, "x"), 3);
  EXPECT_EQ(valueOf<float>(scan.cloud, 0, "y"), 200);
  EXPECT_EQ(valueOf<float>(scan.cloud, 0, "z"), 1);
  // They count more than a heading.
  EXPECT_EQ(valueOf<float>(read("x,y,z\n1,2,3\n", {"z", "y", "x"}).cloud, 0, "x"), 3);
}

TEST_F(Tables, ColumnsThatBreakTheirRuleAreNamed)
{
  const auto message = [&](const std::vector<std::string>& columns) {
    return messageOf<pcl6d::BadArgument>([&] { read("1 2 3\n", columns); });
  };
  EXPECT_EQ(message({"x", "y", "q"}),
            "columns: 'q', but must be x, y, z, intensity, r, g, b, nx, ny, nz, ring, "
            "time, or empty");
  EXPECT_EQ(message({"x", "y", "x", "z"}), "columns: 'x' is named twice");
  EXPECT_EQ(message({"x", "y", "", "i"}), "columns: z is missing");
  pcl6d::ScanFolderOptions options;
  options.columns = {"x"};
  EXPECT_THROW(options.validate(), pcl6d::BadArgument);
}

TEST_F(Tables, AFolderReadsTheGivenColumns)
{
  writeText(folder_ / "a.csv", "1,2,3\n");
  pcl6d::ScanFolderOptions options;
  options.columns = {"z", "y", "x"};
  const pcl6d::ScanFolder scans(folder_.path(), options);
  EXPECT_EQ(scans.read(0).points, (Points{{3, 2, 1}}));
}

TEST_F(Tables, EmptyCellsAreNoNumbers)
{
  const auto scan = read("x,y,z,intensity\n1,2,3,\n,5,6,7\n");
  EXPECT_EQ(scan.dropped, 1U);
  ASSERT_EQ(scan.cloud.width, 1U);
  EXPECT_TRUE(std::isnan(valueOf<float>(scan.cloud, 0, "intensity")));
}

TEST_F(Tables, ColoursNormalsAndRingsAreFields)
{
  const auto scan = read("x,y,z,R,G,B,Nx,Ny,Nz,laser_id\n1,2,3,255,128,1,0,0,1,31\n"
                         "1,2,3,300,-4,nan,0,1,0,70000\n");
  EXPECT_EQ(fieldsOf(scan), "x y z rgb normal_x normal_y normal_z ring ");
  EXPECT_EQ(colourOf(scan, 0), 0xff8001U);
  EXPECT_EQ(colourOf(scan, 1), 0xff0000U);
  EXPECT_EQ(valueOf<float>(scan.cloud, 0, "normal_z"), 1);
  EXPECT_EQ(valueOf<std::uint16_t>(scan.cloud, 0, "ring"), 31);
  EXPECT_EQ(valueOf<std::uint16_t>(scan.cloud, 1, "ring"), 65535);
  EXPECT_EQ(scan.left_out, (std::vector<std::string>{"colours above 255 (line 3)"}));
}

TEST_F(Tables, HeadingsWithoutCoordinatesAreNamed)
{
  expectRefused("a,b,c\n1,2,3\n",
                "line 1: 'a,b,c' names no column x; name the columns in their order "
                "(--columns x,y,z)");
  expectRefused("x,y,i\n1,2,3\n",
                "line 1: 'x,y,i' names no column z; name the columns in their order "
                "(--columns x,y,z)");
  expectRefused(
      "x [mm],y [mm],z [mm]\n1,2,3\n",
      "line 1: column 'x [mm]' is in 'mm', but coordinates are read in metres");
  expectRefused("x,y,z,i\n1,2,3,4\n5,6,7\n",
                "line 3: expected at least 4 numbers, got 3");
  expectRefused("x,y,z\n1,2,3\nx,y,z\n", "line 3: 'x' is not a number");
}

TEST_F(Tables, ACountIsCompared)
{
  EXPECT_EQ(read("//X Y Z\n2\n1 2 3\n4 5 6\n").cloud.width, 2U);
  EXPECT_EQ(read("1\n1 2 3\n4 5 6\n").cloud.width, 2U); // more than it says
  expectRefused(
      "3\n1 2 3\n4 5 6\n",
      "ends after 2 points, but line 1 and further lines of counts promise 3");
  EXPECT_EQ(read("0\n").cloud.width, 0U);
  EXPECT_EQ(read("").cloud.width, 0U);
}

TEST_F(Tables, PtsHasIntensityAndColourByItsColumns)
{
  const auto fields = [&](const std::string& row) {
    return fieldsOf(read("1\n" + row + "\n", {}, "scan.pts"));
  };
  EXPECT_EQ(fields("1 2 3"), "x y z ");
  EXPECT_EQ(fields("1 2 3 -1035"), "x y z intensity ");
  EXPECT_EQ(fields("1 2 3 97 59 38"), "x y z rgb ");
  EXPECT_EQ(fields("1 2 3 -1035 97 59 38"), "x y z intensity rgb ");
  const auto scan =
      read("1\n1 2 3 -1035 97 59 38\n1\n4 5 6 12 0 0 255\n", {}, "scan.pts");
  ASSERT_EQ(scan.cloud.width, 2U); // of two blocks
  EXPECT_EQ(valueOf<float>(scan.cloud, 0, "intensity"), -1035);
  EXPECT_EQ(colourOf(scan, 0), 0x613b26U);
  EXPECT_EQ(colourOf(scan, 1), 0x0000ffU);
  expectRefused("1\n1 2 3\n2\n4 5 6\n",
                "ends after 2 points, but line 1 and further lines of counts promise 3",
                "scan.pts");
}

TEST_F(Tables, FarCoordinatesAreReadInDouble)
{
  const auto scan =
      read("x;y;z;i\n500000,125;5400000,25;300,5;1\n500001;5400001;301;2\n");
  EXPECT_EQ(valueOf<double>(scan.cloud, 0, "x"), 500000.125);
  EXPECT_EQ(valueOf<double>(scan.cloud, 0, "y"), 5400000.25);
}

TEST_F(Tables, TextsBesideScansAreNoScans)
{
  for (const char* const name : {"poses.csv", "notes.txt", "scan1.xyz", "scan2.xyz"})
    writeText(folder_ / name, "1 2 3\n");
  EXPECT_EQ(pcl6d::ScanFolder(folder_.path()).size(), 2U);
  pcl6d::ScanFolderOptions options;
  options.format = pcl6d::ScanFormat::kTxt;
  writeText(folder_ / "times.txt", "1\n");
  EXPECT_EQ(pcl6d::ScanFolder(folder_.path(), options).size(), 1U);
  std::filesystem::remove(folder_ / "scan1.xyz");
  std::filesystem::remove(folder_ / "scan2.xyz");
  std::filesystem::remove(folder_ / "times.txt");
  EXPECT_EQ(pcl6d::ScanFolder(folder_.path()).name(0), "poses.csv");
}
