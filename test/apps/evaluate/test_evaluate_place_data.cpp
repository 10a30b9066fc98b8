// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_evaluate place on recorded scans: those that a run lacks are found in its map, and
// no others.
#include "support/data_folder.h"
#include "support/run_program.h"
#include "support/shared_run.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/trajectory_io.h>

#include <nlohmann/json.hpp>

#include <set>
#include <string>

namespace {
namespace fs = std::filesystem;
using Json = nlohmann::json;
using pcl6d::distanceBetween;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::runProgram;
using pcl6d::test::TempFolder;

std::string
scanName(std::size_t i)
{
  return "scan0" + std::string(i < 10 ? "0" : "") + std::to_string(i) + ".pcd";
}

/** A run of each third scan, made once for all tests. */
std::string
runOfEachThird(const fs::path& data)
{
  return pcl6d::test::sharedOutput(
      "pcl_slam6d", {data.string(), "--every", "3", "--no-picture", "--quiet"});
}
} // namespace

TEST(PlaceData, ScansThatARunLacksAreFoundInItsMap)
{
  PCL6D_DATA_OR_SKIP(data, "hku1");
  const TempFolder folder;
  const std::string run = runOfEachThird(data), out = folder / "out.json";
  const auto reference = pcl6d::readTrajectory(data / "groundtruth.txt").poses;
  for (std::size_t i = 1; i < 62; i += 6) {
    SCOPED_TRACE(scanName(i));
    const Outcome outcome =
        runProgram("pcl_slam6d_evaluate",
                   {"place", (data / scanName(i)).string(), run, "-o", out, "--quiet"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    const Json found = Json::parse(readText(out));
    Eigen::Isometry3d pose;
    for (int k = 0; k < 16; ++k)
      pose.matrix()(k / 4, k % 4) =
          found["candidates"][0]["T_world_scan"][static_cast<std::size_t>(k)];
    // The run is within 6 cm of the reference, and a place within half a voxel of the run.
    const auto off = distanceBetween(reference.at(i), pose);
    EXPECT_LT(off.translation, 0.13) << off.translation;
    EXPECT_LT(off.rotation, 0.02) << off.rotation;
    EXPECT_LT(off.translation, 2 * found["bound"].get<double>() + 0.06);
  }
}

TEST(PlaceData, ScansOfElsewhereAreNotFound)
{
  PCL6D_DATA_OR_SKIP(data, "hku1");
  const std::string run = runOfEachThird(data);
  std::size_t asked = 0;
  for (const char* const other : {"street", "kurt3d", "rooms"}) {
    std::size_t seen = 0;
    const fs::path scans = pcl6d::test::dataFolder(other);
    if (scans.empty())
      continue;
    std::set<fs::path> files; // in the order of their names on any file system
    for (const auto& entry : fs::directory_iterator(scans))
      files.insert(entry.path());
    for (const fs::path& file : files) {
      if ((file.extension() != ".pcd" && file.extension() != ".3d") || seen++ % 8 != 0)
        continue; // each eighth is enough
      const Outcome outcome =
          runProgram("pcl_slam6d_evaluate", {"place", file.string(), run, "--quiet"});
      EXPECT_EQ(outcome.exit_code, 3) << file << ": " << outcome.out;
      ++asked;
    }
  }
  if (asked == 0)
    GTEST_SKIP() << "no other recorded data";
}

TEST(PlaceData, SparseScansOneAfterTheOtherAreNeverUpsideDown)
{
  PCL6D_DATA_OR_SKIP(data, "cases");
  const TempFolder folder;
  const std::string out = folder / "out.json";
  const fs::path scans = data / "SQ3_12x120x40"; // 4800 points each, 15 cm apart
  const auto truth = pcl6d::readTrajectory(scans / "groundtruth.txt").poses;
  for (std::size_t i = 0; i + 1 < truth.size(); ++i) {
    SCOPED_TRACE(scanName(i));
    const Outcome outcome = runProgram("pcl_slam6d_evaluate",
                                       {"place",
                                        (scans / scanName(i)).string(),
                                        (scans / scanName(i + 1)).string(),
                                        "-o",
                                        out,
                                        "--quiet"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    const Json best = Json::parse(readText(out))["candidates"][0];
    Eigen::Isometry3d pose;
    for (int k = 0; k < 16; ++k)
      pose.matrix()(k / 4, k % 4) = best["T_a_b"][static_cast<std::size_t>(k)];
    const auto off = distanceBetween(truth[i].inverse() * truth[i + 1], pose);
    EXPECT_LT(off.translation, 0.1); // a third of a voxel of 0.3 m
    EXPECT_LT(off.rotation, 0.02);
  }
}
