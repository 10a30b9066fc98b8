// SPDX-License-Identifier: BSD-3-Clause
#include "apps/convert/convert_test.h"
#include "apps/support/corridor_run.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace {
using namespace pcl6d::test;
namespace fs = std::filesystem;

bool
holds(const std::string& text, const std::string& words)
{
  return text.find(words) != std::string::npos;
}

TEST(ConvertInfo, TellsOfAFolder)
{
  const std::string out = converted({"info", scans().string()});
  for (const char* words : {"40 scans, ",
                            "fields: x y z",
                            "initial poses: odometry.txt",
                            "coordinates: in the frames of the scanners",
                            "times: none",
                            "scan039.pcd"})
    EXPECT_TRUE(holds(out, words)) << words << '\n' << out;
}

TEST(ConvertInfo, TellsOfASiteAndOfASingleScan)
{
  const TempFolder folder;
  const fs::path site = folder / "site.e57";
  converted({"scans", scans().string(), "-o", site.string(), "--last", "2", "--quiet"});
  const std::string of_site = converted({"info", site.string()});
  EXPECT_TRUE(holds(of_site, "3 scans, ")) << of_site;
  EXPECT_TRUE(holds(of_site, "initial poses: site.e57")) << of_site;
  EXPECT_TRUE(holds(of_site, "\nscan002 ")) << of_site;
  const std::string of_scan = converted({"info", (scans() / "scan001.pcd").string()});
  EXPECT_TRUE(holds(of_scan, "1 scan, ")) << of_scan;
}

TEST(ConvertInfo, TellsTheCoordinateSystemOfAFile)
{
  const TempFolder folder;
  for (const std::string name : {"map.las", "map.laz", "site.e57"}) {
    const fs::path out = folder / name;
    std::vector<std::string> arguments = {
        "scans", scans().string(), "-o", out.string(), "--last", "1", "--quiet"};
    arguments.insert(arguments.end(), {"--epsg", "25832"});
    if (name != "site.e57")
      arguments.emplace_back("--full");
    converted(arguments);
    const std::string told = converted({"info", out.string()});
    EXPECT_TRUE(holds(told, "coordinate system: ETRS89 / UTM zone 32N")) << told;
  }
}

TEST(ConvertInfo, CoordinateSystemsThatDoNotFitAreRefused)
{
  const TempFolder folder;
  const auto refused = [&](const std::string& out, const std::string& code) {
    const Outcome outcome = runProgram("pcl_slam6d_convert",
                                       {"scans",
                                        (scans() / "scan001.pcd").string(),
                                        "-o",
                                        (folder / out).string(),
                                        "--epsg",
                                        code});
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    return outcome.err;
  };
  EXPECT_TRUE(holds(refused("a.ply", "25832"), "--epsg is for las, laz and e57"));
  EXPECT_TRUE(holds(refused("a.las", "4326"), "--epsg = 4326"));
  EXPECT_TRUE(holds(refused("a.las", "9"), "EPSG registry"));
  EXPECT_FALSE(fs::exists(folder / "a.las"));
}

TEST(ConvertInfo, TheCodeOfARunGoesToItsFiles)
{
  const TempFolder folder;
  const Outcome run =
      slam(scans(),
           folder / "run",
           {"--last", "2", "--epsg", "25832", "--no-picture", "--quiet"});
  ASSERT_NE(run.exit_code, 2) << run.err;
  const fs::path map = folder / "map.laz";
  converted(
      {"scans", (folder / "run").string(), "-o", map.string(), "--full", "--quiet"});
  EXPECT_TRUE(holds(converted({"info", map.string()}),
                    "coordinate system: ETRS89 / UTM zone 32N"));
  EXPECT_EQ(slam(scans(), folder / "no", {"--epsg", "4326"}).exit_code, 2);
}

TEST(ConvertInfo, RangesAreThoseOfThePoints)
{
  const TempFolder folder;
  std::ofstream(folder / "a.xyz") << "1 0 0\n0 2 0\n0 0 3\n0 4 0\n-5 0 0\nnan 1 1\n";
  const std::string out = converted({"info", (folder / "a.xyz").string()});
  std::istringstream words(out.substr(out.find("\na.xyz") + 1));
  std::string name;
  double points = 0, dropped = 0, nearest = 0, median = 0, farthest = 0, spacing = 0;
  words >> name >> points >> dropped >> nearest >> median >> farthest >> spacing;
  EXPECT_EQ(points, 5);
  EXPECT_EQ(dropped, 1);
  EXPECT_EQ(nearest, 1);
  EXPECT_EQ(median, 3);
  EXPECT_EQ(farthest, 5);
  EXPECT_NEAR(spacing, 2.2361, 1e-4); // most are sqrt(5) from the nearest other one
}

TEST(ConvertInfo, NamesDamagedScansAndTellsOfTheOthers)
{
  const TempFolder folder;
  for (const char* name : {"scan000.pcd", "scan001.pcd", "scan002.pcd"})
    fs::copy_file(scans() / name, folder / name);
  fs::resize_file(folder / "scan001.pcd", 3000);
  const Outcome outcome = convert({"info", (folder / "").string()});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_TRUE(holds(outcome.out, "3 scans, "));
  EXPECT_TRUE(holds(outcome.out, "damaged: ")) << outcome.out;
  EXPECT_TRUE(holds(outcome.out, "scan001.pcd: "));
  EXPECT_TRUE(holds(outcome.out, "\nscan002.pcd "));
  expectConvertError({"info", (folder / "none").string()}, 1, {"none"});
}
} // namespace
