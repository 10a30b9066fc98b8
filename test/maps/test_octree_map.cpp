// SPDX-License-Identifier: BSD-3-Clause
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/maps/octree_map.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>
#include <string>

namespace {
using pcl6d::CellState;
using pcl6d::MappedScan;
using pcl6d::OctreeMap;
using pcl6d::OctreeMapOptions;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;

using Voxel = std::array<int, 3>;

/** \return voxels of 1 m */
OctreeMapOptions
metreVoxels()
{
  OctreeMapOptions options;
  options.resolution = 1;
  return options;
}

/** \return a scan from the middle of the voxel 0 0 0 */
MappedScan
scanOf(const pcl6d::Points& points)
{
  MappedScan scan;
  scan.origin = {0.5F, 0.5F, 0.5F};
  scan.points = points;
  return scan;
}

Eigen::Vector3d
middleOf(const Voxel& voxel)
{
  return {voxel[0] + 0.5, voxel[1] + 0.5, voxel[2] + 0.5};
}

/** Expects these states and unknown everywhere else within 8 m. */
void
expectStates(const OctreeMap& map,
             const std::set<Voxel>& free,
             const std::set<Voxel>& occupied)
{
  for (int x = -8; x < 8; ++x)
    for (int y = -8; y < 8; ++y)
      for (int z = -8; z < 8; ++z) {
        const Voxel voxel = {x, y, z};
        const CellState expected = occupied.count(voxel) > 0 ? CellState::kOccupied
                                   : free.count(voxel) > 0   ? CellState::kFree
                                                             : CellState::kUnknown;
        ASSERT_EQ(map.state(middleOf(voxel)), expected) << x << ' ' << y << ' ' << z;
      }
}

/** The scene of several tests: a wall at x = 4, a slanted ray, a ray straight up. */
const pcl6d::Points kScene = {{4.5F, 0.5F, 0.5F},
                              {4.5F, 1.5F, 0.5F},
                              {0.5F, 0.5F, 3.5F}};
const std::set<Voxel> kFreeInScene = {
    {0, 0, 0},
    {1, 0, 0},
    {2, 0, 0},
    {3, 0, 0},
    {2, 1, 0}, // the slanted ray is at y = 1 in x = 2.5
    {3, 1, 0},
    {0, 0, 1},
    {0, 0, 2}};
const std::set<Voxel> kOccupiedInScene = {{4, 0, 0}, {4, 1, 0}, {0, 0, 3}};

TEST(OctreeMap, CellsAlongRaysAreFreeAndTheirEndsOccupied)
{
  OctreeMap map(metreVoxels());
  EXPECT_TRUE(map.isEmpty());
  ASSERT_TRUE(map.insert(scanOf(kScene)));
  EXPECT_FALSE(map.isEmpty());
  expectStates(map, kFreeInScene, kOccupiedInScene);
}

TEST(OctreeMap, OccupiedPrevailsWithinAScan)
{
  OctreeMap map(metreVoxels());
  ASSERT_TRUE(map.insert(scanOf({{2.5F, 0.5F, 0.5F}, {4.5F, 0.5F, 0.5F}})));
  expectStates(map, {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}, {{2, 0, 0}, {4, 0, 0}});
}

TEST(OctreeMap, RaysEndAtTheLargestRangeWithoutAHit)
{
  OctreeMapOptions options = metreVoxels();
  options.max_range = 4;
  OctreeMap map(options);
  ASSERT_TRUE(map.insert(scanOf({{6.5F, 0.5F, 0.5F}})));
  expectStates(map, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {});
  EXPECT_TRUE(map.isEmpty());
}

TEST(OctreeMap, AScanWithoutRaysHasOccupiedCellsOnly)
{
  OctreeMap map(metreVoxels());
  MappedScan scan = scanOf(kScene);
  scan.has_rays = false;
  ASSERT_TRUE(map.insert(scan));
  expectStates(map, {}, kOccupiedInScene);
}

/** \return the log-odds of a probability */
double
logOdds(double probability)
{
  return std::log(probability / (1 - probability));
}

TEST(OctreeMap, ProbabilitiesFollowThePublishedSensorModel)
{
  OctreeMap map(metreVoxels());
  const MappedScan hit = scanOf({{4.5F, 0.5F, 0.5F}}),
                   through = scanOf({{6.5F, 0.5F, 0.5F}});
  const Eigen::Vector3d wall(4.5, 0.5, 0.5);
  EXPECT_EQ(map.probability(wall), 0.5);
  ASSERT_TRUE(map.insert(hit));
  EXPECT_NEAR(map.probability(wall), 0.7, 1e-6);
  ASSERT_TRUE(map.insert(through));
  EXPECT_NEAR(logOdds(map.probability(wall)), logOdds(0.7) + logOdds(0.4), 1e-5);
  EXPECT_EQ(map.state(wall), CellState::kOccupied); // 0.61
  ASSERT_TRUE(map.insert(through));
  ASSERT_TRUE(map.insert(through));
  EXPECT_EQ(map.state(wall), CellState::kFree);
  for (int i = 0; i < 20; ++i)
    ASSERT_TRUE(map.insert(through));
  EXPECT_NEAR(map.probability(wall), 0.12, 1e-5);
  for (int i = 0; i < 20; ++i)
    ASSERT_TRUE(map.insert(hit));
  EXPECT_NEAR(map.probability(wall), 0.97, 1e-5);
}

/** \return the middles of the cubes in a VRML file of bt2vrml */
std::set<Voxel>
voxelsOfVrml(const std::string& text)
{
  std::set<Voxel> voxels;
  const std::string word = "translation ";
  for (std::size_t at = text.find(word); at != std::string::npos;
       at = text.find(word, at + 1)) {
    std::istringstream numbers(text.substr(at + word.size(), 100));
    Eigen::Vector3d middle;
    numbers >> middle.x() >> middle.y() >> middle.z();
    voxels.insert({static_cast<int>(std::floor(middle.x())),
                   static_cast<int>(std::floor(middle.y())),
                   static_cast<int>(std::floor(middle.z()))});
  }
  return voxels;
}

TEST(OctreeMap, ItsFilesAreReadByTheToolsOfOctomap)
{
  if (std::system("command -v bt2vrml convert_octree > /dev/null") != 0)
    GTEST_SKIP() << "no bt2vrml: apt-get install octomap-tools";
  const TempFolder folder;
  OctreeMap map(metreVoxels());
  ASSERT_TRUE(map.insert(scanOf(kScene)));
  map.write(folder / "map.ot");
  map.write(folder / "map.bt");
  const auto succeeds = [&](const std::string& words) {
    return std::system(
               ("cd '" + folder.path().string() + "' && " + words + " > log 2>&1")
                   .c_str()) == 0;
  };
  ASSERT_TRUE(succeeds("bt2vrml map.bt")) << readText(folder / "log");
  EXPECT_EQ(voxelsOfVrml(readText(folder / "map.bt.wrl")), kOccupiedInScene);
  // Probabilities that become occupied or free make the other file.
  ASSERT_TRUE(succeeds("convert_octree map.ot again.bt")) << readText(folder / "log");
  ASSERT_TRUE(succeeds("bt2vrml again.bt"));
  EXPECT_EQ(voxelsOfVrml(readText(folder / "again.bt.wrl")), kOccupiedInScene);
}

TEST(OctreeMap, TooLittleMemoryIsToldAndChangesNothing)
{
  OctreeMapOptions options = metreVoxels();
  options.memory = 100;
  OctreeMap map(options);
  EXPECT_FALSE(map.insert(scanOf(kScene)));
  EXPECT_TRUE(map.isEmpty());
}

TEST(OctreeMap, RefusesWhatBreaksItsRules)
{
  const auto refuses = [](const OctreeMapOptions& options) {
    EXPECT_THROW(OctreeMap{options}, pcl6d::BadArgument);
  };
  for (const double edge : {0.0, -1.0, HUGE_VAL, std::nan("")}) {
    OctreeMapOptions options;
    options.resolution = edge;
    refuses(options);
  }
  OctreeMapOptions options;
  options.max_range = 0;
  refuses(options);
  options = {};
  options.hit = 0.5;
  refuses(options);
  options = {};
  options.miss = 0.5;
  refuses(options);
  options = {};
  options.lowest = 0;
  refuses(options);
  options = {};
  options.highest = 1;
  refuses(options);
  options = {};
  options.resolution = 1e-5; // 65536 voxels are 0.65 m
  OctreeMap map(options);
  EXPECT_THROW(map.insert(scanOf({{4.5F, 0.5F, 0.5F}})), pcl6d::BadArgument);
  EXPECT_THROW(OctreeMap(metreVoxels()).write("map.octree"), pcl6d::BadArgument);
}
} // namespace
