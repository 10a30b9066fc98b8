// SPDX-License-Identifier: BSD-3-Clause
#include "relaxation/pose_graph_problem.h"

#include <pcl6d/common/components.h>
#include <pcl6d/common/parallel.h>

#include <algorithm>
#include <numeric>

namespace pcl6d::graph_relaxation {

namespace {
constexpr std::size_t kLinksOfATask = 256;
// Ridge on the diagonal of a singular system, relative to the mean of the diagonal.
constexpr double kRidge = 1e-9;

std::pair<std::size_t, std::size_t>
ordered(std::size_t a, std::size_t b)
{
  return {std::min(a, b), std::max(a, b)};
}

bool
isInformative(const PoseLink& link)
{
  return (link.information.array() != 0).any();
}
} // namespace

std::vector<GraphPart>
connectedParts(const PoseGraph& graph)
{
  Components components(graph.poses.size());
  for (const auto& link : graph.links)
    if (isInformative(link))
      components.join(link.from, link.to);
  std::vector<GraphPart> parts;
  std::vector<std::size_t> part_of(graph.poses.size());
  for (std::size_t i = 0; i < graph.poses.size(); ++i) {
    const std::size_t first = components.firstOf(i);
    if (first == i) {
      part_of[i] = parts.size();
      parts.emplace_back();
    }
    part_of[i] = part_of[first];
    parts[part_of[i]].poses.push_back(i);
  }
  for (std::size_t k = 0; k < graph.links.size(); ++k)
    if (isInformative(graph.links[k]))
      parts[part_of[graph.links[k].from]].links.push_back(k);
  return parts;
}

PoseGraphProblem::PoseGraphProblem(const PoseGraph& graph,
                                   const GraphPart& part,
                                   const PoseGraphOptions& options)
: part_(part), num_threads_(options.num_threads), system_(0, {})
{
  const auto localOf = [&](std::size_t pose) {
    const auto place = std::lower_bound(part.poses.begin(), part.poses.end(), pose);
    return static_cast<std::size_t>(place - part.poses.begin());
  };
  const auto idOf = [&](std::size_t pose) {
    return graph.ids.empty() ? pose : graph.ids[pose];
  };
  for (const std::size_t k : part.links) {
    const PoseLink& link = graph.links[k];
    const auto [low, high] = ordered(idOf(link.from), idOf(link.to));
    measurements_.emplace_back(link);
    links_.push_back(
        {localOf(link.from), localOf(link.to), options.trust_chain && high == low + 1});
  }
  findStructure();
}

/** Finds the links at each block of the normal equations. */
void
PoseGraphProblem::findStructure()
{
  const std::size_t num_unknowns = numPoses() - 1;
  ends_at_.resize(num_unknowns);
  for (std::size_t k = 0; k < links_.size(); ++k) {
    if (links_[k].from > 0)
      ends_at_[links_[k].from - 1].push_back({k, true});
    if (links_[k].to > 0)
      ends_at_[links_[k].to - 1].push_back({k, false});
    if (links_[k].from > 0 && links_[k].to > 0)
      coupled_links_.push_back(k);
  }
  const auto pairOf = [&](std::size_t k) {
    return ordered(links_[k].from, links_[k].to);
  };
  std::stable_sort(coupled_links_.begin(), coupled_links_.end(), [&](auto a, auto b) {
    return pairOf(a) < pairOf(b);
  });
  BlockSystem<6>::Couplings pairs;
  for (std::size_t i = 0; i < coupled_links_.size(); ++i) {
    const std::size_t k = coupled_links_[i];
    if (i == 0 || pairOf(k) != pairOf(coupled_links_[i - 1])) {
      couplings_.push_back({i, i, links_[k].from});
      pairs.emplace_back(links_[k].from - 1, links_[k].to - 1);
    }
    couplings_.back().last_link = i + 1;
  }
  system_ = BlockSystem<6>(num_unknowns, pairs);
  terms_.resize(links_.size());
  gradient_.resize(num_unknowns);
}

std::vector<double>
PoseGraphProblem::squaredErrors(const Poses& poses) const
{
  std::vector<double> squares(links_.size());
  parallelBlocks(links_.size(), kLinksOfATask, num_threads_, [&](const Block& block) {
    for (std::size_t k = block.begin; k < block.end; ++k) {
      const Vector6 error =
          errorOf(measurements_[k], poses[links_[k].from], poses[links_[k].to]);
      squares[k] = error.dot(measurements_[k].information * error);
    }
  });
  return squares;
}

double
PoseGraphProblem::cost(const std::vector<double>& squared_errors,
                       const RobustCost& robust) const
{
  double sum = 0;
  for (std::size_t k = 0; k < links_.size(); ++k)
    sum += links_[k].trusted ? squared_errors[k] : robust.cost(squared_errors[k]);
  return sum;
}

std::vector<double>
PoseGraphProblem::weights(const std::vector<double>& squared_errors,
                          const RobustCost& robust) const
{
  std::vector<double> result(links_.size());
  for (std::size_t k = 0; k < links_.size(); ++k)
    result[k] = links_[k].trusted ? 1 : robust.weight(squared_errors[k]);
  return result;
}

void
PoseGraphProblem::sumDiagonal(std::size_t unknown)
{
  Matrix6 H = Matrix6::Zero();
  Vector6 g = Vector6::Zero();
  for (const End& end : ends_at_[unknown]) {
    const LinkTerms& terms = terms_[end.link];
    H += end.is_from ? terms.H_from : terms.H_to;
    g += end.is_from ? terms.g_from : terms.g_to;
  }
  system_.diagonal(unknown) = H;
  gradient_[unknown] = g;
}

void
PoseGraphProblem::sumCoupling(std::size_t coupling)
{
  const Coupling& c = couplings_[coupling];
  Matrix6 H = Matrix6::Zero();
  for (std::size_t i = c.first_link; i < c.last_link; ++i) {
    const std::size_t k = coupled_links_[i];
    if (links_[k].from == c.row)
      H += terms_[k].H_from_to;
    else
      H += terms_[k].H_from_to.transpose();
  }
  system_.coupling(coupling) = H;
}

void
PoseGraphProblem::linearize(const Poses& poses, const std::vector<double>& weights)
{
  parallelBlocks(links_.size(), kLinksOfATask, num_threads_, [&](const Block& block) {
    for (std::size_t k = block.begin; k < block.end; ++k) {
      const LinkGeometry geometry(
          measurements_[k], poses[links_[k].from], poses[links_[k].to]);
      computeTerms(measurements_[k], geometry, weights[k], terms_[k]);
    }
  });
  parallelBlocks(ends_at_.size(), kLinksOfATask, num_threads_, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i)
      sumDiagonal(i);
  });
  parallelBlocks(
      couplings_.size(), kLinksOfATask, num_threads_, [&](const Block& block) {
        for (std::size_t i = block.begin; i < block.end; ++i)
          sumCoupling(i);
      });
}

void
PoseGraphProblem::addRidge()
{
  double trace = 0;
  for (std::size_t i = 0; i < gradient_.size(); ++i)
    trace += system_.diagonal(i).trace();
  const double ridge = kRidge * trace / (6.0 * static_cast<double>(gradient_.size()));
  for (std::size_t i = 0; i < gradient_.size(); ++i)
    system_.diagonal(i).diagonal().array() += ridge;
}

bool
PoseGraphProblem::solve(double damping, std::vector<Vector6>& step)
{
  if (!system_.factorize(damping, num_threads_))
    return false;
  step = system_.solve(gradient_);
  for (auto& motion : step) {
    motion = -motion;
    if (!motion.allFinite())
      return false;
  }
  return true;
}

double
PoseGraphProblem::expectedDecrease(const std::vector<Vector6>& step) const
{
  double sum = 0;
  for (std::size_t i = 0; i < step.size(); ++i)
    sum -= gradient_[i].dot(step[i]);
  return sum;
}

} // namespace pcl6d::graph_relaxation
