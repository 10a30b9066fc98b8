// SPDX-License-Identifier: BSD-3-Clause
#include "control/control_problem.h"
#include "control/control_start.h"

#include <pcl6d/common/components.h>
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/error.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace pcl6d {
using namespace graph_relaxation;

namespace {
/** 95 % quantile of the chi2 distribution with 3 degrees of freedom. */
constexpr double kChi2Of95Control = 7.814727903251179;

bool
contains(const std::vector<std::string>& names, const std::string& name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

/** The adjustment with its search for blunders. */
class ControlRun {
public:
  ControlRun(const PoseGraph& map, const ControlOptions& options)
  : map_(map), options_(options)
  {
    findVertices();
    findObservations();
  }

  ControlAdjustment
  run();

private:
  void
  findVertices();
  void
  findObservations();
  PoseGraph
  connectedGraph() const;
  std::vector<ControlObservation>
  observations() const;
  std::string
  adjustRobustly(ControlProblem& problem);
  std::string
  takeOutBlunders(ControlProblem& problem);
  bool
  takeInFitting(ControlProblem& problem) const;
  std::vector<std::size_t>
  activePoints(const ControlProblem& problem) const;
  std::string
  doubtOf(ControlProblem& problem) const;
  void
  describe(ControlProblem& problem, ControlAdjustment& done) const;
  void
  takePoses(const ControlProblem& problem, ControlAdjustment& done) const;

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  const PoseGraph& map_;
  const ControlOptions& options_;
  std::vector<std::size_t> scans_;    ///< of each vertex
  std::vector<std::size_t> vertices_; ///< of each scan, or kNone
  std::vector<std::size_t> points_;   ///< of each target, or kNone
  std::vector<bool> is_check_;        ///< of each point
};

void
ControlRun::findVertices()
{
  Components joined(map_.poses.size());
  for (const PoseLink& link : map_.links)
    if (link.information.diagonal().minCoeff() > 0)
      joined.join(link.from, link.to);
  vertices_.assign(map_.poses.size(), kNone);
  for (std::size_t i = 0; i < map_.poses.size(); ++i)
    if (joined.firstOf(i) == joined.firstOf(0)) {
      vertices_[i] = scans_.size();
      scans_.push_back(i);
    }
}

void
ControlRun::findObservations()
{
  std::map<std::string, std::size_t> places;
  for (std::size_t p = 0; p < options_.points.size(); ++p) {
    const std::string& name = options_.points[p].name;
    places[name] = p;
    is_check_.push_back(contains(options_.checks, name));
  }
  for (const ScanTarget& target : options_.targets) {
    const auto found = places.find(target.name);
    points_.push_back(found == places.end() ? kNone : found->second);
  }
}

PoseGraph
ControlRun::connectedGraph() const
{
  PoseGraph graph;
  for (const std::size_t scan : scans_)
    graph.poses.push_back(map_.poses[scan]);
  for (PoseLink link : map_.links) {
    link.from = vertices_[link.from];
    link.to = vertices_[link.to];
    if (link.from != kNone && link.to != kNone)
      graph.links.push_back(link);
  }
  return graph;
}

std::vector<ControlObservation>
ControlRun::observations() const
{
  std::vector<ControlObservation> all;
  for (std::size_t t = 0; t < options_.targets.size(); ++t) {
    const ScanTarget& target = options_.targets[t];
    if (points_[t] != kNone && vertices_[target.scan] != kNone)
      all.push_back({t, points_[t], vertices_[target.scan], target.position, false});
  }
  return all;
}

std::vector<std::size_t>
ControlRun::activePoints(const ControlProblem& problem) const
{
  std::vector<std::size_t> points;
  for (std::size_t p = 0; p < options_.points.size(); ++p)
    if (!problem.observationsOf(p, true).empty())
      points.push_back(p);
  return points;
}

/** \return why the adjustment failed; empty on success */
std::string
ControlRun::adjustRobustly(ControlProblem& problem)
{
  std::vector<std::size_t> points;
  std::vector<Eigen::Vector3d> measured, known;
  for (std::size_t p = 0; p < options_.points.size(); ++p) {
    const auto seen = problem.observationsOf(p, false);
    if (is_check_[p] || seen.empty())
      continue;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const std::size_t k : seen)
      mean += problem.poses()[problem.observations()[k].vertex] *
              problem.observations()[k].position / static_cast<double>(seen.size());
    points.push_back(p);
    measured.push_back(mean);
    known.push_back(options_.points[p].position);
  }
  if (points.size() < 3)
    return "only " + std::to_string(points.size()) +
           " have a target in a connected scan, but 3 are needed";
  const ControlStart start = startOfControl(measured, known);
  if (start.pairs.empty())
    return "the targets lie on one line";
  problem.move(start.T);
  for (const std::size_t pair : start.pairs)
    for (const std::size_t k : problem.observationsOf(points[pair], false))
      problem.observations()[k].is_active = true;
  do
    if (!problem.adjust())
      return "the control points do not fix the poses";
  while (takeInFitting(problem));
  return takeOutBlunders(problem);
}

/** Points that fit their prediction become constraints.
 * \return whether a point was added */
bool
ControlRun::takeInFitting(ControlProblem& problem) const
{
  std::vector<std::size_t> fitting;
  for (std::size_t p = 0; p < options_.points.size(); ++p) {
    const auto waiting = problem.observationsOf(p, false);
    if (is_check_[p] || waiting.empty() || !problem.observationsOf(p, true).empty())
      continue;
    if (problem.predict(waiting).standardised() < kTestLimit) {
      fitting.insert(fitting.end(), waiting.begin(), waiting.end());
      continue;
    }
    for (const std::size_t k :
         waiting) // where a single target is wrong, the remaining targets fit
      if (problem.predict({k}).standardised() < kTestLimit)
        fitting.push_back(k);
  }
  for (const std::size_t k : fitting)
    problem.observations()[k].is_active = true;
  return !fitting.empty();
}

/** Data snooping: one blunder at a time, the worst first. */
std::string
ControlRun::takeOutBlunders(ControlProblem& problem)
{
  while (true) {
    double worst = kTestLimit;
    std::vector<std::size_t> blunder;
    const auto points = activePoints(problem);
    for (const std::size_t p : points) {
      const auto seen = problem.observationsOf(p, true);
      if (const double w = problem.test(p, {}).standardised(); w > worst) {
        worst = w;
        blunder = seen;
      }
      for (const std::size_t k : seen)
        if (const double w = problem.test(p, k).standardised();
            seen.size() > 1 && w > worst) {
          worst = w;
          blunder = {k};
        }
    }
    if (blunder.empty())
      return "";
    if (points.size() <= 3) {
      const auto most = std::max_element(
          points.begin(), points.end(), [&](std::size_t a, std::size_t b) {
            return problem.test(a, {}).standardised() <
                   problem.test(b, {}).standardised();
          });
      return "no three control points fit the targets; the worst of the last three "
             "is " +
             options_.points[*most].name;
    }
    for (const std::size_t k : blunder)
      problem.observations()[k].is_active = false;
    if (!problem.adjust())
      return "without blunders the control points do not fix the poses";
  }
}

/** \return the points that may be wrong in place of a rejected point: their rejection would
 * explain the residuals of every point about as well; else empty */
std::string
ControlRun::doubtOf(ControlProblem& problem) const
{
  for (std::size_t p = 0; p < options_.points.size(); ++p) {
    const auto rejected = problem.observationsOf(p, false);
    if (is_check_[p] || rejected.empty() || !problem.observationsOf(p, true).empty())
      continue;
    PoseGraph graph = connectedGraph();
    graph.poses = problem.poses();
    ControlProblem with(std::move(graph), problem.observations(), options_);
    for (const std::size_t k : rejected)
      with.observations()[k].is_active = true;
    if (!with.adjust())
      continue;
    const double explained = with.test(p, {}).statistic;
    std::string names = options_.points[p].name;
    for (const std::size_t q : activePoints(with))
      if (q != p && with.test(q, {}).statistic > explained - kTestLimit * kTestLimit)
        names += ", " + options_.points[q].name;
    if (names != options_.points[p].name)
      return "one of the control points " + names +
             " is wrong, but the residuals do not tell which point; measure another "
             "control point";
  }
  return "";
}

/** The residuals of every target with a control point. */
void
ControlRun::describe(ControlProblem& problem, ControlAdjustment& done) const
{
  std::vector<std::size_t> observation_of(options_.targets.size(), kNone);
  for (std::size_t k = 0; k < problem.observations().size(); ++k)
    observation_of[problem.observations()[k].target] = k;
  for (std::size_t t = 0; t < options_.targets.size(); ++t) {
    const std::size_t p = points_[t], k = observation_of[t];
    if (p == kNone)
      continue;
    const ScanTarget& target = options_.targets[t];
    ControlResidual& one = done.result.residuals.emplace_back();
    one.name = target.name;
    one.scan = target.scan;
    one.residual =
        done.poses[target.scan] * target.position - options_.points[p].position;
    one.use = is_check_[p] ? ControlUse::kCheck : ControlUse::kRejected;
    if (k == kNone) {
      one.use = ControlUse::kUnused;
      continue;
    }
    ControlTest test;
    if (problem.observations()[k].is_active) {
      one.use = ControlUse::kControl;
      test = problem.test(p, {});
    }
    else
      test = problem.predict({k});
    one.standardised = test.standardised();
    one.detectable = test.detectable;
  }
}

void
ControlRun::takePoses(const ControlProblem& problem, ControlAdjustment& done) const
{
  for (std::size_t v = 0; v < scans_.size(); ++v)
    done.poses[scans_[v]] = problem.poses()[v];
  Eigen::Isometry3d change = done.poses[0] * map_.poses[0].inverse();
  done.result.T_control_initial = change;
  for (std::size_t i = 0; i < done.poses.size(); ++i)
    if (vertices_[i] != kNone)
      change = done.poses[i] * map_.poses[i].inverse();
    else
      done.poses[i] = change * map_.poses[i];
  for (const PoseLink& link : map_.links) {
    const auto apart =
        [&](const std::vector<Eigen::Isometry3d>& poses) -> Eigen::Vector3d {
      return (poses[link.from].inverse() * poses[link.to]).translation();
    };
    done.result.largest_change = std::max(
        done.result.largest_change, (apart(done.poses) - apart(map_.poses)).norm());
  }
  const double factor = std::max(1.0, done.result.variance_factor);
  const auto covariances = problem.covariances();
  for (std::size_t v = 0; v < scans_.size(); ++v) {
    const Matrix6 covariance = factor * covariances[v];
    const auto axes = symmetricEigenvalues<3>(covariance.topLeftCorner<3, 3>());
    done.covariances[scans_[v]] = covariance;
    done.result.bounds[scans_[v]] =
        std::sqrt(kChi2Of95Control * std::max(0.0, axes(2)));
  }
}

ControlAdjustment
ControlRun::run()
{
  ControlAdjustment done;
  done.poses = map_.poses;
  done.covariances.resize(map_.poses.size());
  done.result.bounds.resize(map_.poses.size());
  for (std::size_t t = 0; t < points_.size(); ++t)
    if (const std::string& name = options_.targets[t].name;
        points_[t] == kNone && !contains(done.result.without_control, name))
      done.result.without_control.push_back(name);
  for (std::size_t p = 0; p < options_.points.size(); ++p)
    if (std::find(points_.begin(), points_.end(), p) == points_.end())
      done.result.without_target.push_back(options_.points[p].name);
  ControlProblem problem(connectedGraph(), observations(), options_);
  const std::string failure = adjustRobustly(problem);
  if (!failure.empty()) {
    done.result.reason = failure;
    return done;
  }
  done.result.adjusted = true;
  done.result.variance_factor = problem.varianceFactor();
  takePoses(problem, done);
  describe(problem, done);
  done.result.doubt = doubtOf(problem);
  return done;
}
} // namespace

ControlAdjustment
adjustToControl(const PoseGraph& map, const ControlOptions& options)
{
  checkPoseGraph(map);
  options.validate(map.poses.size());
  if (options.points.empty())
    throw BadArgument("no control points are given");
  return ControlRun(map, options).run();
}

} // namespace pcl6d
