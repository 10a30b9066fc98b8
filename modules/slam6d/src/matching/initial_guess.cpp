// SPDX-License-Identifier: BSD-3-Clause
#include "matching/initial_guess.h"

#include <pcl6d/registration/feature_alignment.h>
#include <pcl6d/registration/overlap_search.h>

namespace pcl6d::slam6d {

namespace {
/** Number of latest scans tried in turn. The last scan usually sees the same surfaces, unless its
 * view was blocked by a wall. */
constexpr std::size_t kScansTried = 3;

CoarseEstimate
searchFor(const Slam6DOptions& options,
          const RegisteredScan& target,
          const Points& scan,
          const Eigen::Isometry3d& predicted)
{
  if (options.initial_guess == InitialGuess::kOverlap) {
    OverlapSearchOptions search;
    search.num_threads = options.num_threads;
    return searchByOverlap(target.points->points(),
                           scan,
                           target.T_world_scan.inverse() * predicted,
                           search);
  }
  FeatureAlignmentOptions alignment;
  alignment.seed = options.seed;
  alignment.num_threads = options.num_threads;
  return alignByFeatures(target.points->points(), scan, alignment);
}
} // namespace

StartingPose
startingPose(const Slam6DOptions& options,
             const std::vector<RegisteredScan>& placed,
             const Points& scan,
             const Eigen::Isometry3d& predicted,
             bool has_odometry)
{
  StartingPose start{predicted, InitialGuess::kOdometry, {}};
  if (options.initial_guess == InitialGuess::kOdometry)
    return start;
  if (options.initial_guess == InitialGuess::kGlobal) // the prediction is from place
                                                      // recognition
    return {predicted, InitialGuess::kGlobal, {}};
  const std::size_t count = std::min(kScansTried, placed.size());
  Status why = Status::kTooFewPairs;
  for (std::size_t i = 0; i < count; ++i) {
    const RegisteredScan& target = placed[placed.size() - 1 - i];
    const CoarseEstimate found = searchFor(options, target, scan, predicted);
    if (found.status == Status::kOk)
      return {target.T_world_scan * found.T_target_source, options.initial_guess, {}};
    if (found.status == Status::kRankDeficient)
      why = found.status;
  }
  if (options.initial_guess == InitialGuess::kFeatures || !has_odometry) {
    start.rejection = {RejectReason::kNoInitialPose, why};
    start.rejection.text = toString(options.initial_guess);
  }
  return start;
}

} // namespace pcl6d::slam6d
