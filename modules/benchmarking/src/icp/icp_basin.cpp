// SPDX-License-Identifier: BSD-3-Clause
#include "icp/icp_best_pose.h"

#include <pcl6d/benchmarking/icp_basin.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <map>
#include <memory>

namespace pcl6d {
using namespace benchmarking;

namespace {
/** \return the processor time of this thread [s] */
double
threadSeconds()
{
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/** \return the largest distance from 0 up to which every run of a line through the grid
 * is correct; empty if the nearest run is not */
class Reach {
public:
  void
  add(double distance, bool correct)
  {
    if (!correct)
      nearest_wrong_ = std::min(nearest_wrong_, distance);
    else
      correct_.push_back(distance);
  }

  std::optional<double>
  value() const
  {
    std::optional<double> farthest;
    for (const double distance : correct_)
      if (distance < nearest_wrong_ && distance >= farthest.value_or(0))
        farthest = distance;
    return farthest;
  }

private:
  std::vector<double> correct_;
  double nearest_wrong_ = std::numeric_limits<double>::infinity();
};

IcpBasinSummary
summaryOf(const std::vector<IcpBasinRun>& runs)
{
  IcpBasinSummary s;
  Reach xy, yaw;
  for (const IcpBasinRun& run : runs) {
    const IcpStart& start = run.start;
    if (start.yaw == 0)
      xy.add(std::sqrt(start.x * start.x + start.y * start.y), run.correct);
    if (start.x == 0 && start.y == 0)
      yaw.add(std::abs(start.yaw), run.correct);
    if (!run.correct)
      continue;
    ++s.correct;
    s.position_rms += run.position_error * run.position_error;
    s.orientation_rms += run.orientation_error * run.orientation_error;
    s.rms += run.rms;
    s.iterations += run.iterations;
    s.seconds += run.seconds;
  }
  s.runs = runs.size();
  s.success = static_cast<double>(s.correct) / static_cast<double>(s.runs);
  s.reach_xy = xy.value();
  s.reach_yaw = yaw.value();
  const auto count = static_cast<double>(std::max<std::size_t>(s.correct, 1));
  s.position_rms = std::sqrt(s.position_rms / count);
  s.orientation_rms = std::sqrt(s.orientation_rms / count);
  for (double* sum : {&s.rms, &s.iterations, &s.seconds})
    *sum /= count;
  return s;
}

class BasinMeasurement {
public:
  BasinMeasurement(const Points& target,
                   const Points& source,
                   const std::vector<IcpVariant>& variants,
                   const IcpBasinOptions& options,
                   const IcpBasinObserver& observer)
  : o_(options)
  , variants_(variants)
  , observer_(observer)
  , starts_(icpStarts(options))
  , source_(source, modelOptions(SearchMethod::kRemembered))
  {
    addTarget(target, SearchMethod::kRemembered);
    for (const IcpVariant& variant : variants)
      addTarget(target, variant.search);
  }

  IcpBasin
  measure(const Eigen::Isometry3d& guess)
  {
    for (const IcpVariant& variant : variants_)
      if (!findBest(variant.metric))
        basin_.best.push_back(bestPose(variant, guess));
    basin_.disagreements = disagreementsOf(basin_.best, o_);
    std::vector<IcpVariant> accepted;
    for (const IcpVariant& variant : variants_)
      if (findBest(variant.metric)->doubt.empty())
        accepted.push_back(variant);
    total_ = accepted.size() * starts_.size();
    for (const IcpVariant& variant : accepted)
      if (!addRow(variant)) {
        basin_.complete = false;
        break;
      }
    return std::move(basin_);
  }

private:
  IcpModel::Options
  modelOptions(SearchMethod search) const
  {
    IcpModel::Options model;
    model.search = search;
    model.normals = std::any_of(variants_.begin(), variants_.end(), [](const auto& v) {
      return v.metric != Metric::kPoint;
    });
    model.neighbours = o_.normal_neighbours;
    model.num_threads = o_.num_threads;
    return model;
  }

  void
  addTarget(const Points& points, SearchMethod search)
  {
    auto& model = targets_[search];
    if (!model)
      model = std::make_unique<const IcpModel>(points, modelOptions(search));
  }

  const IcpBestPose*
  findBest(Metric metric) const
  {
    for (const auto& best : basin_.best)
      if (best.metric == metric)
        return &best;
    return nullptr;
  }

  IcpResult
  match(const IcpVariant& variant,
        const Eigen::Isometry3d& start,
        unsigned int num_threads) const
  {
    IcpOptions options = withVariant(o_.icp, variant);
    options.num_threads = num_threads;
    return icp({targets_.at(variant.search)->part()}, source_.source(), start, options);
  }

  IcpBestPose
  bestPose(IcpVariant variant, const Eigen::Isometry3d& guess) const
  {
    variant.search = SearchMethod::kRemembered;
    IcpBestPose best =
        evaluatedBestPose(variant.metric, match(variant, guess, o_.num_threads), o_);
    if (best.doubt.empty())
      best.doubt = doubtOfReturn(
          best, match(variant, best.result.T_target_source, o_.num_threads), o_);
    return best;
  }

  /** \return false if stopped */
  bool
  addRow(const IcpVariant& variant)
  {
    const IcpBestPose& best = *findBest(variant.metric);
    IcpBasinRow row;
    row.variant = variant;
    row.runs.resize(starts_.size());
    constexpr std::size_t kBatch = 32; // between two calls of the observer
    for (std::size_t begin = 0; begin < starts_.size(); begin += kBatch) {
      const std::size_t count = std::min(kBatch, starts_.size() - begin);
      parallelFor(count, o_.num_threads, [&](std::size_t i) {
        row.runs[begin + i] = runFrom(starts_[begin + i], variant, best);
      });
      done_ += count;
      if (observer_ && !observer_({"matching", done_, total_}))
        return false;
    }
    row.summary = summaryOf(row.runs);
    basin_.rows.push_back(std::move(row));
    return true;
  }

  IcpBasinRun
  runFrom(const IcpStart& start,
          const IcpVariant& variant,
          const IcpBestPose& best) const
  {
    const Eigen::Isometry3d& goal = best.result.T_target_source;
    IcpBasinRun run;
    run.start = start;
    const double before = threadSeconds();
    const IcpResult result = match(variant, perturbed(goal, start), 1);
    run.seconds = threadSeconds() - before;
    run.stop = result.stop;
    run.iterations = result.iterations;
    run.pairs = result.pairs;
    run.rms = result.rms;
    run.T_target_source = result.T_target_source;
    run.scale = result.scale;
    const MotionSize error = distanceBetween(goal, run.T_target_source);
    run.position_error = error.translation;
    run.orientation_error = error.rotation;
    run.correct = isWithin(o_.sigmas, best, error);
    return run;
  }

  const IcpBasinOptions& o_;
  const std::vector<IcpVariant>& variants_;
  const IcpBasinObserver& observer_;
  const std::vector<IcpStart> starts_;
  const IcpModel source_;
  std::map<SearchMethod, std::unique_ptr<const IcpModel>> targets_;
  IcpBasin basin_;
  std::size_t done_ = 0;
  std::size_t total_ = 0;
};

void
requirePositive(const char* name, double value)
{
  require(std::isfinite(value) && value > 0, name, value, "finite and > 0");
}

void
requireSteps(const char* name, int steps)
{
  require(steps >= 1 && steps % 2 == 1,
          name,
          steps,
          "odd and >= 1: 0 must be among the offsets");
}

void
requireSmall(int steps_xy, int steps_yaw)
{
  constexpr double kMostStarts = 1e5; // they are kept
  const double starts = 1.0 * steps_xy * steps_xy * steps_yaw;
  require(starts <= kMostStarts,
          "steps_xy",
          steps_xy,
          "smaller: at most 100000 starts are allowed");
}
} // namespace

IcpBasin
evaluateIcpBasin(const Points& target,
                 const Points& source,
                 const Eigen::Isometry3d& guess,
                 const std::vector<IcpVariant>& variants,
                 const IcpBasinOptions& options,
                 const IcpBasinObserver& observer)
{
  options.validate();
  require(!variants.empty(), "variants", "none", "one at least");
  for (const IcpVariant& variant : variants)
    withVariant({}, variant); // throws if the minimiser is unknown
  require(isRigid(guess), "guess", "not rigid", "a rigid motion");
  return BasinMeasurement(target, source, variants, options, observer).measure(guess);
}

void
IcpBasinOptions::validate() const
{
  requirePositive("offset_xy", offset_xy);
  require(offset_yaw > 0 && offset_yaw <= M_PI, "offset_yaw", offset_yaw, "in (0, pi]");
  requireSteps("steps_xy", steps_xy);
  requireSteps("steps_yaw", steps_yaw);
  requireSmall(steps_xy, steps_yaw);
  requirePositive("sigmas", sigmas);
  requirePositive("disagreement_sigmas", disagreement_sigmas);
  requirePositive("min_sigma_position", min_sigma_position);
  requirePositive("min_sigma_orientation", min_sigma_orientation);
  requirePositive("sigma_position", sigma_position.value_or(1));
  requirePositive("sigma_orientation", sigma_orientation.value_or(1));
  require(
      min_overlap >= 0 && min_overlap <= 1, "min_overlap", min_overlap, "in [0, 1]");
  require(max_rms_share > 0, "max_rms_share", max_rms_share, "> 0");
  require(normal_neighbours >= 3 && normal_neighbours <= 64,
          "normal_neighbours",
          normal_neighbours,
          "in [3, 64]");
  icp.validate();
}

std::vector<double>
gridValues(double offset, int steps)
{
  std::vector<double> values(static_cast<std::size_t>(steps), 0.0);
  for (int i = 0; i < steps && steps > 1; ++i) // exactly 0 and +-offset
    values[static_cast<std::size_t>(i)] = offset * (2 * i - (steps - 1)) / (steps - 1);
  return values;
}

std::vector<IcpStart>
icpStarts(const IcpBasinOptions& options)
{
  std::vector<IcpStart> starts;
  for (const double yaw : gridValues(options.offset_yaw, options.steps_yaw))
    for (const double y : gridValues(options.offset_xy, options.steps_xy))
      for (const double x : gridValues(options.offset_xy, options.steps_xy))
        starts.push_back({x, y, yaw});
  return starts;
}

Eigen::Isometry3d
perturbed(const Eigen::Isometry3d& best, const IcpStart& start)
{
  Eigen::Isometry3d pose = best;
  pose.linear() = rotationFromEuler({0, 0, start.yaw}) * best.linear();
  pose.translation() += Eigen::Vector3d(start.x, start.y, 0);
  return pose;
}

} // namespace pcl6d
