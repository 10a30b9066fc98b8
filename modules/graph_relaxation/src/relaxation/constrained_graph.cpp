// SPDX-License-Identifier: BSD-3-Clause
#include "relaxation/extended_graph.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/information.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/graph_relaxation/constrained_graph.h>
#include <pcl6d/graph_relaxation/link_error.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace pcl6d {
using namespace graph_relaxation;

namespace {
/** Rounds of switches and poses; each takes only a few steps, as its start is near the optimum. */
constexpr int kMostRounds = 500;

void
requireConstraint(bool is_right, const std::string& name, const std::string& rule)
{
  if (!is_right)
    throw BadArgument(name + ": " + rule);
}

void
checkSightings(const PoseGraph& graph, const GraphConstraints& c)
{
  std::set<std::size_t> seen;
  for (std::size_t k = 0; k < c.sightings.size(); ++k) {
    const LandmarkSighting& sighting = c.sightings[k];
    const std::string name = "sighting " + std::to_string(k);
    requireConstraint(sighting.pose < graph.poses.size(),
                      name,
                      "the graph has no pose with this index");
    requireConstraint(sighting.landmark < c.landmarks.size(),
                      name,
                      "the graph has no landmark with this index");
    requireConstraint(
        sighting.position.allFinite(), name, "the position is not finite");
    Matrix6 information = Matrix6::Zero();
    information.topLeftCorner<3, 3>() = sighting.information;
    const std::string fault = informationFault(information);
    requireConstraint(fault.empty(), name, "its information is " + fault);
    seen.insert(sighting.landmark);
  }
  for (std::size_t k = 0; k < c.landmarks.size(); ++k) {
    const std::string name = "landmark " + std::to_string(k);
    requireConstraint(c.landmarks[k].allFinite(), name, "the position is not finite");
    requireConstraint(seen.count(k) > 0, name, "no pose sees it");
  }
}

void
checkConstraints(const PoseGraph& graph, const GraphConstraints& c)
{
  for (const std::size_t pose : c.fixed)
    requireConstraint(pose < graph.poses.size(),
                      "fixed pose " + std::to_string(pose),
                      "the graph has no pose with this index");
  for (std::size_t k = 0; k < c.priors.size(); ++k) {
    const std::string name = "prior " + std::to_string(k);
    requireConstraint(c.priors[k].pose < graph.poses.size(),
                      name,
                      "the graph has no pose with this index");
    requireConstraint(isRigid(c.priors[k].T_world_pose), name, "is no rigid motion");
    const std::string fault = informationFault(c.priors[k].information);
    requireConstraint(fault.empty(), name, "its information is " + fault);
  }
  checkSightings(graph, c);
  std::set<std::size_t> switched;
  for (const LinkSwitch& one : c.switches) {
    const std::string name = "switch " + std::to_string(one.id);
    requireConstraint(
        one.link < graph.links.size(), name, "the graph has no link with this index");
    requireConstraint(
        switched.insert(one.link).second, name, "the link has another switch");
    requireConstraint(
        std::isfinite(one.value) && std::isfinite(one.prior), name, "is not finite");
    requireConstraint(std::isfinite(one.information) && one.information > 0,
                      name,
                      "its information must be > 0");
  }
}

double
squareOf(const Vector6& error, const Matrix6& information)
{
  return error.dot(information * error);
}

double
linkSquare(const PoseLink& link, const std::vector<Eigen::Isometry3d>& poses)
{
  return squareOf(linkError(link, poses[link.from], poses[link.to]), link.information);
}

/** \return the sum of squares of the constraints, without links */
double
constraintSquares(const std::vector<Eigen::Isometry3d>& poses,
                  const GraphConstraints& c)
{
  double sum = 0;
  for (const PosePrior& prior : c.priors)
    sum += squareOf(
        linkError(linkOf(prior), Eigen::Isometry3d::Identity(), poses[prior.pose]),
        prior.information);
  for (const LandmarkSighting& sighting : c.sightings) {
    const Eigen::Vector3d error =
        poses[sighting.pose].inverse() * c.landmarks[sighting.landmark] -
        sighting.position;
    sum += error.dot(sighting.information * error);
  }
  for (const LinkSwitch& one : c.switches)
    sum += one.information * std::pow(one.prior - one.value, 2);
  return sum;
}

/** \return chi2 with given poses in place of the graph's poses */
double
chi2At(const std::vector<Eigen::Isometry3d>& poses,
       const PoseGraph& graph,
       const GraphConstraints& c)
{
  std::vector<double> factors(graph.links.size(), 1);
  for (const LinkSwitch& one : c.switches)
    factors[one.link] = one.value * one.value;
  double sum = constraintSquares(poses, c);
  for (std::size_t k = 0; k < graph.links.size(); ++k)
    sum += factors[k] * linkSquare(graph.links[k], poses);
  return sum;
}

/** One round: the poses and landmarks at given switches. */
void
optimizePoses(const PoseGraph& graph,
              const PoseGraphOptions& options,
              ConstrainedGraphResult& result)
{
  const ExtendedGraph extended(graph, result.poses, result.constraints);
  PoseGraphOptimizer optimizer(extended.graph(), options);
  const PoseGraphResult& found = optimizer.optimize();
  result.status = found.status;
  result.iterations += found.iterations;
  result.components = found.components.size();
  result.weights.assign(found.weights.begin(),
                        found.weights.begin() +
                            static_cast<std::ptrdiff_t>(graph.links.size()));
  extended.takeBack(found, result.poses, result.constraints.landmarks);
  for (LinkSwitch& one : result.constraints.switches) {
    result.weights[one.link] *= one.value * one.value;
    const double square = linkSquare(graph.links[one.link], result.poses);
    one.value = one.information * one.prior / (one.information + square);
  }
}
} // namespace

double
chi2Of(const PoseGraph& graph, const GraphConstraints& constraints)
{
  checkPoseGraph(graph);
  checkConstraints(graph, constraints);
  return chi2At(graph.poses, graph, constraints);
}

ConstrainedGraphResult
optimizeConstrained(const PoseGraph& graph,
                    const GraphConstraints& constraints,
                    const PoseGraphOptions& options)
{
  options.validate();
  ConstrainedGraphResult result;
  result.chi2_before = chi2Of(graph, constraints);
  result.poses = graph.poses;
  result.constraints = constraints;
  double before = result.chi2_before;
  for (int round = 0;; ++round) {
    optimizePoses(graph, options, result);
    result.chi2_after = chi2At(result.poses, graph, result.constraints);
    if (constraints.switches.empty() || result.status == Status::kDiverged ||
        before - result.chi2_after <= options.chi2_epsilon * before)
      return result;
    if (round + 1 == kMostRounds) {
      result.status = Status::kMaxIterations;
      return result;
    }
    before = result.chi2_after;
  }
}

} // namespace pcl6d
