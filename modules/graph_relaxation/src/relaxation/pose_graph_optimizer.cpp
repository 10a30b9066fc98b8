// SPDX-License-Identifier: BSD-3-Clause
#include "relaxation/levenberg_marquardt.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/information.h>
#include <pcl6d/graph_relaxation/merge_links.h>

#include <algorithm>
#include <optional>

namespace pcl6d {
using namespace graph_relaxation;

namespace {
/** The worse of two states. */
Status
worse(Status a, Status b)
{
  const auto rank = [](Status status) {
    switch (status) {
    case Status::kOk:
      return 0;
    case Status::kRankDeficient:
      return 1;
    case Status::kMaxIterations:
      return 2;
    default:
      return 3;
    }
  };
  return rank(a) < rank(b) ? b : a;
}
} // namespace

struct PoseGraphOptimizer::Impl {
  Impl(PoseGraph input, const PoseGraphOptions& settings)
  : graph(std::move(input)), options(settings)
  {
    options.validate();
    checkPoseGraph(graph);
    for (PoseLink& link : graph.links)
      link.information = semidefinite(link.information);
    MergedLinks merged = mergeLinksWithPlaces(graph);
    merged_place = std::move(merged.place);
    merged_weights.assign(merged.links.size(), 1.0);
    given_parts = connectedParts(graph);
    const PoseGraph solved{graph.poses, std::move(merged.links), graph.ids};
    const std::vector<GraphPart> parts = connectedParts(solved);
    result.poses = graph.poses;
    result.component.resize(graph.poses.size());
    result.weights.assign(graph.links.size(), 1.0);
    for (std::size_t c = 0; c < parts.size(); ++c) {
      problems.emplace_back(solved, parts[c], options);
      for (const std::size_t pose : parts[c].poses)
        result.component[pose] = c;
      GraphComponent component;
      component.fixed_pose = parts[c].poses.front();
      component.num_poses = parts[c].poses.size();
      component.num_links = given_parts[c].links.size();
      result.components.push_back(component);
    }
    sumUp();
  }

  PoseGraphProblem::Poses
  posesOf(std::size_t component) const
  {
    PoseGraphProblem::Poses poses;
    for (const std::size_t pose : problems[component].part().poses)
      poses.emplace_back(result.poses[pose]);
    return poses;
  }

  void
  optimize(std::size_t c)
  {
    const GraphPart& part = problems[c].part();
    GraphComponent& component = result.components[c];
    const bool merges = part.links.size() < given_parts[c].links.size();
    const double given_before = merges ? givenChi2(c) : 0;
    const GraphDescent descent = descend(problems[c], posesOf(c), options);
    component.iterations = descent.iterations;
    component.status = descent.status;
    const bool keeps = descent.status == Status::kDiverged;
    for (std::size_t i = 1; i < part.poses.size() && !keeps; ++i)
      result.poses[part.poses[i]] = descent.poses[i].isometry();
    component.chi2_before = merges ? given_before : descent.chi2_before;
    component.chi2_after = merges ? givenChi2(c) : descent.chi2_after;
    for (std::size_t k = 0; k < part.links.size(); ++k)
      merged_weights[part.links[k]] = descent.weights[k];
    for (const std::size_t k : given_parts[c].links)
      result.weights[k] = merged_weights[merged_place[k]];
  }

  /** \return e^T information e over the given links, at the poses of the result */
  double
  givenChi2(std::size_t c) const
  {
    double sum = 0;
    for (const std::size_t k : given_parts[c].links) {
      const PoseLink& link = graph.links[k];
      const Vector6 error =
          linkError(link, result.poses[link.from], result.poses[link.to]);
      sum += error.dot(link.information * error);
    }
    return sum;
  }

  void
  sumUp()
  {
    result.status = Status::kOk;
    result.chi2_before = result.chi2_after = 0;
    result.iterations = 0;
    for (const auto& component : result.components) {
      result.status = worse(result.status, component.status);
      result.chi2_before += component.chi2_before;
      result.chi2_after += component.chi2_after;
      result.iterations = std::max(result.iterations, component.iterations);
    }
  }

  /** \return the factor of the information of a component's poses */
  BlockSystem<6>&
  factorOf(std::size_t c)
  {
    PoseGraphProblem& problem = problems[c];
    std::vector<double> weights;
    for (const std::size_t link : problem.part().links)
      weights.push_back(merged_weights[link]);
    problem.linearize(posesOf(c), weights);
    if (!problem.system().factorize(0, options.num_threads))
      throw ComputeFailed(
          "no covariance: the links leave a motion of the poses connected with pose " +
          std::to_string(problem.part().poses.front()) + " free");
    return problem.system();
  }

  PoseGraph graph;
  PoseGraphOptions options;
  std::vector<std::size_t> merged_place; ///< per given link: its merged link
  std::vector<double> merged_weights;
  std::vector<GraphPart> given_parts;     ///< per component, with the given links
  std::vector<PoseGraphProblem> problems; ///< one per component, with merged links
  PoseGraphResult result;
};

PoseGraphOptimizer::PoseGraphOptimizer(PoseGraph graph, const PoseGraphOptions& options)
: impl_(std::make_unique<Impl>(std::move(graph), options))
{}

PoseGraphOptimizer::~PoseGraphOptimizer() = default;
PoseGraphOptimizer::PoseGraphOptimizer(PoseGraphOptimizer&&) noexcept = default;
PoseGraphOptimizer&
PoseGraphOptimizer::operator=(PoseGraphOptimizer&&) noexcept = default;

const PoseGraphResult&
PoseGraphOptimizer::optimize()
{
  for (std::size_t c = 0; c < impl_->problems.size(); ++c)
    impl_->optimize(c);
  impl_->sumUp();
  return impl_->result;
}

const PoseGraphResult&
PoseGraphOptimizer::result() const
{
  return impl_->result;
}

std::vector<Matrix6>
PoseGraphOptimizer::marginalCovariances() const
{
  std::vector<Matrix6> covariances(impl_->result.poses.size(), Matrix6::Zero());
  for (std::size_t c = 0; c < impl_->problems.size(); ++c) {
    const auto& poses = impl_->problems[c].part().poses;
    const std::vector<Matrix6> blocks = impl_->factorOf(c).inverseDiagonals();
    for (std::size_t i = 1; i < poses.size(); ++i)
      covariances[poses[i]] = blocks[i - 1];
  }
  return covariances;
}

Matrix6
PoseGraphOptimizer::relativeCovariance(std::size_t a, std::size_t b) const
{
  const PoseGraphResult& result = impl_->result;
  if (std::max(a, b) >= result.poses.size())
    throw BadArgument("there is no pose " + std::to_string(std::max(a, b)) +
                      ", but only " + std::to_string(result.poses.size()));
  const std::size_t component = result.component[a];
  if (component != result.component[b])
    throw BadArgument("poses " + std::to_string(a) + " and " + std::to_string(b) +
                      " are not connected");
  const BlockSystem<6>& factor = impl_->factorOf(component);
  const auto& poses = impl_->problems[component].part().poses;
  const auto placeOf = [&](std::size_t pose) { // 0 is the fixed one
    return static_cast<std::size_t>(std::lower_bound(poses.begin(), poses.end(), pose) -
                                    poses.begin());
  };
  // T_a^-1 T_b moves by J d with J = -Ad at a and I at b: its covariance is J G^-1 J^T.
  const Matrix6 adjoint = adjointOf(result.poses[b].inverse() * result.poses[a]);
  const std::size_t at_a = placeOf(a), at_b = placeOf(b);
  Matrix6 covariance = Matrix6::Zero();
  for (int column = 0; column < 6 && a != b; ++column) {
    std::vector<Vector6> right(poses.size() - 1, Vector6::Zero());
    if (at_a > 0)
      right[at_a - 1] = -adjoint.transpose().col(column);
    if (at_b > 0)
      right[at_b - 1](column) = 1;
    const std::vector<Vector6> x = factor.solve(right);
    if (at_a > 0)
      covariance.col(column) -= adjoint * x[at_a - 1];
    if (at_b > 0)
      covariance.col(column) += x[at_b - 1];
  }
  return covariance;
}

} // namespace pcl6d
