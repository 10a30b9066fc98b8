// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_planes, and the same step of pcl_slam6d, as a user runs them.
#include "apps/support/corridor_run.h"
#include "apps/support/without_late_libraries.h"

#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/plane_io.h>

#include <pcl/common/io.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>

namespace {
namespace fs = std::filesystem;
using pcl6d::Plane;
using pcl6d::test::contentOf;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;
using Words = std::vector<std::string>;

constexpr const char* kName = "pcl_slam6d_planes";

Outcome
planes(const Words& arguments)
{
  return pcl6d::test::runProgram(kName, arguments);
}

void
expectError(const Words& arguments, int code, const Words& words)
{
  pcl6d::test::expectError(planes(arguments), kName, code, words);
}

/** \return the folder with scans of the simulated corridor */
std::string
corridor()
{
  return pcl6d::test::scans().string();
}

/** The largest plane with a label. */
const Plane*
largest(const std::vector<Plane>& found, const std::string& label)
{
  for (const auto& plane : found)
    if (plane.label == label)
      return &plane;
  return nullptr;
}

void
expectFloorAndWalls(const std::vector<Plane>& found)
{
  const Plane* floor = largest(found, "floor");
  ASSERT_NE(floor, nullptr);
  EXPECT_GT(std::abs(floor->normal.z()), std::cos(0.02));
  EXPECT_GT(floor->area, 2);
  const Plane* wall = largest(found, "wall");
  ASSERT_NE(wall, nullptr);
  EXPECT_LT(std::abs(wall->normal.z()), std::sin(0.02));
  for (const auto& plane : found) {
    EXPECT_NEAR(plane.normal.norm(), 1, 1e-12);
    EXPECT_GE(plane.offset, 0);
    for (const auto& corner : plane.hull)
      EXPECT_NEAR(plane.normal.dot(corner), plane.offset, 1e-6);
  }
}

/** The values of a field of 32-bit integers. */
std::vector<std::uint32_t>
numbersOf(const fs::path& file, const std::string& field)
{
  const pcl::PCLPointCloud2 cloud = pcl6d::readPcd(file);
  const int place = pcl::getFieldIndex(cloud, field);
  EXPECT_GE(place, 0) << field;
  std::vector<std::uint32_t> values(std::size_t{cloud.width} * cloud.height);
  for (std::size_t i = 0; i < values.size(); ++i)
    std::memcpy(&values[i],
                &cloud.data[i * cloud.point_step +
                            cloud.fields[static_cast<std::size_t>(place)].offset],
                sizeof values[i]);
  return values;
}
} // namespace

TEST(Planes, OfOneScanAreFoundLabelledAndWritten)
{
  const TempFolder folder;
  const std::string out = folder / "out";
  const auto outcome = planes({corridor() + "/scan000.pcd", "-o", out});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find(" planes in "), std::string::npos) << outcome.out;
  const auto found = pcl6d::readPlanes(out + "/planes.json");
  expectFloorAndWalls(found);
  for (const char* const file :
       {"planes.pcd", "hulls.ply", "labels.json", "planes.png"})
    EXPECT_TRUE(fs::exists(fs::path(out) / file)) << file;
  const auto json = nlohmann::json::parse(readText(out + "/planes.json"));
  EXPECT_EQ(json.at("generator"), kName);
  EXPECT_GT(json.at("seconds").get<double>(), 0);
  std::vector<std::size_t> counts(found.size() + 1);
  for (const auto id : numbersOf(out + "/planes.pcd", "plane_id"))
    ++counts.at(id);
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_EQ(counts[i + 1], found[i].inliers);
}

TEST(Planes, EachMethodFindsThem)
{
  for (const char* const method : {"region-growing",
                                   "ransac",
                                   "hough",
                                   "hough-standard",
                                   "hough-probabilistic",
                                   "hough-randomized",
                                   "hough-adaptive",
                                   "hough-progressive"}) {
    SCOPED_TRACE(method);
    const TempFolder folder;
    const std::string out = folder / "out";
    const auto outcome =
        planes({corridor() + "/scan000.pcd", "-o", out, "--method", method, "--quiet"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out + outcome.err, "");
    expectFloorAndWalls(pcl6d::readPlanes(out + "/planes.json"));
  }
}

TEST(Planes, OfAFolderAreInTheFrameOfItsPosesAndDoNotDependOnThreads)
{
  const TempFolder folder;
  const std::string poses = folder / "poses.txt"; // no program reads groundtruth.txt
  fs::copy_file(corridor() + "/groundtruth.txt", poses);
  std::vector<std::string> texts;
  for (const char* const threads : {"1", "3"}) {
    const std::string out = folder / threads;
    const auto outcome = planes({corridor(),
                                 "--last",
                                 "3",
                                 "--poses",
                                 poses,
                                 "-o",
                                 out,
                                 "--refine",
                                 "--threads",
                                 threads});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    auto json = nlohmann::json::parse(readText(out + "/planes.json"));
    json.erase("seconds");
    texts.push_back(json.dump() + readText(out + "/planes.pcd") +
                    readText(out + "/refined.pcd") + readText(out + "/labels.json") +
                    readText(out + "/refinement.json"));
    expectFloorAndWalls(pcl6d::readPlanes(out + "/planes.json"));
  }
  EXPECT_EQ(texts[0], texts[1]);
}

TEST(Planes, OfARunAreThoseThatItFindsItself)
{
  const TempFolder folder;
  const std::string run = folder / "run", out = folder / "out";
  const auto outcome = pcl6d::test::slam(corridor(), run, {"--last", "3", "--planes"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expectFloorAndWalls(pcl6d::readPlanes(run + "/planes.json"));
  EXPECT_TRUE(fs::exists(run + "/planes.png"));
  const auto again = planes({run, "-o", out});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  expectFloorAndWalls(pcl6d::readPlanes(out + "/planes.json"));
  // A run without --planes replaces all of the one before.
  ASSERT_EQ(pcl6d::test::slam(corridor(), run, {"--last", "3"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(run + "/planes.json"));
  EXPECT_FALSE(fs::exists(run + "/hulls.ply"));
}

TEST(Planes, OfARunNeedALibraryWhoseAbsenceIsToldBeforeTheWork)
{
  if (!pcl6d::test::WithoutLateLibraries::areUsed())
    GTEST_SKIP() << "static libraries";
  const TempFolder folder;
  const std::string run = folder / "run";
  const pcl6d::test::WithoutLateLibraries without;
  pcl6d::test::expectError(
      pcl6d::test::slam(folder / "no scans", run, {"--planes"}),
      "pcl_slam6d",
      1,
      {"--planes: ", "libpcl6d_planes_of_run.so is missing", "builds it"});
  EXPECT_FALSE(fs::exists(run));
  const auto outcome = pcl6d::test::slam(corridor(), run, {"--last", "1"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST(Planes, ExplainsItsLabelsAndTakesRulesOfAUser)
{
  const TempFolder folder;
  const std::string rules = folder / "rules.json", out = folder / "out";
  writeText(rules, R"({"name": "mine", "extends": "book", "labels": [
    {"name": "board", "orientation": "horizontal", "seen_from": "above",
     "area": [0.01, 1.4]}]})");
  const auto outcome =
      planes({corridor() + "/scan000.pcd", "-o", out, "--rules", rules, "--verbose"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("plane 1: "), std::string::npos) << outcome.out;
  const std::string within = out + "/labels.json";
  fs::rename(rules, within);
  expectError({corridor() + "/scan000.pcd", "-o", out, "--rules", within},
              1,
              {within, "inside the output folder"});
  writeText(rules,
            R"({"name": "mine", "labels": [{"name": "board", "wide": [0, 1]}]})");
  expectError({corridor() + "/scan000.pcd", "-o", out, "--rules", rules},
              1,
              {"rules.json", "/labels/0", "wide"});
}

TEST(Planes, TellsWhatIsWrongBeforeItWrites)
{
  const TempFolder folder;
  const std::string out = folder / "out", scan = corridor() + "/scan000.pcd";
  expectError({"-o", out}, 2, {"INPUT"});
  expectError({folder / "none.pcd", "-o", out}, 1, {"none.pcd"});
  expectError({scan, "-o", out, "--method", "magic"}, 2, {"magic", "region-growing"});
  expectError({scan, "-o", out, "--method", "hough-magic"},
              2,
              {"hough-magic", "hough-progressive"});
  expectError({scan, "-o", out, "--min-area", "-1"}, 2, {"--min-area = -1"});
  expectError({scan, "-o", out, "--poses", "x"}, 2, {"--poses", "needs a folder"});
  expectError({scan, "-o", out, "--no-labels", "--refine"}, 2, {"--refine"});
  expectError({scan, "-o", out, "--up", "north"}, 2, {"--up = north", "z or auto"});
  expectError({scan, "-o", out, "--noise", "0"}, 2, {"--noise = 0"});
  expectError({corridor(), "-o", out, "--first", "99"}, 2, {"--first = 99"});
  writeText(folder / "nan.xyz", "nan nan nan\nnan nan nan\n");
  expectError({folder / "nan.xyz", "-o", out}, 1, {"nan.xyz: no point with finite"});
  writeText(folder / "bad.xyz", "1 2 3\n4 x 6\n");
  expectError({folder / "bad.xyz", "-o", out}, 1, {"bad.xyz", "line 2"});
  EXPECT_FALSE(fs::exists(out));
}

TEST(Planes, OfAnOrganizedCloudAreFoundOnItsGridWhateverTheTypeOfItsNumbers)
{
  // A floor 1 m below a camera that looks ahead and down; one ray in ten is lost.
  constexpr int kWidth = 80, kHeight = 60;
  std::string text = "VERSION .7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\n"
                     "WIDTH 80\nHEIGHT 60\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 4800\n"
                     "DATA ascii\n";
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column) {
      const double x = 1 / (0.3 + 0.01 * row), y = x * (0.4 - 0.01 * column);
      text += column % 10 == 3 ? "nan nan nan\n"
                               : std::to_string(x) + ' ' + std::to_string(y) + " -1\n";
    }
  const TempFolder folder;
  const std::string out = folder / "out";
  writeText(folder / "grid.pcd", text);
  const auto outcome = planes({folder / "grid.pcd", "-o", out});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto found = pcl6d::readPlanes(out + "/planes.json");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].offset, 1, 1e-6);
  EXPECT_EQ(found[0].inliers, static_cast<std::size_t>(kWidth * kHeight * 9 / 10));
  EXPECT_EQ(numbersOf(out + "/planes.pcd", "plane_id").size(),
            static_cast<std::size_t>(kWidth * kHeight));
}

TEST(Planes, AreNoneWhereThereIsNoSurface)
{
  const TempFolder folder;
  writeText(folder / "line.xyz", "1 0 0\n2 0 0\n3 0 0\n4 0 0\n5 0 0\n");
  writeText(folder / "two.xyz", "1 0 0\n2 0 0\n");
  for (const char* const file : {"line.xyz", "two.xyz"}) {
    const std::string out = folder / ("out_" + std::string(file));
    const auto outcome = planes({folder / file, "-o", out});
    EXPECT_EQ(outcome.exit_code, 0) << file << ": " << outcome.err;
    EXPECT_NE(outcome.out.find("0 planes"), std::string::npos) << outcome.out;
    EXPECT_TRUE(pcl6d::readPlanes(out + "/planes.json").empty());
  }
}
