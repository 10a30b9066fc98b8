// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d --moving: what moved while scans were taken is labelled, left out or kept.
#include "apps/support/corridor_run.h"
#include "support/walked_room.h"

#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/run/run_folder.h>

#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace {
namespace fs = std::filesystem;
using pcl6d::RunFolder;
using pcl6d::test::Outcome;
using pcl6d::test::slam;
using pcl6d::test::TempFolder;

const pcl6d::test::WalkedRun&
walkedRun()
{
  static const auto run = pcl6d::test::makeWalkedRun();
  return run;
}

/** The scans as files; with a field `dynamic` that says nonsense if asked for. */
void
writeScans(const fs::path& folder, bool is_labelled)
{
  fs::create_directories(folder);
  for (std::size_t i = 0; i < walkedRun().scans.size(); ++i) {
    pcl::PointCloud<pcl::PointXYZ> points;
    for (const auto& p : walkedRun().scans[i])
      points.push_back({p.x(), p.y(), p.z()});
    pcl::PCLPointCloud2 cloud;
    pcl::toPCLPointCloud2(points, cloud);
    if (is_labelled)
      pcl6d::addField(cloud,
                      "dynamic",
                      pcl::PCLPointField::UINT32,
                      std::vector<double>(points.size(), 1));
    pcl6d::writePcd(folder / (pcl6d::scanName(static_cast<int>(i)) + ".pcd"),
                    cloud,
                    walkedRun().odometry[i]);
  }
}

const fs::path&
walkedScans()
{
  static const TempFolder folder;
  static const fs::path path = folder / "scans";
  if (!fs::exists(path))
    writeScans(path, false);
  return path;
}

/** \return how many points of scan 3 lie on the walker, of those that a file still has; they are
 * told by their place */
std::size_t
walkerPointsIn(const pcl6d::Points& points)
{
  std::size_t count = 0;
  const auto& scan = walkedRun().scans[3];
  for (std::size_t p = 0; p < scan.size(); ++p)
    if (walkedRun().walker[3][p] == 2)
      count += std::count(points.begin(), points.end(), scan[p]) > 0 ? 1 : 0;
  return count;
}
} // namespace

TEST(Slam6dMoving, LabelsWhatMovedAndLeavesItOutOfTheMap)
{
  const TempFolder folder;
  const Outcome outcome = slam(walkedScans(), folder / "out", {"--no-picture"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("field dynamic in scans/, not in the map"),
            std::string::npos)
      << outcome.out;
  const RunFolder run(folder / "out");
  ASSERT_TRUE(run.summary().moving);
  EXPECT_FALSE(run.summary().moving->removed);
  const auto scan = pcl6d::readScan(folder / "out/scans/scan003.pcd");
  EXPECT_EQ(scan.points.size(), walkedRun().scans[3].size());
  const auto label = pcl6d::fieldValues(scan.cloud, "dynamic");
  ASSERT_TRUE(label);
  std::size_t body = 0, found = 0, all = 0;
  for (std::size_t p = 0; p < label->values.size(); ++p) {
    const bool is_body = walkedRun().walker[3][p] == 2;
    all += label->values[p] != 0 ? 1 : 0;
    body += is_body ? 1 : 0;
    found += is_body && label->values[p] == 1 ? 1 : 0;
  }
  EXPECT_EQ(run.summary().moving->points[3], all);
  EXPECT_GE(found, body * 97 / 100);
  EXPECT_GT(walkerPointsIn(scan.points), 100U);
  EXPECT_LE(walkerPointsIn(run.readScan(3)), body * 3 / 100);
  EXPECT_FALSE(run.readMoving().points.empty());
  EXPECT_EQ(run.readMoving().points.size(), run.readMoving().scans.size());
}

TEST(Slam6dMoving, RemovesItWhereAskedFor)
{
  const TempFolder folder;
  const Outcome outcome = slam(walkedScans(),
                               folder / "out",
                               {"--no-picture", "--moving", "remove", "--planes"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("left out of scans and map"), std::string::npos)
      << outcome.out;
  const RunFolder run(folder / "out");
  const auto scan = pcl6d::readScan(folder / "out/scans/scan003.pcd");
  EXPECT_FALSE(pcl6d::fieldValues(scan.cloud, "dynamic"));
  EXPECT_EQ(scan.points.size() + run.summary().moving->points[3],
            walkedRun().scans[3].size());
  EXPECT_TRUE(fs::exists(folder / "out/moving.pcd"));
}

TEST(Slam6dMoving, IsNotMeasuredWithTheMap)
{
  const TempFolder folder;
  nlohmann::json measures[2];
  const std::string what[] = {"label", "remove"};
  for (int k = 0; k < 2; ++k) {
    const std::string run = folder / what[k], json = folder / (what[k] + ".json");
    ASSERT_EQ(slam(walkedScans(), run, {"--no-picture", "--moving", what[k]}).exit_code,
              0);
    const Outcome outcome = pcl6d::test::runProgram(
        "pcl_slam6d_evaluate", {"map", run, "-o", json, "--quiet"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    measures[k] = nlohmann::json::parse(pcl6d::test::readText(json));
  }
  for (const char* name : {"agreement", "thickness", "entropy"})
    EXPECT_EQ(measures[0][name], measures[1][name]) << name;
}

TEST(Slam6dMoving, AsksNobodyWhereItIsKept)
{
  const TempFolder folder;
  const Outcome outcome =
      slam(walkedScans(), folder / "out", {"--no-picture", "--moving", "keep"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("moved"), std::string::npos) << outcome.out;
  const RunFolder run(folder / "out");
  EXPECT_FALSE(run.summary().moving);
  EXPECT_FALSE(fs::exists(folder / "out/moving.pcd"));
  EXPECT_FALSE(pcl6d::fieldValues(
      pcl6d::readScan(folder / "out/scans/scan003.pcd").cloud, "dynamic"));
  EXPECT_EQ(run.readScan(3).size(), walkedRun().scans[3].size());
}

TEST(Slam6dMoving, ReplacesAFieldOfThatNameInItsOwnType)
{
  const TempFolder folder;
  writeScans(folder / "in", true);
  const Outcome outcome = slam(folder / "in", folder / "out", {"--no-picture"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto scan = pcl6d::readScan(folder / "out/scans/scan003.pcd");
  const auto label = pcl6d::fieldValues(scan.cloud, "dynamic");
  ASSERT_TRUE(label);
  EXPECT_GT(std::count(label->values.begin(), label->values.end(), 0.0), 0);
  EXPECT_EQ(std::count_if(scan.cloud.fields.begin(),
                          scan.cloud.fields.end(),
                          [](const auto& field) { return field.name == "dynamic"; }),
            1);
}

TEST(Slam6dMoving, GoesOnWithALabelledRun)
{
  const TempFolder folder;
  ASSERT_EQ(
      slam(walkedScans(), folder / "out", {"--no-picture", "--last", "5"}).exit_code,
      0);
  const Outcome outcome =
      slam(walkedScans(),
           folder / "more",
           {"--no-picture", "--continue", (folder / "out").string()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const RunFolder run(folder / "more");
  ASSERT_TRUE(run.summary().moving);
  EXPECT_EQ(run.summary().moving->points.size(), 8U);
  EXPECT_GT(run.summary().moving->points[7], 100U);
}

TEST(Slam6dMoving, RefusesOtherWords)
{
  const TempFolder folder;
  const Outcome outcome = slam(walkedScans(), folder / "out", {"--moving", "away"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("keep|label|remove"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder / "out"));
}
