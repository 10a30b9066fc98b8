// SPDX-License-Identifier: BSD-3-Clause
#include "relaxation/graph_slam_run.h"

#include <pcl6d/common/median.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::graph_relaxation {

namespace {
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
  std::vector<double> wants; // how far each link would move its points (rms) [m]
  for (std::size_t l = 0; l < report_of_link_.size(); ++l) {
    const RoundLink& link = round_.links[l];
    const double energy = link.equation.D.dot(link.equation.g);
    wants.push_back(std::sqrt(std::max(0.0, energy) / link.sums.weight));
  }
  const std::vector<double> weights = switch_.weights(wants, trusted_);
  for (std::size_t l = 0; l < report_of_link_.size(); ++l)
    result_.links[report_of_link_[l]].switch_weight = weights[l];
  if (links_alike_ && switch_.settled()) // the error is another one from now on
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
  const double typical = options_.switch_links ? upperMedian(strengths) : 0;
  damping_ = 0;
  for (std::size_t l = 0; l < num_pair_links; ++l) {
    RoundLink& link = round_.links[l];
    const double weight = result_.links[report_of_link_[l]].switch_weight;
    link.factor = weight;
    if (links_alike_)
      link.factor *= typical / strengths[l];
    else if (weight < 1) // what is doubted is not stronger than others
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
    const double weight = result_.links[report_of_link_[l]].switch_weight;
    squares += weight * round_.links[l].sums.residual_sq;
    equations += weight * round_.links[l].sums.equations;
  }
  const double freedom =
      equations - 6 * static_cast<double>(round_.layout.num_unknowns);
  return std::max(squares / std::max(1.0, freedom), round_.least_variance);
}

} // namespace pcl6d::graph_relaxation
