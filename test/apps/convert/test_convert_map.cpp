// SPDX-License-Identifier: BSD-3-Clause
// A run as a map for planners: pcl_slam6d_convert map.
#include "apps/convert/convert_test.h"
#include "apps/support/corridor_run.h"
#include "support/shared_run.h"

#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/sources/bag.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <regex>

namespace {
using namespace pcl6d::test;
namespace fs = std::filesystem;

/** A run over six scans of the corridor, made once, only to be read. */
const fs::path&
corridorRun()
{
  static const fs::path path = sharedOutput(
      "pcl_slam6d", {scans().string(), "--last", "5", "--no-picture", "--quiet"});
  return path;
}

/** \brief Maps of the run, in a folder of their own. */
class ConvertMap : public testing::Test {
protected:
  std::string
  made(const std::string& file, std::vector<std::string> options = {})
  {
    options.insert(options.begin(),
                   {"map", corridorRun().string(), "-o", (folder_ / file).string()});
    return converted(options);
  }

  void
  expectRefused(const std::string& file,
                const std::vector<std::string>& options,
                int code,
                const std::vector<std::string>& words,
                const fs::path& run = corridorRun())
  {
    const auto before = contentOf(folder_.path());
    std::vector<std::string> arguments = {
        "map", run.string(), "-o", (folder_ / file).string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expectConvertError(arguments, code, words);
    EXPECT_EQ(contentOf(folder_.path()), before);
  }

  /** \return a copy of the run whose summary has another text in place of a pattern */
  fs::path
  changedRun(const std::string& pattern, const std::string& text)
  {
    fs::path copy = runs_ / ("run" + std::to_string(++copies_));
    fs::copy(corridorRun(), copy, fs::copy_options::recursive);
    const std::string before = readText(copy / "summary.json");
    const std::string after = std::regex_replace(before, std::regex(pattern), text);
    EXPECT_NE(before, after) << pattern;
    writeText(copy / "summary.json", after);
    return copy;
  }

  TempFolder folder_, runs_;
  int copies_ = 0;
};

/** \return whether a command exits with 0; its output goes to a file in the folder */
bool
succeedsIn(const fs::path& folder, const std::string& command)
{
  return std::system(
             ("cd '" + folder.string() + "' && " + command + " > said 2>&1").c_str()) ==
         0;
}

/** \return the number of times a word is in a text */
std::size_t
timesOf(const std::string& text, const std::string& word)
{
  std::size_t times = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    ++times;
  return times;
}

TEST_F(ConvertMap, AnOctreeIsReadByTheToolsOfOctomap)
{
  const std::string said = made("map.bt", {"--resolution", "0.1"});
  EXPECT_EQ(said.find("6 scans: octree of "), 0u) << said;
  EXPECT_NE(said.find("resolution = 0.1 m (given)"), std::string::npos) << said;
  made("map.ot", {"--resolution", "0.1"});
  if (std::system("command -v bt2vrml convert_octree > /dev/null") != 0)
    GTEST_SKIP() << "no bt2vrml: apt-get install octomap-tools";
  ASSERT_TRUE(succeedsIn(folder_.path(), "bt2vrml map.bt"));
  EXPECT_GT(timesOf(readText(folder_ / "map.bt.wrl"), "translation"), 1000u);
  ASSERT_TRUE(succeedsIn(folder_.path(), "convert_octree map.ot again.bt"));
  EXPECT_EQ(readText(folder_ / "again.bt"), readText(folder_ / "map.bt"));
}

TEST_F(ConvertMap, TheImageOfAGridMapHasTheCellsThatAreCounted)
{
  const std::string said = made("map.yaml");
  const std::regex counts("6 scans: grid map of (\\d+) x (\\d+) cells: (\\d+) free, "
                          "(\\d+) occupied, (\\d+) "
                          "unknown");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(said, found, counts)) << said;
  EXPECT_NE(said.find("heights = 0.2 to 2 m above the floor (auto)"),
            std::string::npos);
  const std::string image = readText(folder_ / "map.pgm");
  const std::string head = "P5\n" + found.str(1) + " " + found.str(2) + "\n255\n";
  ASSERT_EQ(image.substr(0, head.size()), head);
  const auto shades = [&](int shade) {
    return std::to_string(std::count(image.begin() + static_cast<long>(head.size()),
                                     image.end(),
                                     static_cast<char>(shade)));
  };
  EXPECT_EQ(shades(254), found.str(3));
  EXPECT_EQ(shades(0), found.str(4));
  EXPECT_EQ(shades(205), found.str(5));
  EXPECT_GT(std::stoi(found.str(3)), 1000); // the corridor is 2 m wide
  EXPECT_GT(std::stoi(found.str(4)), 100);
  EXPECT_NE(readText(folder_ / "map.yaml").find("image: \"map.pgm\"\n"),
            std::string::npos);
}

TEST_F(ConvertMap, NothingIsFreeAboveTheCeiling)
{
  const Outcome outcome = convert({"map",
                                   corridorRun().string(),
                                   "-o",
                                   (folder_ / "map.yaml").string(),
                                   "--heights",
                                   "50,60"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("every cell is unknown"), std::string::npos)
      << outcome.err;
}

TEST_F(ConvertMap, HeightsAreAGeoTiff)
{
  const Outcome outcome =
      convert({"map", corridorRun().string(), "-o", (folder_ / "dem.tif").string()});
  if (outcome.exit_code == 1 && outcome.err.find("needs GDAL") != std::string::npos)
    GTEST_SKIP() << "built without GDAL: apt-get install libgdal-dev";
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  if (std::system("command -v gdalinfo > /dev/null") != 0)
    GTEST_SKIP() << "no gdalinfo: apt-get install gdal-bin";
  std::smatch size;
  ASSERT_TRUE(std::regex_search(
      outcome.out, size, std::regex("heights in (\\d+) x (\\d+) cells")))
      << outcome.out;
  ASSERT_TRUE(succeedsIn(folder_.path(), "gdalinfo dem.tif"));
  const std::string info = readText(folder_ / "said");
  EXPECT_NE(info.find("Size is " + size.str(1) + ", " + size.str(2)),
            std::string::npos);
  EXPECT_EQ(timesOf(info, "Type=Float32"), 3u) << info;
  const fs::path placed = changedRun("\"epsg\": *\\{\\s*\"value\": \"0\"",
                                     "\"epsg\": {\"value\": \"25832\"");
  const std::string said =
      converted({"map", placed.string(), "-o", (folder_ / "utm.tif").string()});
  EXPECT_NE(said.find("ETRS89 / UTM zone 32N"), std::string::npos) << said;
  ASSERT_TRUE(succeedsIn(folder_.path(), "gdalinfo utm.tif"));
  EXPECT_NE(readText(folder_ / "said").find("ID[\"EPSG\",25832]]"), std::string::npos);
}

TEST_F(ConvertMap, TheTrajectoryIsARecording)
{
  const std::string said = made("drive.mcap");
  EXPECT_NE(said.find("6 poses on /odom and /tf"), std::string::npos) << said;
  const auto bag = pcl6d::openBag(folder_ / "drive.mcap");
  const auto poses = pcl6d::readTrajectory(corridorRun() / "trajectory.tum");
  ASSERT_EQ(bag->messages().size(), 12u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(bag->messages()[2 * i].time, std::llround(poses.stamps[i] * 1e9));
    const auto bytes = bag->read(bag->messages()[2 * i]);
    // Behind the CDR header: time 8, "map" 4 + 4, "sensor" 4 + 7, padding 5.
    Eigen::Vector3d position;
    std::memcpy(position.data(), &bytes.at(4 + 32), sizeof position);
    EXPECT_LT((position - poses.poses[i].translation()).norm(), 1e-9) << i;
  }
  const std::string info = converted({"info", (folder_ / "drive.mcap").string()});
  EXPECT_NE(info.find("6  nav_msgs/Odometry"), std::string::npos) << info;
  EXPECT_NE(info.find("6  tf2_msgs/TFMessage"), std::string::npos) << info;
}

TEST_F(ConvertMap, FilesThatExistStayWithoutForce)
{
  writeText(folder_ / "map.pgm", "mine");
  writeText(folder_ / "map.bt", "mine");
  expectRefused("map.bt", {}, 1, {"map.bt: exists; --force overwrites the file"});
  expectRefused("map.yaml", {}, 1, {"map.pgm: exists; --force overwrites the file"});
  made("map.yaml", {"--force"});
  EXPECT_NE(readText(folder_ / "map.pgm"), "mine");
}

TEST_F(ConvertMap, WrongCommandLinesAreErrorsOfOneLine)
{
  for (const std::string file : {"map", "map.png", "map.octree"})
    expectRefused(file, {}, 2, {"extension", ".bt or .ot", ".yaml", ".tif", ".mcap"});
  for (const std::string edge : {"0", "-0.1", "nan", "1e9", "fine"})
    expectRefused("map.bt", {"--resolution", edge}, 2, {"resolution"});
  for (const std::string heights : {"2,1", "1,1", "1", "a,b", "0,inf", ","})
    expectRefused("map.yaml", {"--heights=" + heights}, 2, {"heights"});
  expectRefused("map.bt", {"--max-range", "0"}, 2, {"max-range"});
  expectRefused("none/map.bt", {}, 1, {"none"});
}

TEST_F(ConvertMap, FineCellsThatDoNotFitAreRefusedWithTheEdgeThatDoes)
{
  for (const std::string file : {"map.bt", "map.yaml", "map.tif"})
    expectRefused(file,
                  {"--resolution", "1e-7"},
                  2,
                  {"--resolution = 1e-07, but must be at least"});
  expectRefused("map.bt",
                {"--resolution", "0.02", "--memory", "20M"},
                1,
                {"takes more than the 15 MB allowed", "--resolution", "--memory"});
  const std::string said = made("map.bt", {"--memory", "1M"});
  EXPECT_EQ(said.find("6 scans: octree of "), 0u) << said; // of larger voxels
}

TEST_F(ConvertMap, RunsThatAreNoneUnfinishedOrEmptyAreErrors)
{
  expectRefused("map.bt", {}, 1, {"nowhere"}, folder_ / "nowhere");
  expectRefused("map.bt", {}, 1, {"summary.json"}, scans());
  expectRefused("map.bt",
                {},
                1,
                {"the run was interrupted; start the run again"},
                changedRun("\"complete\": true", "\"complete\": false"));
  const fs::path empty = changedRun("\"max-range\": *\\{\\s*\"value\": \"[^\"]*\"",
                                    "\"max-range\": {\"value\": \"1e-3\"");
  for (const std::string file : {"map.bt", "map.yaml", "map.tif"})
    expectRefused(file, {}, 1, {"the map is empty"}, empty);
}

TEST_F(ConvertMap, UnregisteredScansAreLeftOutAndCounted)
{
  const fs::path run =
      changedRun("\"state\": \"(matched|unconverged)\"", "\"state\": \"predicted\"");
  const Outcome outcome =
      convert({"map", run.string(), "-o", (folder_ / "map.tif").string()});
  if (outcome.exit_code == 1 && outcome.err.find("needs GDAL") != std::string::npos)
    GTEST_SKIP() << "built without GDAL: apt-get install libgdal-dev";
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("5 scans left out: not registered"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(outcome.out.find("1 scan: heights in "), 0u) << outcome.out;
}
} // namespace
