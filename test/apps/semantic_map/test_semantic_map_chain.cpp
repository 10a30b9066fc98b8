// SPDX-License-Identifier: BSD-3-Clause
// From scans to answers: the scene of share/demo.sh, registered and made a semantic map.
#include "support/run_program.h"

#include <pcl6d/io/trajectory_io.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

using namespace pcl6d;
using pcl6d::test::Outcome;
using pcl6d::test::runProgram;

namespace {
constexpr const char* kName = "pcl_slam6d_semantic_map";
constexpr double kHalfWidth =
    3.25; // [m] of the rooms in the corners of the scene, along x

/** The scene of the demo with half the resolution, and the semantic map of its run. */
class DemoMap {
public:
  DemoMap()
  {
    runProgram("pcl_slam6d_simulate",
               {"corridor",
                "-o",
                scans().string(),
                "--seed",
                "1",
                "--resolution",
                "2",
                "--quiet"});
    slam =
        runProgram("pcl_slam6d", {scans().string(), "-o", run().string(), "--quiet"});
    built = runProgram(kName, {"build", run().string(), "--quiet"});
  }

  /** \return the results of a query */
  nlohmann::json
  ask(const std::string& query) const
  {
    const Outcome outcome =
        runProgram(kName, {"query", run().string(), query, "--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out)["results"];
  }

  std::filesystem::path
  scans() const
  {
    return folder_ / "scans";
  }

  Outcome slam;
  Outcome built;

private:
  std::filesystem::path
  run() const
  {
    return folder_ / "run";
  }

  test::TempFolder folder_;
};

std::set<int>
idsOf(const nlohmann::json& results)
{
  std::set<int> ids;
  for (const auto& result : results)
    ids.insert(result["id"].get<int>());
  return ids;
}

/** A room of the scene, in the frame of the first scan. */
struct Corner {
  const char* name;
  Eigen::Vector2d centre; // [m]
  double depth;           // [m] along y
  double floor;           // [m]
};

const Corner kCorners[] = {{"south-west", {-0.75, -0.5}, 5, -0.9},
                           {"south-east", {13.75, -0.5}, 5, -0.9},
                           {"north-west", {-0.75, 13.25}, 4.5, -0.2},
                           {"north-east", {13.75, 13.25}, 4.5, -0.2}};

/** \return the id of the room at a place, or 0 */
int
roomAt(const nlohmann::json& rooms, const Corner& corner)
{
  for (const auto& room : rooms)
    if ((Eigen::Vector2d(room["x"], room["y"]) - corner.centre).norm() < 0.2)
      return room["id"].get<int>();
  return 0;
}

/** 1: the four rooms on their two levels. */
void
expectFourRooms(const DemoMap& map)
{
  const auto rooms = map.ask("rooms area>25");
  ASSERT_EQ(rooms.size(), 4u);
  for (const auto& corner : kCorners) {
    SCOPED_TRACE(corner.name);
    const int id = roomAt(rooms, corner);
    ASSERT_NE(id, 0);
    const auto room = map.ask("rooms id=" + std::to_string(id))[0];
    const double area = 2 * kHalfWidth * corner.depth;
    EXPECT_NEAR(room["area"].get<double>(), area, 0.05 * area) << "less a cabinet";
    EXPECT_NEAR(room["z"].get<double>(), corner.floor, 0.05);
    EXPECT_NEAR(room["height"].get<double>(), 2.6, 0.05);
  }
}

/** 2: which scans were taken in a room. */
void
expectScansOfRooms(const DemoMap& map)
{
  const Trajectory truth = readTrajectory(map.scans() / "groundtruth.txt");
  const auto rooms = map.ask("rooms area>25");
  for (const auto& corner : kCorners) {
    SCOPED_TRACE(corner.name);
    const auto ids =
        idsOf(map.ask("scans room=" + std::to_string(roomAt(rooms, corner))));
    const Eigen::Vector2d half(kHalfWidth, corner.depth / 2);
    for (std::size_t i = 0; i < truth.poses.size(); ++i) {
      const Eigen::Vector2d place =
          (truth.poses[i].translation().head<2>() - corner.centre).cwiseAbs() - half;
      if (std::abs(place.maxCoeff()) < 0.15) // in the door
        continue;
      EXPECT_EQ(ids.count(static_cast<int>(i)), place.maxCoeff() < 0 ? 1U : 0U)
          << "scan " << i;
    }
  }
}

/** 3: which corridor a room leads to, and its three shut doors. */
void
expectCorridors(const DemoMap& map)
{
  const auto rooms = map.ask("rooms area>25");
  std::set<int> corridors;
  for (const auto& corner : kCorners) {
    SCOPED_TRACE(corner.name);
    const int room = roomAt(rooms, corner);
    const auto found = map.ask("rooms area>10 area<25 next_to=" + std::to_string(room));
    ASSERT_EQ(found.size(), 1u);
    const int corridor = found[0]["id"].get<int>();
    corridors.insert(corridor);
    EXPECT_NEAR(found[0]["z"].get<double>(), corner.floor, 0.05);
    EXPECT_EQ(map.ask("planes label=door room=" + std::to_string(corridor)).size(), 3u);
  }
  EXPECT_EQ(corridors.size(), 2u) << "one on each level";
}
} // namespace

TEST(SemanticMapChain, AnswersThreeQueriesOfTheSceneOfTheDemo)
{
  const DemoMap map;
  ASSERT_EQ(map.slam.exit_code, 0) << map.slam.err;
  ASSERT_EQ(map.built.exit_code, 0) << map.built.err;
  expectFourRooms(map);
  expectScansOfRooms(map);
  expectCorridors(map);
}
