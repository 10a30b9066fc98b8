// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_simulate --people, --traffic: what moves, and its labels.
#include "apps/support/program_names.h"
#include "support/run_program.h"

#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_fields.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using pcl6d::test::contentOf;
using pcl6d::test::expectError;
using pcl6d::test::kSimulate;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;

Outcome
simulateInto(const fs::path& out, std::vector<std::string> arguments)
{
  arguments.insert(arguments.end(), {"-o", out.string()});
  return pcl6d::test::runProgram(kSimulate, arguments);
}

std::size_t
dynamicPoints(const fs::path& scan)
{
  const auto dynamic = pcl6d::fieldValues(pcl6d::readPcd(scan), "dynamic");
  EXPECT_TRUE(dynamic && dynamic->is_integer) << scan;
  if (!dynamic)
    return 0;
  EXPECT_TRUE(std::all_of(dynamic->values.begin(),
                          dynamic->values.end(),
                          [](double value) { return value == 0 || value == 1; }));
  return static_cast<std::size_t>(
      std::count(dynamic->values.begin(), dynamic->values.end(), 1));
}
} // namespace

TEST(SimulateTraffic, PeopleWalkInTheCorridorAndAreLabelled)
{
  const TempFolder folder;
  const Outcome outcome =
      simulateInto(folder.path(),
                   {"corridor", "--people", "3", "--scans", "8", "--resolution", "2"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::size_t moving = 0;
  for (int i = 0; i < 8; ++i)
    moving += dynamicPoints(folder / ("scan00" + std::to_string(i) + ".pcd"));
  EXPECT_GT(moving, 50u);
  const auto cloud = pcl6d::readPcd(folder / "scan000.pcd");
  EXPECT_FALSE(pcl6d::fieldValues(cloud, "plane_id"))
      << "of corridor only if asked for";
  const json scene = json::parse(readText(folder / "scene.json"));
  EXPECT_EQ(scene["traffic"]["people"], 3);
  ASSERT_EQ(scene["bodies"].size(), 3u);
  for (const auto& body : scene["bodies"]) {
    EXPECT_EQ(body["class"], "person");
    EXPECT_EQ(body["way"].size(), body["times"].size());
  }
}

TEST(SimulateTraffic, WhatStandsStillIsTheSameWithAndWithoutPeople)
{
  const TempFolder folder;
  const std::vector<std::string> plain = {
      "rooms", "--scans", "3", "--resolution", "4", "--seed", "3"};
  auto busy = plain;
  busy.insert(busy.end(), {"--people", "4"});
  ASSERT_EQ(simulateInto(folder / "plain", plain).exit_code, 0);
  ASSERT_EQ(simulateInto(folder / "busy", busy).exit_code, 0);
  EXPECT_EQ(readText(folder / "plain/groundtruth.txt"),
            readText(folder / "busy/groundtruth.txt"));
  EXPECT_EQ(readText(folder / "plain/odometry.txt"),
            readText(folder / "busy/odometry.txt"));
  std::size_t same = 0, moving = 0;
  for (int i = 0; i < 3; ++i) {
    const std::string name = "scan00" + std::to_string(i) + ".pcd";
    const auto before = pcl6d::readPcd(folder / "plain" / name);
    const auto now = pcl6d::readPcd(folder / "busy" / name);
    const auto was = pcl6d::coordinatesOf(before);
    const auto is = pcl6d::coordinatesOf(now);
    const auto dynamic = pcl6d::fieldValues(now, "dynamic")->values;
    ASSERT_EQ(was.size(), is.size());
    for (std::size_t k = 0; k < is.size(); ++k) {
      moving += dynamic[k] == 1;
      if (dynamic[k] == 1)
        continue;
      ++same;
      ASSERT_TRUE(was[k] == is[k] || (!was[k].allFinite() && !is[k].allFinite()))
          << name << ' ' << k;
    }
  }
  EXPECT_GT(moving, 20u);
  EXPECT_GT(same, 5000u);
}

TEST(SimulateTraffic, ACrowdIsLabelledTooUnlessLabelsAreNotWanted)
{
  const TempFolder folder;
  const std::vector<std::string> crowd = {"crowd", "--scans", "2", "--resolution", "2"};
  ASSERT_EQ(simulateInto(folder / "with", crowd).exit_code, 0);
  EXPECT_GT(dynamicPoints(folder / "with/scan000.pcd"), 10u);
  auto without = crowd;
  without.insert(without.end(), {"--labels", "no"});
  ASSERT_EQ(simulateInto(folder / "without", without).exit_code, 0);
  EXPECT_FALSE(
      pcl6d::fieldValues(pcl6d::readPcd(folder / "without/scan000.pcd"), "dynamic"));
  ASSERT_EQ(
      simulateInto(folder / "still", {"rooms", "--scans", "1", "--resolution", "9"})
          .exit_code,
      0);
  EXPECT_FALSE(
      pcl6d::fieldValues(pcl6d::readPcd(folder / "still/scan000.pcd"), "dynamic"));
}

TEST(SimulateTraffic, HasTheSameBytesForTheSameSeed)
{
  const TempFolder folder;
  const auto bytes = [&](const std::string& name,
                         const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"parking",
                                          "--people",
                                          "2",
                                          "--traffic",
                                          "1",
                                          "--scans",
                                          "3",
                                          "--resolution",
                                          "6"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(simulateInto(folder / name, arguments).exit_code, 0);
    return contentOf(folder / name);
  };
  const auto expected = bytes("one", {"--threads", "1"});
  EXPECT_TRUE(bytes("two", {"--threads", "2"}) == expected);
  EXPECT_TRUE(bytes("eight", {"--threads", "8"}) == expected);
  EXPECT_FALSE(bytes("other", {"--seed", "2"}) == expected);
}

TEST(SimulateTraffic, NamesWhatCannotBe)
{
  const TempFolder folder;
  const fs::path out = folder / "out";
  const auto expectRefused = [&](const std::vector<std::string>& arguments,
                                 int code,
                                 const std::vector<std::string>& words) {
    expectError(simulateInto(out, arguments), kSimulate, code, words);
    EXPECT_FALSE(fs::exists(out));
  };
  expectRefused({"corridor", "--people", "-1"}, 2, {"--people", "in [0, 200]"});
  expectRefused({"corridor", "--people", "201"}, 2, {"--people", "in [0, 200]"});
  expectRefused({"campus", "--traffic", "few"}, 2, {"few"});
  expectRefused({"corridor", "--traffic", "1"}, 1, {"no room for one more car"});
}
