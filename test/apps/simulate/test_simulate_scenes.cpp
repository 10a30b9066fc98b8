// SPDX-License-Identifier: BSD-3-Clause
#include "apps/simulate/simulate_program.h"
#include "apps/support/program_names.h"
#include "apps/support/without_late_libraries.h"
#include "support/run_program.h"

#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/trajectory_io.h>

#include <pcl/common/io.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <map>

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using pcl6d::test::contentOf;
using pcl6d::test::kSimulate;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::simulate;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

template <typename T>
T
valueAt(const pcl::PCLPointCloud2& cloud, std::size_t point, const std::string& name)
{
  const int field = pcl::getFieldIndex(cloud, name);
  T value{};
  std::memcpy(&value,
              &cloud.data[point * cloud.point_step +
                          cloud.fields.at(static_cast<std::size_t>(field)).offset],
              sizeof value);
  return value;
}

Eigen::Isometry3d
poseOf(const json& numbers)
{
  Eigen::Isometry3d pose;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      pose.matrix()(row, column) =
          numbers.at(static_cast<std::size_t>(4 * row + column)).get<double>();
  return pose;
}

Eigen::Vector3d
vectorOf(const json& numbers)
{
  return {numbers.at(0).get<double>(),
          numbers.at(1).get<double>(),
          numbers.at(2).get<double>()};
}

constexpr const char* kHall = R"({
  "scans": 4,
  "materials": {"concrete": {"reflectance": 0.5, "label": "floor"}},
  "bodies": [{"type": "box", "material": "concrete", "centre": [0, 0, -0.1],
              "size": [20, 20, 0.2]}],
  "objects": [{"class": "crate", "position": [0, 0, 0.5], "yaw": 0.3,
               "bodies": [{"type": "box", "centre": [0, 0, 0], "size": [1, 2, 1]}]}],
  "waypoints": [[-4, -4, 0], [4, -4, 0], [4, 4, 0], [-4, 4, 0]]
})";
} // namespace

TEST(SimulateScenes, PointsLieOnThePlanesAndObjectsOfTheTruth)
{
  const TempFolder folder;
  const Outcome outcome =
      simulate({"rooms", "-o", folder.path().string(), "--scans", "3", "--noise", "0"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("planes_truth.json"), std::string::npos);
  const json planes = json::parse(readText(folder / "planes_truth.json"))["planes"];
  const json objects = json::parse(readText(folder / "objects_truth.json"))["objects"];
  const auto truth = pcl6d::readTrajectory(folder / "groundtruth.txt");
  std::map<std::size_t, std::size_t> on_plane, on_object;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto cloud = pcl6d::readPcd(folder / ("scan00" + std::to_string(i) + ".pcd"));
    for (std::size_t k = 0; k < std::size_t(cloud.width) * cloud.height; ++k) {
      const Eigen::Vector3d p =
          truth.poses[i] * Eigen::Vector3d(valueAt<float>(cloud, k, "x"),
                                           valueAt<float>(cloud, k, "y"),
                                           valueAt<float>(cloud, k, "z"));
      const auto plane_id = valueAt<std::uint32_t>(cloud, k, "plane_id");
      const auto object_id = valueAt<std::uint32_t>(cloud, k, "object_id");
      if (plane_id > 0) {
        const json& plane = planes.at(plane_id - 1);
        ++on_plane[plane_id];
        ASSERT_NEAR(vectorOf(plane["normal"]).dot(p), plane["offset"], 1e-5);
        const char* const labels[] = {"none", "floor", "ceiling", "wall", "door"};
        EXPECT_EQ(plane["label"], labels[valueAt<std::uint32_t>(cloud, k, "label")]);
      }
      if (object_id > 0) {
        const json& object = objects.at(object_id - 1);
        ++on_object[object_id];
        const Eigen::Array3d off = (poseOf(object["T_world_object"]).inverse() * p -
                                    vectorOf(object["centre"]))
                                       .cwiseAbs();
        ASSERT_TRUE((off <= vectorOf(object["extent"]).array() / 2 + 1e-5).all());
      }
    }
  }
  EXPECT_GT(on_plane.size(), 20u);
  EXPECT_GT(on_object.size(), 3u);
  for (const auto& plane : planes)
    EXPECT_EQ(plane["inliers"], on_plane[plane["id"].get<std::size_t>()]);
  for (const auto& object : objects)
    EXPECT_EQ(object["points"], on_object[object["id"].get<std::size_t>()]);
}

TEST(SimulateScenes, HaveTheSameBytesForTheSameSeedAndAnyThreads)
{
  const TempFolder folder;
  for (const char* scene : {"rooms",
                            "campus",
                            "multilevel",
                            "mine",
                            "parking",
                            "twins",
                            "tunnel",
                            "shelves",
                            "glass",
                            "crowd"}) {
    SCOPED_TRACE(scene);
    const auto bytes = [&](const std::string& seed, const std::string& threads) {
      const fs::path out = folder / (scene + seed + "_" + threads);
      const Outcome outcome = simulate({scene,
                                        "-o",
                                        out.string(),
                                        "--scans",
                                        "2",
                                        "--quiet",
                                        "--seed",
                                        seed,
                                        "--threads",
                                        threads});
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      return contentOf(out);
    };
    const auto expected = bytes("3", "1");
    EXPECT_EQ(expected.size(), 7u);
    EXPECT_TRUE(bytes("3", "2") == expected);
    EXPECT_TRUE(bytes("3", "8") == expected);
    EXPECT_TRUE(bytes("4", "1") != expected);
  }
}

TEST(SimulateScenes, AreListedInTheHelpAndInTheError)
{
  const std::string help = simulate({"--help"}).out;
  for (const char* scene : {"corridor",
                            "rooms",
                            "campus",
                            "multilevel",
                            "mine",
                            "parking",
                            "twins",
                            "tunnel",
                            "shelves",
                            "glass",
                            "crowd"}) {
    EXPECT_NE(help.find("\n  " + std::string(scene) + ": "), std::string::npos);
    pcl6d::test::expectError(simulate({"car park", "-o", "x"}), kSimulate, 2, {scene});
  }
}

TEST(SimulateScenes, LabelCorridorOnlyIfAsked)
{
  const TempFolder folder;
  const std::string plain = (folder / "plain").string();
  const std::string labelled = (folder / "labelled").string();
  ASSERT_EQ(simulate({"corridor", "-o", plain, "--scans", "1"}).exit_code, 0);
  ASSERT_EQ(simulate({"corridor", "-o", labelled, "--scans", "1", "--labels", "yes"})
                .exit_code,
            0);
  EXPECT_FALSE(fs::exists(fs::path(plain) / "planes_truth.json"));
  EXPECT_TRUE(fs::exists(fs::path(labelled) / "planes_truth.json"));
  const auto cloud = pcl6d::readPcd(fs::path(labelled) / "scan000.pcd");
  EXPECT_GE(pcl::getFieldIndex(cloud, "label"), 0);
  // What an earlier run with labels left goes with the next one.
  ASSERT_EQ(simulate({"corridor", "-o", labelled, "--scans", "1"}).exit_code, 0);
  EXPECT_TRUE(contentOf(plain) == contentOf(labelled));
}

TEST(SimulateScenes, LeaveOutTheObjectsOfSomeClasses)
{
  const TempFolder folder;
  const auto made = [&](const char* name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {
        "rooms", "--scans", "1", "--quiet", "-o", (folder / name).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = simulate(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return folder / name;
  };
  const auto classesIn = [](const fs::path& run) {
    std::map<std::string, int> classes;
    const json truth = json::parse(readText(run / "objects_truth.json"));
    for (const auto& object : truth["objects"])
      ++classes[object["class"].get<std::string>()];
    return classes;
  };
  const fs::path whole = made("whole", {});
  const fs::path fewer = made("fewer", {"--without", "chair", "--without", "table"});
  auto expected = classesIn(whole);
  EXPECT_EQ(expected.erase("chair") + expected.erase("table"), 2u);
  ASSERT_FALSE(expected.empty());
  EXPECT_EQ(classesIn(fewer), expected);
  EXPECT_EQ(json::parse(readText(fewer / "scene.json"))["without"],
            json({"chair", "table"}));
  EXPECT_FALSE(json::parse(readText(whole / "scene.json")).contains("without"));
  EXPECT_NE(readText(fewer / "scan000.pcd"), readText(whole / "scan000.pcd"));
  // A class that is not there changes no byte of the scan.
  const fs::path same = made("same", {"--without", "unicorn"});
  EXPECT_EQ(readText(same / "scan000.pcd"), readText(whole / "scan000.pcd"));
}

TEST(SimulateScenes, ReadADescription)
{
  const TempFolder folder;
  writeText(folder / "hall.json", kHall);
  const fs::path out = folder / "out";
  const Outcome outcome =
      simulate({(folder / "hall.json").string(), "-o", out.string()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(out / "scan003.pcd"));
  EXPECT_FALSE(fs::exists(out / "scan004.pcd"));
  const json scene = json::parse(readText(out / "scene.json"));
  EXPECT_EQ(scene["description"], json::parse(kHall));
  const json objects = json::parse(readText(out / "objects_truth.json"))["objects"];
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0]["class"], "crate");
  EXPECT_LT((vectorOf(objects[0]["extent"]) - Eigen::Vector3d(1, 2, 1)).norm(), 1e-9);
  EXPECT_GT(objects[0]["points"], 100);
}

TEST(SimulateScenes, NameWhatIsWrongWithADescription)
{
  const TempFolder folder;
  const fs::path file = folder / "hall.json";
  const auto expectRefused = [&](const std::string& what,
                                 const std::string& by,
                                 const std::vector<std::string>& words) {
    std::string text = kHall;
    text.replace(text.find(what), what.size(), by);
    writeText(file, text);
    const fs::path out = folder / "out";
    pcl6d::test::expectError(
        simulate({file.string(), "-o", out.string()}), kSimulate, 1, words);
    EXPECT_FALSE(fs::exists(out));
  };
  expectRefused(
      "\"yaw\"", "\"jaw\"", {file.string(), "/objects/0", "unknown key 'jaw'"});
  expectRefused("[-4, 4, 0]]", "[-4, 40, 0]]", {"no floor below the path"});
  expectRefused("\"position\": [0, 0, 0.5]",
                "\"position\": [4, 0, 1]",
                {"scan ", "crate", "x = 4", "of the scene"});
  pcl6d::test::expectError(simulate({(folder / "none.json").string(), "-o", "x"}),
                           kSimulate,
                           1,
                           {"none.json"});
}

TEST(SimulateScenes, DriveThroughAMesh)
{
  const TempFolder folder;
  const std::string mesh = (folder / "Grube ä.obj").string();
  writeText(mesh,
            "v -1000 0 1000\nv 1000 0 1000\nv 1000 0 -1000\nv -1000 0 -1000\n"
            "v 0 200 0\nf 1 2 3 4\nf 1 2 5\n"); // centimetres, y up
  const std::string path = (folder / "path.txt").string();
  writeText(path, "# floor\n-3 0 0\n3 0 0\n3 6 0\n\n-3 6 0\n");
  const fs::path out = folder / "out";
  const Outcome outcome = simulate({mesh,
                                    "--path",
                                    path,
                                    "--scale",
                                    "0.01",
                                    "--up",
                                    "y",
                                    "--scans",
                                    "2",
                                    "-o",
                                    out.string()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(out / "scan001.pcd"));
  const std::string other = (folder / "other").string();
  const auto expectRefused =
      [&](std::vector<std::string> arguments, int exit_code, const std::string& word) {
        arguments.insert(arguments.end(), {"-o", other});
        pcl6d::test::expectError(simulate(arguments), kSimulate, exit_code, {word});
        EXPECT_FALSE(fs::exists(other));
      };
  expectRefused({mesh}, 2, "--path");
  expectRefused({"corridor", "--path", path}, 2, "--path");
  expectRefused({mesh, "--path", path, "--up", "x"}, 2, "--up");
  expectRefused({mesh, "--path", path, "--scale", "0"}, 2, "--scale");
  expectRefused({"corridor", "--labels", "maybe"}, 2, "--labels");
  writeText(path, "0 0 0\n1 0\n");
  expectRefused({mesh, "--path", path}, 1, "line 2");
  writeText(path, "0 0 0\n1 0 0\n1 1 0\n");
  writeText(mesh, "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  expectRefused({mesh, "--path", path}, 1, "triangle 1: area is zero");
}

TEST(SimulateScenes, OtherWorldsNeedALibraryWhoseAbsenceIsTold)
{
  if (!pcl6d::test::WithoutLateLibraries::areUsed())
    GTEST_SKIP() << "static libraries";
  const TempFolder folder;
  const std::string out = folder / "out";
  const pcl6d::test::WithoutLateLibraries without;
  pcl6d::test::expectError(
      simulate({"rooms", "-o", out}),
      kSimulate,
      1,
      {"world 'rooms': ", "libpcl6d_simulation_worlds.so is missing", "builds it"});
  EXPECT_FALSE(fs::exists(out));
  const auto outcome = simulate({"corridor", "-o", out, "--scans", "1", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}
