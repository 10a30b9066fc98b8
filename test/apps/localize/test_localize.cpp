// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_localize: further scans of a simulated site in the map of a run, tracked and searched,
// elsewhere, broken, and what is no run.
#include "apps/support/corridor_run.h"
#include "support/temp_folder.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/trajectory_io.h>

#include <nlohmann/json.hpp>

#include <fstream>
#include <string>
#include <vector>

namespace {
namespace fs = std::filesystem;
using pcl6d::distanceBetween;
using pcl6d::readTrajectory;
using pcl6d::Trajectory;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::runProgram;
using pcl6d::test::sharedOutput;
using pcl6d::test::TempFolder;

const fs::path&
site()
{
  static const fs::path path = sharedOutput(
      "pcl_slam6d_simulate",
      {"rooms", "--scanner", "ouster", "--scans", "24", "--seed", "3", "--quiet"});
  return path;
}

/** \return a run of each second scan */
const fs::path&
mapOfSite()
{
  static const fs::path path = sharedOutput(
      "pcl_slam6d", {site().string(), "--every", "2", "--no-picture", "--quiet"});
  return path;
}

Outcome
localize(const fs::path& scans, const fs::path& out, std::vector<std::string> more = {})
{
  std::vector<std::string> arguments = {
      mapOfSite().string(), scans.string(), "-o", out.string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return runProgram("pcl_slam6d_localize", arguments);
}

nlohmann::json
resultOf(const fs::path& out)
{
  return nlohmann::json::parse(readText(out / "localization.json"));
}
} // namespace

TEST(Localize, ScansThatTheMapLacksAreFoundAndTracked)
{
  const TempFolder folder;
  const fs::path out = folder / "out";
  const std::string before = readText(mapOfSite() / "summary.json");
  const Outcome outcome = localize(site(), out, {"--first", "1", "--every", "2"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("12 of 12 scans placed in the map"), std::string::npos)
      << outcome.out;
  const Trajectory found = readTrajectory(out / "trajectory.tum");
  const auto truth = readTrajectory(site() / "groundtruth.txt").poses;
  ASSERT_EQ(found.poses.size(), 12u);
  for (std::size_t k = 0; k < found.poses.size(); ++k) {
    const auto index = static_cast<std::size_t>(found.stamps[k]);
    EXPECT_EQ(index, 2 * k + 1);
    const auto off = distanceBetween(
        truth[0].inverse() * truth[index],
        readTrajectory(mapOfSite() / "trajectory.kitti").poses[0].inverse() *
            found.poses[k]);
    EXPECT_LT(off.translation, 0.05) << index; // half a voxel
    EXPECT_LT(off.rotation, 0.01) << index;
  }
  const auto result = resultOf(out);
  EXPECT_FALSE(result["scans"][0]["tracked"]);
  EXPECT_TRUE(result["scans"][1]["tracked"]) << result["scans"][1];
  EXPECT_EQ(readText(mapOfSite() / "summary.json"), before);
}

TEST(Localize, AScanOfTheMapIsFoundByTheOthers)
{
  const TempFolder folder;
  const Outcome outcome = localize(site() / "scan004.pcd", folder / "out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  const auto pose = readTrajectory(folder / "out" / "trajectory.tum").poses.at(0);
  EXPECT_LT(
      distanceBetween(readTrajectory(mapOfSite() / "trajectory.kitti").poses[2], pose)
          .translation,
      0.05);
}

TEST(Localize, AScanOfAnotherPlaceHasNoPoseAndTheOthersGoOn)
{
  const TempFolder folder;
  const fs::path scans = folder / "scans";
  fs::create_directories(scans);
  fs::copy(site() / "scan001.pcd", scans / "a.pcd");
  fs::copy(pcl6d::test::scans() / "scan000.pcd", scans / "b.pcd");
  std::ofstream(scans / "c.pcd")
      << "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\n"
         "HEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n1 2 3\n4 5 6\n";
  fs::copy(site() / "scan003.pcd", scans / "d.pcd");
  const Outcome outcome = localize(scans, folder / "out");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.out << outcome.err;
  const auto result = resultOf(folder / "out");
  EXPECT_EQ(result["schema_version"], 2);
  EXPECT_EQ(result["totals"]["with_pose"], 2);
  EXPECT_NE(result["scans"][1]["answer"], "unique");
  EXPECT_TRUE(result["scans"][1]["T_world_scan"].is_null());
  EXPECT_FALSE(result["scans"][2]["reason"].get<std::string>().empty());
  EXPECT_EQ(result["scans"][3]["answer"], "unique");
  EXPECT_EQ(readTrajectory(folder / "out" / "trajectory.tum").stamps,
            (std::vector<double>{0, 3}));
}

TEST(Localize, WhatIsNoRunIsNamed)
{
  const TempFolder folder;
  const Outcome no_run = runProgram(
      "pcl_slam6d_localize", {site().string(), site().string(), "-o", folder / "out"});
  EXPECT_EQ(no_run.exit_code, 1);
  EXPECT_NE(no_run.err.find("holds no run of pcl_slam6d"), std::string::npos)
      << no_run.err;
  EXPECT_FALSE(fs::exists(folder / "out"));
  const Outcome no_scans =
      runProgram("pcl_slam6d_localize", {mapOfSite().string(), "-o", folder / "out"});
  EXPECT_EQ(no_scans.exit_code, 2);
  const Outcome into_run = localize(site(), mapOfSite());
  EXPECT_EQ(into_run.exit_code, 1) << "the run is an input";
  EXPECT_EQ(localize(site(), folder / "out", {"--every", "0"}).exit_code, 2);
  EXPECT_EQ(localize(folder / "none", folder / "out").exit_code, 1);
}
