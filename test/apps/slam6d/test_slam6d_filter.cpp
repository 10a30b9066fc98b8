// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d --filter and --reduction: what stands for the points of a scan.
#include "apps/support/bad_input.h"
#include "apps/support/corridor_run.h"

#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/trajectory_io.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <map>

namespace {
namespace fs = std::filesystem;
using pcl6d::test::BadInput;
using pcl6d::test::readText;
using pcl6d::test::slam;
using pcl6d::test::TempFolder;
using Words = std::vector<std::string>;

constexpr int kLast = 7;

/** Position rms [m] of the first scans against the truth, without alignment. */
double
filteredRms(const fs::path& trajectory)
{
  const auto found = pcl6d::readTrajectory(trajectory).poses;
  const auto truth = pcl6d::readTrajectory(pcl6d::test::scans() / "groundtruth.txt");
  double sum = 0;
  for (std::size_t i = 0; i <= kLast; ++i)
    sum += (found.at(i).translation() - truth.poses[i].translation()).squaredNorm();
  return std::sqrt(sum / (kLast + 1));
}

/** A run over the first scans of the corridor. */
struct FilteredRun {
  explicit FilteredRun(Words more)
  {
    more.insert(more.end(), {"--last", std::to_string(kLast), "--no-picture"});
    const auto outcome = slam(pcl6d::test::scans(), folder / "out", more);
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 3) << outcome.err;
    err = outcome.err;
    poses = readText(folder / "out/trajectory.kitti");
    summary = nlohmann::json::parse(readText(folder / "out/summary.json"));
    rms = filteredRms(folder / "out/trajectory.kitti");
  }

  std::string
  option(const char* name) const
  {
    return summary.at("options").at(name).at("value");
  }

  TempFolder folder;
  std::string err, poses;
  nlohmann::json summary;
  double rms = 0;
};
} // namespace

TEST(Slam6dFilter, EachReductionAndFilterImprovesOnOdometryAndIsInTheSummary)
{
  const double odometry = filteredRms(pcl6d::test::scans() / "odometry.txt");
  const FilteredRun plain({});
  EXPECT_EQ(plain.option("filter"), "none");
  EXPECT_EQ(plain.option("reduction"), "mean");
  const std::vector<Words> all = {{"--reduction", "centre"},
                                  {"--reduction", "random", "--reduction-points", "2"},
                                  {"--filter", "scanline-median"},
                                  {"--filter", "scanline-reduction"},
                                  {"--filter", "scanline-both"}};
  std::map<std::string, int> poses = {{plain.poses, 1}};
  for (const Words& words : all) {
    SCOPED_TRACE(words[1]);
    const FilteredRun run(words);
    EXPECT_EQ(run.option(words[0].c_str() + 2), words[1]);
    EXPECT_LT(run.rms, 0.5 * odometry) << odometry << " m";
    EXPECT_EQ(++poses[run.poses], 1) << "as another run";
  }
}

TEST(Slam6dFilter, TheReductionByNameIsTheDefault)
{
  EXPECT_EQ(FilteredRun({"--reduction", "mean", "--filter", "none"}).poses,
            FilteredRun({}).poses);
}

TEST(Slam6dFilter, PointsWithoutEffectAreNamed)
{
  const FilteredRun run({"--reduction-points", "3"});
  EXPECT_NE(run.err.find("reduction-points"), std::string::npos) << run.err;
}

TEST(Slam6dFilter, ALineReductionKeepsTheScansThatAreWritten)
{
  const FilteredRun run({"--filter", "scanline-reduction"});
  const auto before = pcl6d::readScan(pcl6d::test::scans() / "scan000.pcd");
  const auto after = pcl6d::readScan(run.folder / "out/scans/scan000.pcd");
  EXPECT_EQ(after.points, before.points);
  EXPECT_LT(run.summary["scans"][0]["points"].get<std::size_t>(),
            before.points.size() / 2);
}

TEST_F(BadInput, AScanWithoutLinesCannotBeFilteredAlongThem)
{
  const Words arguments = {
      in.string(), "-o", out.string(), "--filter", "scanline-median"};
  const auto outcome = pcl6d::test::runProgram(pcl6d::test::kName, arguments);
  pcl6d::test::expectError(
      outcome,
      pcl6d::test::kName,
      1,
      {"scan000.pcd", "scan lines", "HEIGHT > 1", "--filter none"});
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(BadInput, UnknownFiltersAndReductionsAreNamedWithTheKnownOnes)
{
  const auto refused = [&](Words more, const Words& words) {
    more.insert(more.begin(), {in.string(), "-o", out.string()});
    pcl6d::test::expectError(pcl6d::test::runProgram(pcl6d::test::kName, more),
                             pcl6d::test::kName,
                             2,
                             words);
  };
  refused({"--filter", "median"}, {"--filter = median", "scanline-median"});
  refused({"--reduction", "median"}, {"--reduction = median", "mean", "random"});
  refused({"--reduction-points", "0"}, {"--reduction-points = 0", ">= 1"});
}
