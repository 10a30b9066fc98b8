// SPDX-License-Identifier: BSD-3-Clause
#include "recorded_pair.h"
#include "support/data_folder.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/scan_reader.h>

#include <filesystem>
#include <iostream>
#include <limits>
#include <optional>

namespace pcl6d::benchmarks {

namespace {
struct Recipe {
  const char* name;
  const char* folder;
  std::size_t first; ///< scan; the other is the next
  double max_range;  ///< [m] beyond are no-return codes
  double voxel;      ///< [m]
  double gate;       ///< [m]
  std::optional<Eigen::Isometry3d> guess;
};

Points
reduced(const ScanFolder& folder, std::size_t scan, const Recipe& recipe)
{
  ReductionOptions reduction;
  reduction.voxel = recipe.voxel;
  return reducePoints(gateByRange(folder.read(scan).points, 0.2, recipe.max_range),
                      reduction);
}

/** The registration pair of PCL's tests, as it is. */
std::optional<RecordedPair>
bunnies()
{
  const std::filesystem::path folder = test::dataFolder("pcl");
  if (!std::filesystem::exists(folder / "bun0.pcd"))
    return std::nullopt;
  return RecordedPair{"bun0-bun4",
                      readScan(folder / "bun4.pcd").points,
                      readScan(folder / "bun0.pcd").points,
                      Eigen::Isometry3d::Identity(),
                      0.05};
}

/** PCL's scene of a milk carton on a table, thinned, against the whole, from a start that is
 * off by 5 degrees and 3 cm. */
std::optional<RecordedPair>
milkScene()
{
  const std::filesystem::path file = test::dataFolder("pcl") / "milk_color.pcd";
  if (!std::filesystem::exists(file))
    return std::nullopt;
  const Points points = readScan(file).points;
  ReductionOptions reduction;
  reduction.voxel = 0.01;
  return RecordedPair{"milk",
                      points,
                      reducePoints(points, reduction),
                      poseFromEuler({0.02, -0.01, 0.02}, {0.03, 0.06, -0.05}),
                      0.1};
}
} // namespace

std::vector<RecordedPair>
recordedPairs()
{
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Recipe recipes[] = {
      {"kurt3d-000-001", "kurt3d", 0, 32, 0.1, 0.75, std::nullopt},
      {"rooms-1-2",
       "rooms",
       0,
       kInfinity,
       0.05,
       0.5,
       poseFromEuler({1.79387, 0.720047, 0}, {0, 0, 0.6931})},
      {"hku1-30-31", "hku1", 30, kInfinity, 0.2, 1.5, std::nullopt}};
  std::vector<RecordedPair> pairs;
  for (const Recipe& recipe : recipes) {
    const std::filesystem::path path = test::dataFolder(recipe.folder);
    if (!std::filesystem::exists(path)) {
      std::cerr << recipe.name << " is left out: " << path << " not found\n";
      continue;
    }
    const ScanFolder folder(path);
    const std::size_t a = recipe.first, b = a + 1;
    pairs.push_back(
        {recipe.name,
         reduced(folder, a, recipe),
         reduced(folder, b, recipe),
         recipe.guess.value_or(folder.initialPose(a).inverse() * folder.initialPose(b)),
         recipe.gate});
  }
  for (const auto& pair : {bunnies(), milkScene()})
    if (pair)
      pairs.push_back(*pair);
  return pairs;
}

} // namespace pcl6d::benchmarks
