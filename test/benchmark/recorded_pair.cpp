// SPDX-License-Identifier: BSD-3-Clause
#include "recorded_pair.h"
#include "support/data_folder.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/io/scan_folder.h>

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
  return pairs;
}

} // namespace pcl6d::benchmarks
