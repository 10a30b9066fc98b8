// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/diagnosis.h"
#include "doctor/report/words.h"

#include <pcl6d/common/voxel_numbers.h>
#include <pcl6d/filters/range_statistics.h>

#include <algorithm>
#include <utility>

namespace pcl6d::app {

namespace {
std::string
call(const char* setter, double value)
{
  return std::string(setter) + "(" + shortNumber(value) + ")";
}

void
adviseOnPoints(const DoctorPair& pair, std::vector<Advice>& advice)
{
  if (pair.of_source.not_finite + pair.of_target.not_finite > 0)
    advice.push_back({"pcl::removeNaNFromPointCloud() on both clouds",
                      std::to_string(pair.of_source.not_finite) + " and " +
                          std::to_string(pair.of_target.not_finite) +
                          " rows without finite x, y, z"});
  for (const auto& [of, role] :
       {std::pair(&pair.of_source, "SOURCE"), std::pair(&pair.of_target, "TARGET")})
    if (of->no_return)
      advice.push_back({"leave out ranges of " +
                            shortNumber(0.999 * *of->no_return, 4) + " m and more of " +
                            role,
                        std::to_string(of->num_no_return) + " points without echo"});
  if (!pair.isFar() || !pair.canBeMatched())
    return;
  advice.push_back(
      {"subtract (" + vectorText(pair.target.offset) + ") from TARGET and (" +
           vectorText(pair.source.offset) + ") from SOURCE, in double",
       "float steps are " +
           metres(std::max(pair.of_source.float_step, pair.of_target.float_step)) +
           " there; afterwards add the offsets to the pose, in double"});
}

/** One point per voxel, if this removes more than half of the points. */
void
adviseOnReduction(const DoctorPair& pair, std::vector<Advice>& advice)
{
  const auto left = [&](const DoctorCloud& cloud) {
    VoxelNumbers voxels;
    for (const auto& p : gateByRange(pair.seen(cloud), 0, pair.reach))
      voxels.add(voxelKey(p, pair.voxel));
    return voxels.size();
  };
  const std::size_t of_source = left(pair.source);
  const std::size_t of_target = left(pair.target);
  constexpr std::size_t kMany = 10000; // fewer take no time
  if (pair.of_source.points + pair.of_target.points < kMany ||
      2 * (of_source + of_target) > pair.of_source.points + pair.of_target.points)
    return;
  advice.push_back({call("setLeafSize", pair.voxel) + " of pcl6d::OctreeReduction",
                    std::to_string(pair.of_source.points) + " and " +
                        std::to_string(pair.of_target.points) + " points become " +
                        std::to_string(of_source) + " and " +
                        std::to_string(of_target) + "; " + pair.voxel_why});
}

/** Largest number of iterations until convergence of a class that uses pairs. */
void
adviseOnIterations(const Diagnosis& d, std::vector<Advice>& advice)
{
  const Experiment* slowest = nullptr;
  int most = 0;
  for (const Experiment& row : d.rows) {
    const ClassOutcome& run =
        row.longer && row.longer->hasPose() ? *row.longer : row.outcome;
    if (isNdt(row.method) || !run.hasPose() || run.at_limit || run.iterations <= most)
      continue;
    const double least = d.rows[*d.best].verdict.fit.misfit;
    if (row.verdict.fit.misfit > 1.1 * least + d.pair.tolerance()) // it went elsewhere
      continue;
    most = run.iterations;
    slowest = &row;
  }
  if (slowest == nullptr || most <= 10) // PCL's limit does
    return;
  advice.push_back({"setMaximumIterations(" + std::to_string(2 * most) + ")",
                    slowest->name() + " came to rest after " + std::to_string(most) +
                        "; doubled for safety"});
}

void
adviseOnClasses(const Diagnosis& d, std::vector<Advice>& advice)
{
  const DoctorPair& pair = d.pair;
  advice.push_back(
      {call("setMaxCorrespondenceDistance", pair.max_distance), pair.max_distance_why});
  adviseOnIterations(d, advice);
  advice.push_back({call("setResolution", pair.resolution) + ", " +
                        call("setStepSize", 0.1 * pair.resolution) + " of NDT",
                    "cells of at least 6 spacings have enough points, and reach up to "
                    "the pair distance"});
}

void
adviseOnStart(const Diagnosis& d, std::vector<Advice>& advice)
{
  const auto place = d.best_of_ours;
  if (!place || d.rows[*place].start_words.empty())
    return;
  advice.push_back(
      {"start from " + d.rows[*place].start_words + "; the guess is below",
       "the best pose was found from there, not from " + d.pair.guess_words});
}

void
adviseOnScanners(const DoctorPair& pair, std::vector<Advice>& advice)
{
  for (const auto& [of, option] : {std::pair(&pair.of_source, "--source-origin"),
                                   std::pair(&pair.of_target, "--target-origin")})
    if (!of->scanner.known)
      advice.push_back(
          {std::string(option) + " \"X Y Z\" of the program",
           "the origin of the coordinates is far outside of the cloud; the position of "
           "the scanner decides the result of the free-space test"});
}
} // namespace

std::vector<Advice>
adviceFor(const Diagnosis& d)
{
  std::vector<Advice> advice;
  adviseOnPoints(d.pair, advice);
  if (!d.pair.canBeMatched())
    return advice;
  adviseOnReduction(d.pair, advice);
  adviseOnStart(d, advice);
  adviseOnClasses(d, advice);
  adviseOnScanners(d.pair, advice);
  return advice;
}

} // namespace pcl6d::app
