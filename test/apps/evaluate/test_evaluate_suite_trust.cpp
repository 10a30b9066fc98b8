// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_evaluate suite: seeds, damages, and verdicts compared with the truth.
#include "apps/evaluate/suite_test.h"
#include "support/folders.h"

#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/trajectory_io.h>

#include <cmath>
#include <map>
#include <set>

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using pcl6d::readTrajectory;
using pcl6d::test::CsvRow;
using pcl6d::test::Outcome;
using pcl6d::test::readCsv;
using pcl6d::test::readText;
using pcl6d::test::scans;
using pcl6d::test::SuiteTest;

namespace {
constexpr double kRounding = 1e-9; // [m] of 17 digits, products of up to 40 poses

using Poses = std::vector<Eigen::Isometry3d>;

/** Suites whose table compares verdicts with the truth. */
class TrustSuite : public SuiteTest {
protected:
  /** Two scenes of 40 coarse scans, of which runs take the first two. */
  Json
  drives() const
  {
    Json suite;
    suite["schema_version"] = 1;
    suite["table"] = "trust";
    suite["defaults"] = {{"threads", 1}, {"no-picture", true}, {"last", 1}};
    for (const char* scene : {"corridor", "rooms"})
      suite["data"][scene] = {
          {"simulate", {{"scene", scene}, {"scans", 40}, {"resolution", 5}}}};
    suite["methods"]["plain"] = {{"metric", "point"}, {"metascan", 1}};
    return suite;
  }

  fs::path
  dataOf(const std::string& name) const
  {
    return out / "data" / name;
  }

  Poses
  posesIn(const std::string& data, const char* name = "odometry.txt") const
  {
    return readTrajectory(dataOf(data) / name).poses;
  }

  std::map<std::string, CsvRow>
  rowsByRun() const
  {
    std::map<std::string, CsvRow> rows;
    for (const CsvRow& row : readCsv(out / "table.csv"))
      rows[row.at("run")] = row;
    return rows;
  }
};

/** \return what step i is off by */
Eigen::Isometry3d
stepError(const Poses& poses, const Poses& truth, std::size_t i)
{
  return (truth[i - 1].inverse() * truth[i]).inverse() * poses[i - 1].inverse() *
         poses[i];
}

void
expectNear(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b)
{
  EXPECT_LT((a.matrix() - b.matrix()).norm(), kRounding);
}

std::string
targetOf(const fs::path& link)
{
  return fs::read_symlink(link).string();
}
} // namespace

TEST_F(TrustSuite, DamagesPosesAsItSays)
{
  Json suite = drives();
  suite["damages"] = {{"true poses", {{"odometry_noise", 0}}},
                      {"noise", {{"odometry_noise", 3}}},
                      {"feet", {{"odometry_scale", 3.25}}},
                      {"turned", {{"turn", 180}}},
                      {"jump", {{"jump", {5, 10}}}}};
  run(suite, {"--only", "corridor"});
  const Poses before = posesIn("corridor"),
              truth = posesIn("corridor", "groundtruth.txt");
  ASSERT_EQ(before.size(), 40u);
  const Poses exact = posesIn("corridor, true poses"),
              noisy = posesIn("corridor, noise"), feet = posesIn("corridor, feet"),
              turned = posesIn("corridor, turned"), jump = posesIn("corridor, jump");
  for (std::size_t i = 1; i < before.size(); ++i) {
    expectNear(truth[0].inverse() * truth[i], exact[0].inverse() * exact[i]);
    const auto error = stepError(before, truth, i), more = stepError(noisy, truth, i);
    EXPECT_LT((3 * error.translation() - more.translation()).norm(), kRounding);
    EXPECT_NEAR(3 * Eigen::AngleAxisd(error.linear()).angle(),
                Eigen::AngleAxisd(more.linear()).angle(),
                1e-7) // an angle of 1e-3 rad out of a cosine
        << i;
    EXPECT_LT((3.25 * before[i].translation() - feet[i].translation()).norm(),
              kRounding);
    expectNear(before[i] * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ()),
               turned[i]);
  }
  expectNear(before[4], jump[4]);
  expectNear(before[4] * Eigen::Translation3d(10, 0, 0) * before[4].inverse() *
                 before[20],
             jump[20]);
  expectNear(truth[20], posesIn("corridor, jump", "groundtruth.txt")[20]);
}

TEST_F(TrustSuite, DamagesScansAsItSays)
{
  Json suite = drives();
  suite["damages"] = {{"swapped", {{"swap", {3, 9}}}},
                      {"foreign", {{"foreign", 6}}},
                      {"thin", {{"points", 500}}},
                      {"lost", {{"no_poses", true}}},
                      {"linked", {{"links", {{0, 1}}}}}};
  run(suite, {"--only", "corridor"});
  const fs::path swapped = dataOf("corridor, swapped");
  EXPECT_NE(targetOf(swapped / "scan003.pcd").find("corridor/scan009.pcd"),
            std::string::npos);
  EXPECT_NE(targetOf(swapped / "scan009.pcd").find("corridor/scan003.pcd"),
            std::string::npos);
  const Poses truth = posesIn("corridor", "groundtruth.txt"),
              taken = posesIn("corridor, swapped", "groundtruth.txt");
  expectNear(truth[3], taken[9]);
  expectNear(truth[9], taken[3]);
  EXPECT_NE(targetOf(dataOf("corridor, foreign") / "scan006.pcd")
                .find("/data/rooms/scan006.pcd"),
            std::string::npos)
      << "of the next data set";
  const auto thin = pcl6d::readScan(dataOf("corridor, thin") / "scan002.pcd"),
             full = pcl6d::readScan(dataOf("corridor") / "scan002.pcd");
  EXPECT_EQ(thin.points.size(), 500u);
  EXPECT_GT(full.points.size(), 1000u);
  EXPECT_FALSE(fs::exists(dataOf("corridor, lost") / "odometry.txt"));
  const fs::path runs = out / "runs";
  const auto lost =
      Json::parse(readText(runs / "corridor, lost/plain/1/result/summary.json"));
  EXPECT_EQ(lost["pose_source"], "identity");
  EXPECT_EQ(readText(dataOf("corridor, linked.links")), "0 1\n");
  EXPECT_NE(readText(runs / "corridor, linked/plain/1/result/links.csv").find("given"),
            std::string::npos);
}

TEST_F(TrustSuite, RunsEverySeedWithEveryDamageAndRepeatsOnlyWhatHasChanged)
{
  Json suite = drives();
  suite["data"]["corridor"]["seeds"] = {3, 4};
  suite["damages"] = {{"none", Json::object()}, {"jump", {{"jump", {1, 5}}}}};
  const Outcome first = run(suite);
  EXPECT_NE(first.exit_code, 1) << first.err;
  auto rows = rowsByRun();
  EXPECT_EQ(rows.size(), 6u);
  for (const char* name : {"corridor seed 3, none",
                           "corridor seed 3, jump",
                           "corridor seed 4, none",
                           "corridor seed 4, jump",
                           "rooms, none",
                           "rooms, jump"})
    EXPECT_EQ(rows.count("runs/" + std::string(name) + "/plain/1"), 1u) << name;
  EXPECT_EQ(rows["runs/corridor seed 4, jump/plain/1"].at("data"), "corridor");
  EXPECT_EQ(rows["runs/corridor seed 4, jump/plain/1"].at("damage"), "jump");
  EXPECT_NE(readText(dataOf("corridor seed 3") / "odometry.txt"),
            readText(dataOf("corridor seed 4") / "odometry.txt"));
  EXPECT_FALSE(fs::exists(dataOf("corridor seed 3, none"))) << "nothing differs";
  EXPECT_NE(run(suite).err.find("6 of 6 runs are there already"), std::string::npos);
  suite["damages"]["jump"]["jump"] = {1, 6};
  EXPECT_NE(run(suite).err.find("3 of 6 runs are there already"), std::string::npos);
  run(suite, {"--only", "corridor", "jump"});
  EXPECT_EQ(rowsByRun().size(), 2u) << "a data set and a damage";
  run(suite, {"--only", "corridor seed 4"});
  EXPECT_EQ(rowsByRun().size(), 2u) << "a seed with all damages";
}

TEST_F(TrustSuite, WrongMapCalledGoodIsNamedFirst)
{
  Json suite = smallSuite();
  suite["table"] = "trust";
  suite["methods"].erase("pairwise");
  const Outcome right = run(suite);
  EXPECT_EQ(right.exit_code, 0) << right.err;
  CsvRow row = readCsv(out / "table.csv").at(0);
  EXPECT_EQ(row.at("call"), "good");
  EXPECT_EQ(row.at("right"), "1");
  EXPECT_EQ(row.at("scans"), "4");
  auto truth = readTrajectory(scans() / "groundtruth.txt");
  truth.poses[2].translation().y() += 1; // the map is as right as it was, the truth not
  pcl6d::writeTrajectoryKitti(folder / "false.txt", truth);
  suite["data"]["corridor"]["reference"] = (folder / "false.txt").string();
  const Outcome wrong = run(suite);
  EXPECT_EQ(wrong.exit_code, 3);
  row = readCsv(out / "table.csv").at(0);
  EXPECT_EQ(row.at("wrong"), "1");
  EXPECT_NEAR(std::stod(row.at("largest_unnamed_error_m")), 1, 0.05);
  EXPECT_NE(
      readText(out / "table.md")
          .find("### False goods\n- runs/corridor/metascan/1: scan002.pcd off by"),
      std::string::npos);
  EXPECT_FALSE(fs::exists(out / "corridor_paths.png")) << "no charts of 1000 runs";
  suite["data"]["corridor"].erase("reference");
  EXPECT_EQ(run(suite).exit_code, 0);
  const auto json = Json::parse(readText(out / "table.json"));
  EXPECT_EQ(json["all"]["without_truth"], 1);
}

TEST_F(TrustSuite, WhatCannotBeDamagedIsARow)
{
  Json suite = drives();
  suite["damages"] = {{"none", Json::object()},
                      {"swapped", {{"swap", {3, 99}}}},
                      {"jump", {{"jump", {40, 1}}}},
                      {"foreign", {{"foreign", 40}}},
                      {"links", {{"links", {{0, 40}}}}}};
  EXPECT_EQ(run(suite, {"--only", "corridor"}).exit_code, 3);
  auto rows = rowsByRun();
  ASSERT_EQ(rows.size(), 5u);
  for (const char* name : {"swapped", "jump", "foreign", "links"}) {
    const CsvRow row = rows["runs/corridor, " + std::string(name) + "/plain/1"];
    EXPECT_EQ(row.at("call"), "none") << name;
    EXPECT_NE(row.at("message").find("but there are 40"), std::string::npos)
        << row.at("message");
  }
  EXPECT_NE(rows["runs/corridor, none/plain/1"].at("call"), "none");
}

TEST_F(TrustSuite, DamagesRecordingsWithAndWithoutReference)
{
  Json suite = smallSuite();
  suite["table"] = "trust";
  suite["methods"].erase("pairwise");
  suite["damages"] = {{"noise", {{"odometry_noise", 2}}}};
  EXPECT_EQ(run(suite).exit_code, 0);
  EXPECT_EQ(readCsv(out / "table.csv").at(0).at("call"), "good");
  auto truth = readTrajectory(scans() / "groundtruth.txt");
  truth.poses.resize(7);
  pcl6d::writeTrajectoryKitti(folder / "short.txt", truth);
  suite["data"]["corridor"]["reference"] = (folder / "short.txt").string();
  EXPECT_EQ(run(suite).exit_code, 3);
  EXPECT_NE(readCsv(out / "table.csv").at(0).at("message").find("7 poses for 40 scans"),
            std::string::npos);
}

TEST_F(TrustSuite, SmokeSuiteNoticesDamagedScans)
{
  const Outcome outcome = pcl6d::test::runProgram(
      "pcl_slam6d_evaluate",
      {"suite", PCL6D_SOURCE_DIR "/share/suites/trust_smoke.json", "-o", out.string()});
  const auto json = Json::parse(readText(out / "table.json"));
  EXPECT_EQ(outcome.exit_code, json["all"]["false_goods"]["count"] == 0 ? 0 : 3)
      << outcome.err;
  EXPECT_EQ(json["all"]["runs"], 12);
  EXPECT_EQ(json["all"]["failed"], 0);
  for (const auto& row : rowsByRun()) {
    const std::string& damage = row.second.at("damage");
    if (damage == "scans swapped" || damage == "foreign scan") {
      EXPECT_EQ(row.second.at("call"), "doubted") << row.first;
    }
  }
}
