// SPDX-License-Identifier: BSD-3-Clause
#include "drive/descriptor_tree.h"

#include <pcl6d/common/median.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/global_registration/drive_loops.h>
#include <pcl6d/global_registration/place_search.h>
#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

namespace pcl6d {
using namespace global_registration;

namespace {
/** Standard deviations of a step of the drive per metre of way, for its share of the drift.
 * Only their ratio matters, as loops are far more accurate. */
constexpr double kDriftOfWay = 0.01; ///< [m/m]
constexpr double kTurnOfWay = 0.005; ///< [rad/m]

/** [m] Least way of a step: even a scanner at rest drifts in heading. */
constexpr double kLeastWay = 0.1;

/** Least way of a loop, in units of the distance within which poses find loops. */
constexpr double kLeastLoop = 4;

/** Two pairs of scans belong to one loop if both scans are this near in the drive. */
constexpr std::size_t kSameLoop = 4;

/** \return [m] along the drive to each pose */
std::vector<double>
wayTo(const std::vector<Eigen::Isometry3d>& poses)
{
  std::vector<double> way(poses.size());
  for (std::size_t i = 1; i < poses.size(); ++i)
    way[i] = way[i - 1] + (poses[i].translation() - poses[i - 1].translation()).norm();
  return way;
}

/** \return [m] median over the scans of the median distance of their surfaces */
double
reachOf(const std::deque<PlaceableScan>& scans)
{
  std::vector<double> medians;
  for (const PlaceableScan& scan : scans) {
    std::vector<double> ranges;
    for (const auto& point : scan.evaluated().points)
      ranges.push_back(point.cast<double>().norm());
    if (!ranges.empty())
      medians.push_back(upperMedian(ranges));
  }
  return medians.empty() ? 0 : upperMedian(medians);
}

/** Pairs of scans that may be loops hidden by drift. */
class LoopRule {
public:
  /** \param[in] reach [m] median range of the scans */
  LoopRule(const std::vector<Eigen::Isometry3d>& poses,
           double reach,
           const DriveLoopOptions& options)
  : way_(wayTo(poses)), max_drift_(options.max_drift)
  {
    std::vector<double> steps;
    for (std::size_t i = 1; i < way_.size(); ++i)
      steps.push_back(way_[i] - way_[i - 1]);
    constexpr double kSteps = 4; // as detectLoops()
    near_ = options.near.value_or(
        std::max(reach / 2, steps.empty() ? 0 : kSteps * upperMedian(steps)));
  }

  bool
  isPossible(const std::vector<Eigen::Isometry3d>& poses,
             std::size_t a,
             std::size_t b) const
  {
    const double between = std::abs(way_[a] - way_[b]);
    const double apart = (poses[a].translation() - poses[b].translation()).norm();
    return apart > near_ && apart <= max_drift_ * between + near_ &&
           between > kLeastLoop * near_;
  }

  /** \return [m] along the drive to a pose */
  double
  way(std::size_t i) const
  {
    return way_[i];
  }

private:
  std::vector<double> way_;
  double max_drift_;
  double near_ = 0; ///< [m]
};

/** Two scans with similar descriptors. */
struct AlikePair {
  double difference = 0;
  std::size_t from = 0, to = 0;

  bool
  operator<(const AlikePair& other) const
  {
    return std::tie(difference, from, to) <
           std::tie(other.difference, other.from, other.to);
  }
};

/** The search for loops, and the poses with the loops found. */
class LoopSearch {
public:
  LoopSearch(const std::deque<PlaceableScan>& scans,
             const std::vector<Eigen::Isometry3d>& poses,
             const DriveLoopOptions& options)
  : scans_(scans)
  , tracked_(poses)
  , options_(options)
  , reach_(reachOf(scans))
  , rule_(poses, reach_, options)
  {
    found_.poses = poses;
  }

  DriveLoops
  run()
  {
    std::size_t failures = 0;
    const auto pairs = alikePairs();
    for (std::size_t k = 0; k < pairs.size() && failures < options_.max_failures; ++k) {
      if (options_.progress)
        options_.progress({"closing loops", k + 1, pairs.size()});
      if (!isOpen(pairs[k]))
        continue;
      ++found_.searched;
      const auto T_from_to = place(pairs[k].from, pairs[k].to);
      if (!T_from_to) {
        ++failures;
        failed_.push_back(pairs[k]);
        continue;
      }
      failures = 0;
      add(pairs[k], *T_from_to);
    }
    return std::move(found_);
  }

private:
  std::vector<AlikePair>
  alikePairs() const
  {
    std::vector<PlaceDescriptor> descriptors(scans_.size());
    parallelFor(scans_.size(), options_.num_threads, [&](std::size_t i) {
      descriptors[i] = describePlace(scans_[i], reach_);
    });
    const DescriptorTree tree(descriptors);
    std::vector<AlikePair> pairs;
    for (std::size_t i = 0; i < scans_.size(); ++i)
      for (const auto& [difference, j] :
           tree.nearest(i, options_.candidates, [&](std::size_t j) {
             return j < i && rule_.isPossible(found_.poses, j, i);
           }))
        pairs.push_back({difference, j, i});
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  /** \return whether there is no loop and no failed search between scans near both */
  bool
  isOpen(const AlikePair& pair) const
  {
    const auto isBeside = [&pair](std::size_t from, std::size_t to) {
      const auto apart = [](std::size_t a, std::size_t b) {
        return std::max(a, b) - std::min(a, b);
      };
      return apart(from, pair.from) <= kSameLoop && apart(to, pair.to) <= kSameLoop;
    };
    for (const DriveLoop& loop : found_.loops)
      if (isBeside(loop.from, loop.to))
        return false;
    for (const AlikePair& failed : failed_)
      if (isBeside(failed.from, failed.to))
        return false;
    return rule_.isPossible(found_.poses, pair.from, pair.to);
  }

  /** \return the relative pose of two scans, if unique and confirmed by a neighbour of the drive */
  std::optional<Eigen::Isometry3d>
  place(std::size_t from, std::size_t to) const
  {
    PlaceSearchOptions search = PlaceSearchOptions::forTwoScans();
    search.num_threads = options_.num_threads;
    search.any_axis = false; // a vehicle stays upright
    const PlaceResult found = placeScan(scans_[from], scans_[to], search);
    if (found.answer != PlaceAnswer::kUnique)
      return std::nullopt;
    const Eigen::Isometry3d& T = found.candidates.front().T_first_second;
    for (const std::size_t beside : {to + 1, to - 1})
      if (beside < scans_.size() && beside != from && fits(from, to, beside, T))
        return refinePlace(scans_[from], scans_[to], T, options_.num_threads);
    return std::nullopt;
  }

  bool
  fits(std::size_t from,
       std::size_t to,
       std::size_t beside,
       const Eigen::Isometry3d& T_from_to) const
  {
    const Eigen::Isometry3d T = T_from_to * (tracked_[to].inverse() * tracked_[beside]);
    const PlaceCandidate there = evaluatePlace(scans_[from], scans_[beside], T);
    return there.test_result.trust == LinkTrust::kGood &&
           (there.T_first_second.translation() - T.translation()).norm() <
               2 * scans_[from].cell();
  }

  void
  add(const AlikePair& pair, const Eigen::Isometry3d& T_from_to)
  {
    const Eigen::Isometry3d by_loop = found_.poses[pair.from] * T_from_to;
    found_.loops.push_back(
        {pair.from,
         pair.to,
         T_from_to,
         (by_loop.translation() - found_.poses[pair.to].translation()).norm(),
         true});
    relax();
  }

  static Eigen::Matrix<double, 6, 6>
  informationOf(double translation, double rotation)
  {
    Eigen::Matrix<double, 6, 1> diagonal;
    diagonal << Eigen::Vector3d::Constant(1 / (translation * translation)),
        Eigen::Vector3d::Constant(1 / (rotation * rotation));
    return diagonal.asDiagonal();
  }

  /** Optimises the poses over the tracked drive and every loop. */
  void
  relax()
  {
    PoseGraph graph;
    graph.poses = found_.poses;
    for (std::size_t i = 1; i < tracked_.size(); ++i) {
      const double step = std::max(rule_.way(i) - rule_.way(i - 1), kLeastWay);
      graph.links.push_back(
          {i - 1,
           i,
           tracked_[i - 1].inverse() * tracked_[i],
           informationOf(kDriftOfWay * std::sqrt(step), kTurnOfWay * std::sqrt(step))});
    }
    const std::size_t num_steps = graph.links.size();
    for (const DriveLoop& loop : found_.loops) {
      const double cell = scans_[loop.from].cell();
      graph.links.push_back(
          {loop.from, loop.to, loop.T_from_to, informationOf(cell, cell / reach_)});
    }
    PoseGraphOptions options;
    options.graduated = true;
    options.trust_chain = true;
    options.num_threads = options_.num_threads;
    PoseGraphOptimizer optimizer(graph, options);
    const PoseGraphResult& result = optimizer.optimize();
    if (result.status == Status::kDiverged)
      return;
    found_.poses = result.poses;
    for (std::size_t k = 0; k < found_.loops.size(); ++k)
      found_.loops[k].counts = result.weights[num_steps + k] > 0.5;
  }

  const std::deque<PlaceableScan>& scans_;
  const std::vector<Eigen::Isometry3d>& tracked_;
  const DriveLoopOptions& options_;
  const double reach_; ///< [m]
  const LoopRule rule_;
  std::vector<AlikePair> failed_;
  DriveLoops found_;
};
} // namespace

void
DriveLoopOptions::validate() const
{
  require(max_drift > 0 && max_drift <= 1, "max_drift", max_drift, "in (0, 1]");
  require(candidates > 0, "candidates", candidates, "> 0");
  require(!near || (*near >= 0 && std::isfinite(*near)),
          "near",
          near.value_or(0),
          "finite and >= 0");
  require(max_failures > 0, "max_failures", max_failures, "> 0");
}

DriveLoops
closeDriveLoops(const std::deque<PlaceableScan>& scans,
                const std::vector<Eigen::Isometry3d>& poses,
                const DriveLoopOptions& options)
{
  options.validate();
  require(poses.size() == scans.size(), "poses", poses.size(), "one per scan");
  if (scans.size() < 3)
    return {{}, poses, 0};
  return LoopSearch(scans, poses, options).run();
}

bool
mayHoldDriveLoops(const std::vector<Eigen::Isometry3d>& poses,
                  double reach,
                  const DriveLoopOptions& options)
{
  const LoopRule rule(poses, reach, options);
  for (std::size_t i = 0; i < poses.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (rule.isPossible(poses, j, i))
        return true;
  return false;
}

} // namespace pcl6d
