// SPDX-License-Identifier: BSD-3-Clause
#include "icp/correspondence_search.h"
#include "icp/icp_metric.h"
#include "icp/sampled_localizability.h"

#include <pcl6d/common/name_table.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/registration/icp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace pcl6d {
using namespace registration;

namespace {
std::size_t
countFinite(const Points& points)
{
  return std::count_if(
      points.begin(), points.end(), [](const auto& p) { return p.allFinite(); });
}

/** \return the largest coordinate of the source points [m]: about the lever of turns */
double
extentOf(const Points& points)
{
  float largest = 0;
  for (const auto& p : points)
    if (p.allFinite())
      largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest;
}

constexpr double kFloatRounding = 1e-7; ///< of a coordinate, relative
constexpr double kLowerShare = 1e-3;    ///< of an error: less is no progress
constexpr int kStillSteps = 3, kIdleSteps = 20;

class IcpRun {
public:
  IcpRun(const IcpTarget& target,
         const IcpSource& source,
         const IcpOptions& options,
         const IcpHooks& hooks)
  : target_(target)
  , source_(*source.points)
  , o_(options)
  , hooks_(hooks)
  , finder_(target, source, options)
  , problem_(source, options)
  , extent_(extentOf(*source.points))
  , has_foreign_steps_((hooks.find || hooks.reject || hooks.minimise) &&
                       options.translation_epsilon > 0)
  {}

  IcpResult
  run(const Eigen::Isometry3d& guess)
  {
    result_.T_target_source = guess;
    result_.stop = IcpStop::kIterationLimit;
    double limit = std::max(o_.max_distance, o_.max_distance_start);
    for (int i = 1; i <= o_.max_iterations; ++i) {
      result_.iterations = i;
      if (const auto stop = iterate(limit)) {
        result_.stop = *stop;
        break;
      }
      limit = std::max(o_.max_distance, o_.distance_decay * limit);
    }
    result_.status = statusOf(result_.stop);
    if (result_.status == Status::kTooFewPairs || result_.status == Status::kDiverged) {
      result_.T_target_source = guess;
      result_.scale = 1;
    }
    finish();
    return result_;
  }

private:
  /** One step. \return the reason to stop, if any */
  std::optional<IcpStop>
  iterate(double limit)
  {
    findPairs(limit);
    MetricStep step = problem_.step(placement(), finder_.partners());
    if (hooks_.minimise && step.pairs >= 3)
      step.motion = hooks_.minimise(result_.T_target_source, finder_.pairs());
    if (step.pairs < 3 || step.motion.status == Status::kTooFewPairs)
      return IcpStop::kTooFewPairs;
    const Eigen::Isometry3d& motion = step.motion.transform;
    if (step.motion.status == Status::kDiverged || !motion.matrix().allFinite() ||
        hasGrown(step, limit) || !takeScale(step))
      return IcpStop::kDiverged;
    is_unique_ = step.motion.status == Status::kOk;
    result_.T_target_source = exactlyRigid(motion * result_.T_target_source);
    return observe(step, limit);
  }

  Placement
  placement() const
  {
    return {result_.T_target_source, result_.scale};
  }

  /** Scales the source about the centroid of its pairs, before their motion.
   * \return whether the scale is still within its limit */
  bool
  takeScale(const MetricStep& step)
  {
    if (!o_.estimate_scale)
      return true;
    result_.scale *= step.scale;
    Eigen::Isometry3d& T = result_.T_target_source;
    T.translation() = step.centroid + step.scale * (T.translation() - step.centroid);
    return result_.scale <= o_.max_scale && result_.scale >= 1 / o_.max_scale;
  }

  void
  findPairs(double limit)
  {
    const Eigen::Isometry3d& T = result_.T_target_source;
    if (hooks_.find)
      finder_.setPairs(hooks_.find(T, limit));
    else
      finder_.update(placement(),
                     limit,
                     next_motion_,
                     limit > o_.max_distance ? o_.shrinking_stride : 1);
    if (hooks_.reject)
      finder_.setPairs(hooks_.reject(T, finder_.pairs()));
    pairs_found_ = finder_.count();
    problem_.weigh(placement(), finder_.partners());
  }

  /** Whether the error is more than three times its best at this limit, without additional pairs,
   * and above rounding. */
  bool
  hasGrown(const MetricStep& step, double limit)
  {
    if (limit > o_.max_distance)
      return false;
    const double rounding = 0.01 * std::min(o_.max_distance, extent_);
    if (step.residual > 3 * least_residual_ && step.residual > rounding &&
        step.pairs <= pairs_at_least_)
      return true;
    if (step.residual < least_residual_) {
      least_residual_ = step.residual;
      pairs_at_least_ = step.pairs;
    }
    return false;
  }

  /** Calls the observers. \return the reason to stop, if any */
  std::optional<IcpStop>
  observe(const MetricStep& step, double limit)
  {
    IcpIteration seen;
    seen.number = result_.iterations;
    seen.pairs = step.pairs;
    seen.rms = step.rms;
    seen.max_distance = limit;
    // The length of the step is the motion of the points' centroid: independent of the origin,
    // unlike the translation part of the motion.
    seen.translation = (step.motion.transform * step.centroid - step.centroid).norm();
    seen.rotation = rotationAngle(step.motion.transform.linear());
    seen.searched = finder_.searches().all;
    seen.from_leaf = finder_.searches().from_leaf;
    seen.T_target_source = result_.T_target_source;
    seen.scale = result_.scale;
    next_motion_ = likelyMotion(seen);
    if (hooks_.pairs_observer)
      hooks_.pairs_observer(seen, finder_.pairs());
    if (hooks_.observer && !hooks_.observer(seen))
      return IcpStop::kObserver;
    if (limit <= o_.max_distance && isErrorAtRest(step.rms, seen.translation))
      return IcpStop::kAtRest;
    if (limit <= o_.max_distance && seen.translation <= o_.translation_epsilon &&
        seen.rotation <= o_.rotation_epsilon &&
        std::abs(step.scale - 1) <= o_.rotation_epsilon)
      return IcpStop::kAtRest;
    return std::nullopt;
  }

  /** Whether the error no longer changes: by a share below error_epsilon; or, if plugged-in classes
   * choose pairs or steps in float, by no more than float rounding, or without a decrease in many
   * steps shorter than the error, since their pairs may come and go for ever. The rule for
   * plugged-in classes does not apply with an epsilon of 0, which asks for every step. */
  bool
  isErrorAtRest(double rms, double way)
  {
    const double change = std::abs(rms * rms - last_rms_ * last_rms_);
    const bool is_small =
        last_rms_ >= 0 && change < o_.error_epsilon * last_rms_ * last_rms_;
    const bool is_rounding = std::abs(rms - last_rms_) <= kFloatRounding * extent_;
    last_rms_ = rms;
    still_ = is_rounding ? still_ + 1 : 0;
    const bool is_lower = rms < (1 - kLowerShare) * lowest_rms_;
    idle_ = is_lower || way > rms ? 0 : idle_ + 1;
    lowest_rms_ = is_lower ? rms : lowest_rms_;
    return is_small ||
           (has_foreign_steps_ && (still_ >= kStillSteps || idle_ >= kIdleSteps));
  }

  /** \return the expected further motion of points [m]; 0 while too large for remembering
   * neighbours to pay: for speed only */
  double
  likelyMotion(const IcpIteration& last) const
  {
    const double motion = last.translation + last.rotation * extent_;
    return motion > last.rms ? 0 : std::min(4 * motion, last.rms);
  }

  Status
  statusOf(IcpStop stop) const
  {
    switch (stop) {
    case IcpStop::kAtRest:
      return is_unique_ ? Status::kOk : Status::kRankDeficient;
    case IcpStop::kIterationLimit:
    case IcpStop::kObserver:
      return Status::kMaxIterations;
    case IcpStop::kDiverged:
      return Status::kDiverged;
    case IcpStop::kTooFewPairs:
      break;
    }
    return Status::kTooFewPairs;
  }

  /** Rates the final pose. */
  void
  finish()
  {
    next_motion_ = 0;
    findPairs(o_.max_distance);
    const std::size_t finite = countFinite(source_);
    result_.overlap = finite > 0 ? static_cast<double>(pairs_found_) / finite : 0;
    problem_.rate(finder_.partners(), result_);
    result_.localizability = sampledLocalizability(
        target_, source_, placement(), finder_.partners(), o_.metric);
    if (result_.status == Status::kOk && result_.localizability &&
        result_.localizability->openDirections() > 0)
      result_.status = Status::kRankDeficient;
    if (result_.status == Status::kRankDeficient)
      result_.covariance.reset();
  }

  const IcpTarget& target_;
  const Points& source_;
  const IcpOptions& o_;
  const IcpHooks& hooks_;
  CorrespondenceSearch finder_;
  IcpMetric problem_;
  double extent_;
  bool has_foreign_steps_;
  IcpResult result_;
  bool is_unique_ = true; ///< the pairs fixed the last step
  double next_motion_ = 0;
  std::size_t pairs_found_ = 0; ///< before trimming
  double least_residual_ = std::numeric_limits<double>::infinity();
  std::size_t pairs_at_least_ = 0;
  double last_rms_ = -1; ///< [m] of the iteration before; -1: no iteration yet
  double lowest_rms_ = std::numeric_limits<double>::infinity();
  int still_ = 0; ///< iterations without a change of last_rms_
  int idle_ = 0;  ///< iterations without progress
};

void
requireNormals(const Normals* normals, const Points& points, const char* whose)
{
  require(normals && normals->size() == points.size(),
          whose,
          normals ? normals->size() : 0,
          "equal to the number of points for this metric");
}

void
requireUsable(const IcpTarget& target,
              const IcpSource& source,
              const IcpOptions& options,
              const IcpHooks& hooks)
{
  options.validate();
  require(source.points != nullptr, "source points", "null", "given");
  if (options.metric == Metric::kGicp || options.symmetric)
    requireNormals(source.normals, *source.points, "source normals");
  for (const auto& part : target) {
    require(part.points && (part.tree || part.search || hooks.find),
            "target part",
            "null",
            "points with a tree or a search");
    require(part.memory != SearchMemory::kLeaves ||
                (part.tree && !part.search && part.tree->keepsCells()),
            "memory of a target part",
            "kLeaves",
            "from a tree that keeps cells, without another search");
    if (part.normals || options.metric != Metric::kPoint)
      requireNormals(part.normals, *part.points, "target normals");
  }
  require(target.size() == 1 || !(hooks.find || hooks.reject || hooks.minimise),
          "parts of the target",
          target.size(),
          "1 with hooks of pairs");
  require(!options.estimate_scale || !(hooks.find || hooks.reject || hooks.minimise),
          "estimate_scale",
          "true",
          "false with hooks of pairs: hooks see a pose without a scale");
}
} // namespace

const char*
toString(IcpStop stop)
{
  constexpr Named<IcpStop> kStops[] = {{IcpStop::kAtRest, "at rest"},
                                       {IcpStop::kIterationLimit, "iteration limit"},
                                       {IcpStop::kObserver, "observer"},
                                       {IcpStop::kTooFewPairs, "too few pairs"},
                                       {IcpStop::kDiverged, "diverged"}};
  return nameOf(kStops, stop);
}

IcpResult
icp(const IcpTarget& target,
    const IcpSource& source,
    const Eigen::Isometry3d& guess,
    const IcpOptions& options,
    const IcpHooks& hooks)
{
  requireUsable(target, source, options, hooks);
  return IcpRun(target, source, options, hooks).run(guess);
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
  IcpOptions of_points = options;
  of_points.metric = Metric::kPoint;
  of_points.minimiser = minimiser;
  IcpTargetPart part;
  part.tree = &target;
  part.points = &target_points;
  IcpHooks hooks;
  hooks.observer = observer;
  return icp({part}, {&source}, guess, of_points, hooks);
}

} // namespace pcl6d
