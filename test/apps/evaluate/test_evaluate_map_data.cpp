// SPDX-License-Identifier: BSD-3-Clause
// Maps of recorded scans are ranked without the truth.
#include "support/data_folder.h"
#include "support/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

namespace fs = std::filesystem;

namespace {
using Json = nlohmann::json;
using pcl6d::test::readText;
using pcl6d::test::runProgram;

/** KITTI rows with the positions bent by half a wave along z and x; smooth, so that
 * successive scans hardly notice. */
std::string
bent(const std::string& trajectory, double height)
{
  std::istringstream input(trajectory);
  std::vector<std::string> rows;
  for (std::string row; std::getline(input, row);)
    rows.push_back(row);
  std::ostringstream out;
  out.precision(17);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double shift = height * std::sin(M_PI * static_cast<double>(i) /
                                           static_cast<double>(rows.size() - 1));
    std::istringstream numbers(rows[i]);
    double value = 0;
    for (int k = 0; numbers >> value; ++k)
      out << value + (k == 3 || k == 11 ? shift * std::sqrt(0.5) : 0)
          << (k == 11 ? '\n' : ' ');
  }
  return out.str();
}

Json
measured(const fs::path& map, const fs::path& poses, const fs::path& file)
{
  std::vector<std::string> arguments{
      "map", map, "--voxel", "0.17", "--quiet", "-o", file};
  if (!poses.empty())
    arguments.insert(arguments.end(), {"--poses", poses});
  const auto outcome = runProgram("pcl_slam6d_evaluate", arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return Json::parse(readText(file));
}

void
expectBetter(const Json& good, const Json& bad, const std::string& name)
{
  EXPECT_GT(good["agreement"], bad["agreement"]) << name;
  for (const char* measure : {"entropy", "plane_variance", "thickness"})
    EXPECT_LT(good[measure], bad[measure]) << measure << " of " << name;
  EXPECT_LT(good["others"]["plane"]["rms"], bad["others"]["plane"]["rms"]) << name;
  EXPECT_LT(good["revisit_blur"], bad["revisit_blur"]) << name;
}
} // namespace

TEST(EvaluateMapData, RanksTheMapsOfHku1WithoutTheTruth)
{
  PCL6D_DATA_OR_SKIP(folder, "hku1");
  const pcl6d::test::TempFolder out;
  const auto slam = [&](const char* name, std::vector<std::string> more) {
    more.insert(more.begin(), {folder.string(), "-o", out / name});
    return runProgram("pcl_slam6d", more).exit_code;
  };
  ASSERT_EQ(slam("good", {}), 0);
  slam("pairwise",
       {"--metascan", "1", "--loop-closing", "none", "--relaxation", "none"});
  const Json good = measured(out / "good", {}, out / "good.json");
  expectBetter(
      good, measured(out / "pairwise", {}, out / "pairwise.json"), "pairwise matching");
  expectBetter(good, measured(folder, {}, out / "odometry.json"), "odometry");
  const std::string trajectory = readText(out / "good/trajectory.kitti");
  Json before = good;
  for (const double height : {0.05, 0.2}) {
    pcl6d::test::writeText(out / "bent.kitti", bent(trajectory, height));
    const Json now = measured(out / "good", out / "bent.kitti", out / "bent.json");
    expectBetter(before, now, "bent by " + std::to_string(height));
    before = now;
  }
}
