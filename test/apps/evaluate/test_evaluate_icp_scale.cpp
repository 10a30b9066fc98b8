// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_evaluate icp --scale.
#include "apps/evaluate/csv_rows.h"
#include "apps/support/room_pair.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {
using pcl6d::test::evaluateIcp;
using pcl6d::test::readCsv;
using pcl6d::test::readText;
using pcl6d::test::RoomPair;

/** \return what --scale finds for scan b of a pair, whose coordinates are first divided */
double
scaleOf(double divisor)
{
  const RoomPair pair;
  pcl6d::Random random(3);
  const pcl6d::test::PillarRoom room;
  const Eigen::Isometry3d first = pcl6d::planarPose(-1, 0.3, 0.1);
  room.scan(first, random, 0.1); // the random numbers of scan a
  pcl6d::Points points = room.scan(first * pair.truth, random, 0.1);
  for (auto& p : points)
    p /= static_cast<float>(divisor);
  pair.write("b.xyz", points);
  const auto outcome = evaluateIcp(pair.arguments({"--scale", "-o", pair / "out"}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("scale of "), std::string::npos) << outcome.out;
  const auto rows = readCsv(pair / "out/icp.csv");
  for (const auto& row : rows) {
    EXPECT_EQ(row.at("metric"), "point");
    EXPECT_EQ(row.at("minimiser"), "scale-quaternion");
  }
  const auto json = nlohmann::json::parse(readText(pair / "out/icp.json"));
  const double scale = json["best"][0]["scale"];
  int near = 0;
  const auto runs = readCsv(pair / "out/icp_runs.csv");
  for (const auto& run : runs)
    near += std::abs(std::stod(run.at("scale")) - scale) < 1e-3;
  EXPECT_GT(near, static_cast<int>(runs.size()) / 2);
  return scale;
}
} // namespace

TEST(EvaluateIcpScale, FindsTheFactorThatTheScanWasDividedBy)
{
  // Two samples of noisy walls give the same error to both, but for the pairs that differ.
  EXPECT_NEAR(scaleOf(1.02) / scaleOf(1.005), 1.02 / 1.005, 2e-3);
}

TEST(EvaluateIcpScale, IsOneInFilesUnlessAskedFor)
{
  const RoomPair pair;
  const auto outcome = evaluateIcp(pair.arguments(
      {"--metric=point", "--minimiser=scale-quaternion", "-o", pair / "out"}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("scale of"), std::string::npos) << outcome.out;
  const auto json = nlohmann::json::parse(readText(pair / "out/icp.json"));
  EXPECT_EQ(json["best"][0]["scale"], 1);
}

TEST(EvaluateIcpScale, RefusesMethodsWithoutAScale)
{
  const RoomPair pair;
  const auto refused = [&](const std::vector<std::string>& more, const char* word) {
    const auto outcome = evaluateIcp(pair.arguments(more));
    EXPECT_EQ(outcome.exit_code, 2) << word;
    EXPECT_NE(outcome.err.find("--scale"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
  };
  refused({"--scale", "--metric=plane"}, "--metric point");
  refused({"--scale", "--metric=all"}, "--metric point");
  refused({"--scale", "--minimiser=svd"}, "--minimiser scale-quaternion");
  const auto outcome = evaluateIcp(pair.arguments({"--scale",
                                                   "--metric=point",
                                                   "--minimiser=scale-quaternion",
                                                   "--search=kdtree"}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}
