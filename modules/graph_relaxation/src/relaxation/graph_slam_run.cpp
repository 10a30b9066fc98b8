// SPDX-License-Identifier: BSD-3-Clause
#include "relaxation/graph_slam_run.h"

#include <pcl6d/common/median.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/pose.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl6d::graph_relaxation {

namespace {
constexpr double kGrowth = 10;        ///< of the squared error, over the best so far
constexpr double kLeastError = 1e-12; ///< [m^2] below, growth is rounding

bool
allFinite(const GraphSlam::Poses& poses)
{
  return std::all_of(poses.begin(), poses.end(), [](const Eigen::Isometry3d& pose) {
    return pose.matrix().allFinite();
  });
}

LinkReport
reportOf(const LinkPairs& pairs, const LinkSums& sums)
{
  LinkReport report;
  report.from = pairs.from;
  report.to = pairs.to;
  report.pairs = sums.count;
  report.rms = sums.rms();
  return report;
}

void
fillReport(const LinkEquation<6>& equation, LinkReport& report)
{
  report.used = true;
  report.open_directions = equation.open_directions;
  report.variance = equation.variance;
  report.centre = equation.centre;
  report.correction = equation.D;
  report.information = equation.K / equation.variance;
}
} // namespace

GraphSlamRun::GraphSlamRun(const GraphSlamOptions& options,
                           const std::vector<PoseLink>& measured,
                           const GraphSlam::Observer& observer)
: options_(options)
, measured_(measured)
, observer_(observer)
, step_(makeRelaxationStep(options.relaxation))
, switch_(options.switch_scale,
          options.least_deviation,
          std::max(1, options.max_iterations / 2))
{
  round_.by_variance = options.weights == LinkWeights::kCovariance;
  round_.least_variance = options.least_deviation * options.least_deviation;
  round_.num_threads = options.num_threads;
}

GraphSlamResult
GraphSlamRun::run(const GraphSlam::Poses& start,
                  const Pairs& pairs_at,
                  const Pairs& last_pairs_at)
{
  round_.poses = start;
  const bool has_last = last_pairs_at && options_.max_iterations > 1;
  const int rounds = options_.max_iterations - (has_last ? 1 : 0);
  const std::vector<LinkPairs>* pairs = &pairs_at(round_.poses);
  bool goes_on = goRound(*pairs, 1);
  for (int iteration = 2; iteration <= rounds && goes_on; ++iteration) {
    pairs = &pairs_at(round_.poses);
    goes_on = goRound(*pairs, iteration);
  }
  if (has_last && (goes_on || result_.converged) && !stopped_) {
    const bool converged = result_.converged;
    const GraphSlam::Poses found = round_.poses;
    pairs = &last_pairs_at(found);
    goRound(*pairs, result_.iterations + 1);
    result_.converged = result_.converged || converged;
    if (std::exchange(failed_, false)) {
      round_.poses = found;
      pairs = &pairs_at(found);
    }
  }
  if (failed_)
    round_.poses = start;
  switch_moves_ = false;
  measure(*pairs);
  result_.status = finish();
  result_.poses = round_.poses;
  result_.component = round_.layout.component;
  result_.rms = std::sqrt(error_);
  return std::move(result_);
}

bool
GraphSlamRun::goRound(const std::vector<LinkPairs>& pairs, int iteration)
{
  measure(pairs);
  if (iteration == 1)
    result_.rms_before = std::sqrt(error_);
  if (round_.links.empty() || hasDiverged())
    return false;
  result_.converged = advance(iteration);
  return !failed_ && !stopped_ && !result_.converged;
}

void
GraphSlamRun::measure(const std::vector<LinkPairs>& pairs)
{
  const std::vector<LinkSums> sums = sumLinks(
      pairs, round_.poses, options_.robust, options_.num_threads, options_.sharing);
  const std::vector<LinkReport> before = std::move(result_.links);
  result_.links.clear();
  round_.links.clear();
  report_of_link_.clear();
  trusted_.clear();
  for (std::size_t l = 0; l < pairs.size(); ++l) {
    result_.links.push_back(reportOf(pairs[l], sums[l]));
    if (!switch_moves_)
      result_.links[l].switch_weight = before[l].switch_weight;
    if (static_cast<double>(sums[l].count) <
        static_cast<double>(options_.min_pairs) * pairs[l].redundancy)
      continue;
    round_.links.push_back({pairs[l].from, pairs[l].to, sums[l], nullptr, {}, 1});
    report_of_link_.push_back(l);
    trusted_.push_back(pairs[l].trusted);
  }
  for (const PoseLink& link : measured_)
    round_.links.push_back({link.from, link.to, {}, &link, {}, 1});
  parallelBlocks(
      round_.links.size(), 64, options_.num_threads, [&](const Block& block) {
        for (std::size_t l = block.begin; l < block.end; ++l) {
          RoundLink& link = round_.links[l];
          link.equation = link.measured
                              ? equationOf<6>(*link.measured,
                                              round_.poses[link.from],
                                              round_.poses[link.to])
                              : equationOf<6>(link.sums, round_.least_variance);
        }
      });
  round_.layout = GraphLayout(round_.poses.size(), round_.links);
  weigh();
}

void
GraphSlamRun::weigh()
{
  for (std::size_t l = 0; l < report_of_link_.size(); ++l)
    fillReport(round_.links[l].equation, result_.links[report_of_link_[l]]);
  if (options_.switch_links && switch_moves_)
    switchLinks();
  setFactors();
  sumUpError();
}

void
GraphSlamRun::switchLinks()
{
  std::vector<double> wants; // rms motion of points demanded by each link [m]
  for (std::size_t l = 0; l < report_of_link_.size(); ++l) {
    const RoundLink& link = round_.links[l];
    const double energy = link.equation.D.dot(link.equation.g);
    wants.push_back(std::sqrt(std::max(0.0, energy) / link.sums.weight));
  }
  const std::vector<double> weights = switch_.weights(wants, trusted_);
  for (std::size_t l = 0; l < report_of_link_.size(); ++l)
    result_.links[report_of_link_[l]].switch_weight = weights[l];
  if (links_alike_ && switch_.settled()) // the error is a new quantity from now on
    best_error_ = std::numeric_limits<double>::infinity();
  links_alike_ = !switch_.settled();
}

double
GraphSlamRun::strengthOf(const RoundLink& link) const
{
  return link.sums.weight / (round_.by_variance ? link.equation.variance : 1);
}

void
GraphSlamRun::setFactors()
{
  const std::size_t num_pair_links = report_of_link_.size();
  std::vector<double> strengths;
  for (std::size_t l = 0; l < num_pair_links; ++l)
    strengths.push_back(strengthOf(round_.links[l]));
  const bool alike = links_alike_ || options_.weights == LinkWeights::kUnit;
  const double typical = alike || options_.switch_links ? upperMedian(strengths) : 0;
  damping_ = 0;
  for (std::size_t l = 0; l < num_pair_links; ++l) {
    RoundLink& link = round_.links[l];
    const double weight = result_.links[report_of_link_[l]].switch_weight;
    link.factor = weight;
    if (alike)
      link.factor *= typical / strengths[l];
    else if (weight < 1) // a doubtful link is no stronger than a typical link
      link.factor *= weight + (1 - weight) * std::min(1.0, typical / strengths[l]);
    if (link.equation.open_directions > 0)
      damping_ = kLeastDamping;
  }
  const double common = round_.by_variance ? 1 : commonVariance();
  for (RoundLink& link : round_.links)
    if (link.measured)
      link.factor = common;
}

void
GraphSlamRun::sumUpError()
{
  double squares = 0, weight = 0, means = 0, links = 0;
  const std::vector<double>& agreement = switch_.agreement();
  for (std::size_t l = 0; l < report_of_link_.size(); ++l) {
    const double factor = l < agreement.size() ? agreement[l] : 1;
    const LinkSums& sums = round_.links[l].sums;
    squares += factor * sums.residual_sq;
    weight += factor * sums.weight;
    means += factor * sums.residual_sq / sums.weight;
    links += factor;
  }
  last_error_ = error_;
  error_ = weight > 0 ? std::max(0.0, squares) / weight : 0;
  link_error_ = links > 0 ? std::max(0.0, means) / links : 0;
}

double
GraphSlamRun::commonVariance() const
{
  double squares = 0, equations = 0;
  for (std::size_t l = 0; l < report_of_link_.size(); ++l) {
    const RoundLink& link = round_.links[l];
    const double weight = options_.weights == LinkWeights::kUnit
                              ? link.factor
                              : result_.links[report_of_link_[l]].switch_weight;
    squares += weight * link.sums.residual_sq;
    equations += weight * link.sums.equations;
  }
  const double freedom =
      equations - 6 * static_cast<double>(round_.layout.num_unknowns);
  return std::max(squares / std::max(1.0, freedom), round_.least_variance);
}

bool
GraphSlamRun::hasDiverged()
{
  const double error = links_alike_ ? link_error_ : error_;
  failed_ =
      !std::isfinite(error) || error > kGrowth * std::max(best_error_, kLeastError);
  best_error_ = std::min(best_error_, error);
  return failed_;
}

bool
GraphSlamRun::advance(int iteration)
{
  const GraphSlam::Poses before = round_.poses;
  if (!step_->advance(round_, damping_)) {
    damping_ = 1e3 * kLeastDamping; // the last resort
    if (!step_->advance(round_, damping_))
      failed_ = true;
  }
  failed_ = failed_ || !allFinite(round_.poses);
  return !failed_ && atRest(before, iteration);
}

bool
GraphSlamRun::atRest(const GraphSlam::Poses& before, int iteration)
{
  MotionSize largest;
  for (std::size_t j = 0; j < before.size(); ++j) {
    const MotionSize size = distanceBetween(before[j], round_.poses[j]);
    largest.translation = std::max(largest.translation, size.translation);
    largest.rotation = std::max(largest.rotation, size.rotation);
  }
  result_.iterations = iteration;
  if (observer_)
    stopped_ = !observer_(
        {iteration, std::sqrt(error_), largest.translation, largest.rotation});
  if (options_.switch_links && !switch_.settled())
    return false;
  const bool no_motion = largest.translation <= options_.translation_epsilon &&
                         largest.rotation <= options_.rotation_epsilon;
  const bool no_change =
      iteration > 1 && options_.error_epsilon > 0 &&
      std::abs(last_error_ - error_) <= options_.error_epsilon * last_error_;
  return no_motion || (no_change && last_error_ > kLeastError);
}

Status
GraphSlamRun::finish()
{
  const std::size_t size = round_.poses.size();
  result_.covariances.assign(size, Eigen::Matrix<double, 6, 6>::Zero());
  result_.open_direction.assign(size, false);
  if (failed_)
    return Status::kDiverged;
  if (round_.links.empty())
    return Status::kTooFewPairs;
  fillCovariances();
  if (!result_.converged)
    return Status::kMaxIterations;
  const auto& open = result_.open_direction; // true for floating poses, too
  const bool held = std::count(open.begin(), open.end(), true) == 0;
  return held ? Status::kOk : Status::kRankDeficient;
}

void
GraphSlamRun::fillCovariances()
{
  const double variance = round_.by_variance ? 1 : commonVariance();
  auto inverses = step_->inverses(round_, damping_);
  if (inverses.empty()) {
    damping_ = 1e3 * kLeastDamping;
    inverses = step_->inverses(round_, damping_);
  }
  // Only directions fixed by the damping scale with the damping.
  const auto damped = damping_ > 0 ? step_->inverses(round_, 10 * damping_) : inverses;
  for (std::size_t j = 0; j < round_.poses.size(); ++j) {
    const std::size_t i = round_.layout.unknown[j];
    const bool floats = round_.layout.component[j] != 0;
    if (i == GraphLayout::kFixed && !floats)
      continue;
    if (floats || inverses.empty() || damped.empty()) {
      result_.open_direction[j] = true;
      continue;
    }
    result_.covariances[j] = variance * inverses[i];
    result_.open_direction[j] = inverses[i].trace() > 2 * damped[i].trace();
  }
}

} // namespace pcl6d::graph_relaxation
