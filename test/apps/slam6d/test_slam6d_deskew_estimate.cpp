// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d --deskew estimate: scans on the move without odometry of the motion.
#include "apps/support/bad_input.h"
#include "apps/support/corridor_run.h"
#include "support/moving_room.h"

#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/trajectory_io.h>

#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <nlohmann/json.hpp>

namespace {
namespace fs = std::filesystem;
using pcl6d::test::contentOf;
using pcl6d::test::MovingScanner;
using pcl6d::test::Outcome;
using pcl6d::test::slam;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

constexpr double kTurn = 0.1;       // [s] of a scan
constexpr double kTolerance = 0.02; // [m]
constexpr int kSweeps = 8;

struct EstimatedMotion : pcl6d::test::BadInput {
  MovingScanner scanner;
  pcl6d::Random random{31};
  std::vector<pcl6d::TimedPoints> sweeps;

  void
  SetUp() override
  {
    fs::create_directory(in);
    scanner.step = 0.05;
    makeSweeps();
  }

  void
  makeSweeps()
  {
    sweeps.clear();
    for (int i = 0; i < kSweeps; ++i) {
      sweeps.push_back(scanner.sweep(i * kTurn, random));
      for (double& time : sweeps.back().times)
        time -= i * kTurn;
      write(i, 1, pcl::PCLPointField::FLOAT32);
    }
  }

  fs::path
  file(int i) const
  {
    return in / ("scan00" + std::to_string(i) + ".pcd");
  }

  // \param[in] unit of a second in the field t
  void
  write(int i, double unit, std::uint8_t type, const std::string& name = "t")
  {
    const auto& [points, times] = sweeps[static_cast<std::size_t>(i)];
    pcl::PointCloud<pcl::PointXYZ> cloud;
    for (const auto& p : points)
      cloud.emplace_back(p.x(), p.y(), p.z());
    pcl::PCLPointCloud2 blob;
    pcl::toPCLPointCloud2(cloud, blob);
    std::vector<double> values;
    for (const double time : times)
      values.push_back(unit * time);
    pcl6d::addField(blob, name, type, values);
    pcl6d::writePcd(file(i), blob);
  }

  Outcome
  run(std::vector<std::string> more = {})
  {
    more.insert(more.begin(), {"--deskew", "estimate", "--no-picture"});
    return slam(in, out, more);
  }

  nlohmann::json
  summary() const
  {
    return nlohmann::json::parse(pcl6d::test::readText(out / "summary.json"));
  }

  // The share of the points of the run that are where they were measured.
  double
  shareInPlace() const
  {
    const auto poses = pcl6d::readTrajectory(out / "trajectory.kitti").poses;
    const Eigen::Isometry3d T_truth_run = scanner.poseAt(0) * poses[0].inverse();
    std::size_t all = 0, near = 0;
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
      const auto scan =
          pcl6d::readScan(out / "scans" / ("scan00" + std::to_string(i) + ".pcd"));
      for (std::size_t k = 0; k < scan.points.size(); k += 10, ++all) {
        const Eigen::Vector3d truth =
            scanner.poseAt(static_cast<double>(i) * kTurn + sweeps[i].times[k]) *
            sweeps[i].points[k].cast<double>();
        const Eigen::Vector3d found =
            T_truth_run * (poses[i] * scan.points[k].cast<double>());
        near += (found - truth).norm() < kTolerance;
      }
    }
    return static_cast<double>(near) / static_cast<double>(all);
  }

  void
  expectEstimateRefused(const std::vector<std::string>& words,
                        std::vector<std::string> more = {})
  {
    pcl6d::test::expectError(run(std::move(more)), pcl6d::test::kName, 1, words);
    EXPECT_FALSE(fs::exists(out));
  }
};
} // namespace

TEST_F(EstimatedMotion, IsFoundFromTheFieldTAlone)
{
  const Outcome outcome = run();
  EXPECT_NE(outcome.exit_code, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("field t, in s since the scan's stamp"), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.out.find("motion within scans: deskewed 8 of 8 scans"),
            std::string::npos)
      << outcome.out;
  EXPECT_GT(shareInPlace(), 0.95);
  const auto scan = summary()["scans"][3]["motion"];
  EXPECT_TRUE(scan["deskewed"]);
  EXPECT_EQ(scan["reason"], "");
  EXPECT_NEAR(scan["translation"], kTurn * scanner.velocity.norm(), 0.01);
  EXPECT_NEAR(scan["rotation"], kTurn * scanner.turning.norm(), 0.004);
  EXPECT_EQ(scan["knots"], 2);
  EXPECT_EQ(summary()["options"]["deskew"]["value"], "estimate");
  const auto cloud = pcl6d::readPcd(out / "scans" / "scan003.pcd");
  EXPECT_TRUE(pcl6d::fieldValues(cloud, "t")) << "the times stay";
}

TEST_F(EstimatedMotion, TakesStampsUnitsAndKnots)
{
  std::string stamps;
  for (int i = 0; i < kSweeps; ++i) {
    stamps += std::to_string(100 + i * kTurn) + "\n";
    write(i, 1e6, pcl::PCLPointField::UINT32, "time");
  }
  writeText(in / "times.txt", stamps);
  const Outcome outcome = run({"--knots", "0.05"});
  EXPECT_NE(outcome.err.find("field time, in us since"), std::string::npos)
      << outcome.err;
  EXPECT_GT(shareInPlace(), 0.95);
  EXPECT_EQ(summary()["scans"][3]["motion"]["knots"], 3);
  EXPECT_EQ(summary()["options"]["knots"]["value"], "0.05");
  fs::remove(in / "times.txt");
  for (int i = 0; i < kSweeps; ++i)
    write(i, 1e9, pcl::PCLPointField::UINT32);
  const Outcome alone = run({"--force"});
  EXPECT_NE(alone.err.find("field t, in ns since"), std::string::npos) << alone.err;
}

TEST_F(EstimatedMotion, HasTheSameBytesForEveryThreadCountAndMemory)
{
  const auto bytes = [&](const std::vector<std::string>& more) {
    run(more);
    auto content = contentOf(out);
    EXPECT_EQ(content.erase("summary.json"), 1u); // holds times
    fs::remove_all(out);
    return content;
  };
  const auto expected = bytes({"--threads", "1"});
  EXPECT_TRUE(bytes({"--threads", "2"}) == expected); // megabytes, not to be printed
  EXPECT_TRUE(bytes({"--threads", "8"}) == expected);
  EXPECT_TRUE(bytes({"--memory", "200M"}) == expected);
}

TEST_F(EstimatedMotion, AScannerThatStandsStillGivesTheRunWithoutIt)
{
  scanner.velocity.setZero();
  scanner.turning.setZero();
  makeSweeps();
  run();
  for (const auto& scan : summary()["scans"])
    EXPECT_FALSE(scan["motion"]["deskewed"]) << scan["motion"];
  auto timed = contentOf(out);
  fs::remove_all(out);
  slam(in, out, {"--no-picture"});
  EXPECT_FALSE(summary()["scans"][2].contains("motion"));
  auto plain = contentOf(out);
  timed.erase("summary.json");
  plain.erase("summary.json");
  for (const auto& [name, content] : plain)
    EXPECT_TRUE(timed[name] == content) << name; // megabytes, not to be printed
  EXPECT_EQ(timed.size(), plain.size());
}

TEST_F(EstimatedMotion, ARunGoesOn)
{
  const fs::path later = folder / "later";
  fs::create_directory(later);
  for (int i = 5; i < kSweeps; ++i)
    fs::rename(file(i), later / file(i).filename());
  run();
  const auto before = contentOf(out / "scans");
  const Outcome outcome =
      slam(later, folder / "more", {"--continue", out.string(), "--no-picture"});
  EXPECT_NE(outcome.exit_code, 1) << outcome.err;
  auto after = contentOf(folder / "more" / "scans");
  EXPECT_EQ(after.size(), 8u);
  fs::remove_all(out);
  fs::rename(folder / "more", out);
  EXPECT_TRUE(summary()["scans"][7]["motion"]["deskewed"]);
  EXPECT_TRUE(summary()["scans"][2]["motion"]["deskewed"]) << "by the run before";
  EXPECT_GT(shareInPlace(), 0.9);
}

TEST_F(EstimatedMotion, NoTimes)
{
  writeText(file(2), pcl6d::test::grid());
  expectEstimateRefused({"scan002.pcd", "no field t or time", "fields: x y z"});
  writeText(file(0), pcl6d::test::grid());
  expectEstimateRefused({"scan000.pcd", "no field t or time"});
}

TEST_F(EstimatedMotion, TimesOfNoUnit)
{
  for (double& time : sweeps[0].times)
    time *= 1000; // a scan of 100 s
  write(0, 1, pcl::PCLPointField::FLOAT32);
  expectEstimateRefused({"scan000.pcd", "field t", "at most 20 s"});
  write(0, 1e-3, pcl::PCLPointField::FLOAT32);
  sweeps[3].times[7] = NAN;
  write(3, 1, pcl::PCLPointField::FLOAT32);
  expectEstimateRefused({"scan003.pcd", "field t is not finite", "= 1"});
}

TEST_F(EstimatedMotion, EqualTimesAndASingleScanStayAsTheyAre)
{
  for (int i = 1; i < kSweeps; ++i)
    fs::remove(file(i));
  run();
  EXPECT_EQ(summary()["scans"][0]["motion"]["reason"], "no later scan to compare with");
  sweeps.resize(1);
  sweeps[0].times.assign(sweeps[0].times.size(), 0.02);
  write(0, 1, pcl::PCLPointField::FLOAT32);
  run({"--force"});
  EXPECT_EQ(summary()["scans"][0]["motion"]["reason"], "the points have equal times");
}

TEST_F(EstimatedMotion, WordsOfTheCommandLine)
{
  expectUsageError({in.string(), "-o", out.string(), "--deskew=magic"},
                   {"--deskew = magic", "odometry, estimate, yes or no"});
  expectUsageError(
      {in.string(), "-o", out.string(), "--deskew", "estimate", "--knots", "0"},
      {"--knots", "> 0 s"});
  const Outcome outcome = slam(in, out, {"--knots", "0.1", "--no-picture"});
  EXPECT_NE(outcome.err.find("--knots (of --deskew estimate)"), std::string::npos)
      << outcome.err;
}
