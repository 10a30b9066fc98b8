// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/registration/icp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace pcl6d {

namespace {
constexpr std::size_t kBlockSize = 1024; // source points; independent of the threads

/** The closest pairs at one pose, and what they add up to. */
class PairFinder {
public:
  PairFinder(const PointTree& target,
             const Points& target_points,
             const Points& source,
             unsigned int num_threads)
  : target_(target)
  , target_points_(target_points)
  , source_(source)
  , num_threads_(num_threads)
  , neighbours_(source.size(), -1)
  , partials_((source.size() + kBlockSize - 1) / kBlockSize)
  {}

  PairSums
  sumsAt(const Eigen::Isometry3d& T_target_source, double max_distance)
  {
    // PCL's "no limit" is the root of the largest double.
    const auto max_sq = static_cast<float>(
        std::min(max_distance * max_distance,
                 static_cast<double>(std::numeric_limits<float>::max())));
    parallelBlocks(source_.size(), kBlockSize, num_threads_, [&](const Block& block) {
      PairAccumulator pairs;
      for (std::size_t i = block.begin; i < block.end; ++i) {
        const Eigen::Vector3d p = T_target_source * source_[i].cast<double>();
        const int last = neighbours_[i];
        const Neighbour found =
            target_.nearest(p.cast<float>(),
                            max_sq,
                            last,
                            last < 0 ? source_[i] : target_points_[last]);
        if (found.index < 0)
          continue;
        neighbours_[i] = found.index;
        pairs.add(p, target_points_[found.index].cast<double>());
      }
      partials_[block.index] = pairs.sums();
    });
    return mergeTree(partials_, &PairSums::merge);
  }

private:
  const PointTree& target_;
  const Points& target_points_;
  const Points& source_;
  unsigned int num_threads_;
  std::vector<int> neighbours_; ///< of the last search: where the next one starts
  std::vector<PairSums> partials_;
};

/** Makes an accumulated motion exactly rigid again, so that rounding does not add up.
 */
Eigen::Isometry3d
rigid(Eigen::Isometry3d T)
{
  T.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
  return T;
}

double
rmsOf(const PairSums& sums, const Eigen::Isometry3d& T)
{
  return sums.count > 0 ? std::sqrt(sums.errorSq(T) / sums.weight) : 0;
}

class IcpRun {
public:
  IcpRun(PairFinder& finder, const IcpOptions& options) : finder_(finder), o_(options)
  {}

  IcpResult
  run(const Eigen::Isometry3d& guess,
      const RigidMinimiser& minimiser,
      const IcpObserver& observer)
  {
    result_.T_target_source = guess;
    double limit = std::max(o_.max_distance, o_.max_distance_start);
    Status stop = Status::kMaxIterations;
    for (int i = 1; i <= o_.max_iterations && stop == Status::kMaxIterations; ++i) {
      stop = iterate(i, limit, minimiser, observer);
      limit = std::max(o_.max_distance, o_.distance_decay * limit);
      if (stopped_)
        break;
    }
    if (stop == Status::kTooFewPairs || stop == Status::kDiverged)
      result_.T_target_source = guess;
    result_.status = stop;
    return result_;
  }

private:
  /** One step. \return kMaxIterations to go on, else the reason to stop */
  Status
  iterate(int number,
          double limit,
          const RigidMinimiser& minimiser,
          const IcpObserver& observer)
  {
    const PairSums sums = finder_.sumsAt(result_.T_target_source, limit);
    result_.iterations = number;
    if (sums.count < 3)
      return Status::kTooFewPairs;
    const RigidEstimate step = minimiser(sums);
    if (step.status == Status::kDiverged || !step.transform.matrix().allFinite())
      return Status::kDiverged;
    if (step.status != Status::kOk)
      return step.status;
    result_.T_target_source = rigid(step.transform * result_.T_target_source);

    IcpIteration seen;
    seen.number = number;
    seen.pairs = sums.count;
    seen.rms = rmsOf(sums, Eigen::Isometry3d::Identity());
    seen.max_distance = limit;
    // The length of the step is that of the points' centroid: it does not depend on
    // where the origin is, as the translation part of the motion would.
    seen.translation = (step.transform * sums.mean_source - sums.mean_source).norm();
    seen.rotation = rotationAngle(step.transform.linear());
    seen.T_target_source = result_.T_target_source;
    if (observer && !observer(seen))
      stopped_ = true;
    const bool at_rest = seen.translation <= o_.translation_epsilon &&
                         seen.rotation <= o_.rotation_epsilon;
    return limit <= o_.max_distance && at_rest ? Status::kOk : Status::kMaxIterations;
  }

  PairFinder& finder_;
  const IcpOptions& o_;
  IcpResult result_;
  bool stopped_ = false;
};
} // namespace

void
IcpOptions::validate() const
{
  require(max_iterations > 0, "max_iterations", max_iterations, "> 0");
  require(max_distance > 0, "max_distance", max_distance, "> 0");
  require(max_distance_start >= 0 && std::isfinite(max_distance_start),
          "max_distance_start",
          max_distance_start,
          "finite and >= 0");
  require(distance_decay > 0 && distance_decay < 1,
          "distance_decay",
          distance_decay,
          "in (0, 1)");
  require(translation_epsilon >= 0, "translation_epsilon", translation_epsilon, ">= 0");
  require(rotation_epsilon >= 0, "rotation_epsilon", rotation_epsilon, ">= 0");
}

IcpResult
icp(const PointTree& target,
    const Points& target_points,
    const Points& source,
    const Eigen::Isometry3d& guess,
    const IcpOptions& options,
    const RigidMinimiser& minimiser,
    const IcpObserver& observer)
{
  options.validate();
  PairFinder finder(target, target_points, source, options.num_threads);
  IcpResult result = IcpRun(finder, options).run(guess, minimiser, observer);

  const PairSums final_pairs =
      finder.sumsAt(result.T_target_source, options.max_distance);
  const auto finite = std::count_if(
      source.begin(), source.end(), [](const auto& p) { return p.allFinite(); });
  result.pairs = final_pairs.count;
  result.rms = rmsOf(final_pairs, Eigen::Isometry3d::Identity());
  result.covariance = poseCovariance(final_pairs, result.T_target_source);
  result.overlap = finite > 0 ? static_cast<double>(result.pairs) / finite : 0;
  return result;
}

} // namespace pcl6d
