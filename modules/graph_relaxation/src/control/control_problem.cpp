// SPDX-License-Identifier: BSD-3-Clause
#include "control/control_problem.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/rotation.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace pcl6d::graph_relaxation {

namespace {
/** More steps than the least squares of nearly linear observations take. */
constexpr int kMostSteps = 30;

/** [m, rad] Smaller steps are rounding. */
constexpr double kStepOfRounding = 1e-10;

/** With a smaller redundancy number, an error is not detectable (Foerstner 1987, table 1). */
constexpr double kLeastRedundancy = 0.01;

/** 99.9 % quantiles of chi2, for 1, 2 and 3 degrees of freedom. */
constexpr double kTestLimitSq[] = {10.827566170662733,
                                   13.815510557964274,
                                   16.26623619623813};

/** Noncentrality at which a test of significance 0.1 % has a power of 80 % (Baarda 1968). */
constexpr double kNoncentrality = 17.0746;

void
moveBy(const Vector6& step, Eigen::Isometry3d& T)
{
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = rotationFromVector(step.tail<3>());
  motion.translation() = step.head<3>();
  T = T * motion;
}
} // namespace

double
ControlTest::standardised() const
{
  if (directions == 0)
    return 0;
  return kTestLimit * std::sqrt(statistic / kTestLimitSq[directions - 1]);
}

ControlTest
testOf(const Eigen::Vector3d& vector, const Eigen::Matrix3d& covariance, double scale)
{
  ControlTest test;
  const auto eigen = symmetricEigen<3>(0.5 * (covariance + covariance.transpose()));
  for (int i = 0; i < 3; ++i) {
    if (eigen.values(i) <= kLeastRedundancy * scale)
      continue;
    const double along = eigen.vectors.col(i).dot(vector);
    test.statistic += along * along / eigen.values(i);
    ++test.directions;
  }
  test.detectable = test.directions < 3 ? std::numeric_limits<double>::infinity()
                                        : std::sqrt(kNoncentrality / eigen.values(0));
  return test;
}

Eigen::Matrix<double, 3, 6>
targetJacobian(const Eigen::Isometry3d& T, const Eigen::Vector3d& target)
{
  Eigen::Matrix<double, 3, 6> J;
  J << T.linear(), -T.linear() * skew(target);
  return J;
}

ControlProblem::ControlProblem(PoseGraph map,
                               std::vector<ControlObservation> observations,
                               const ControlOptions& options)
: map_(std::move(map))
, observations_(std::move(observations))
, options_(options)
, system_(0, {})
, right_side_(map_.poses.size())
, column_of_(map_.poses.size(), 0)
{
  findStructure();
}

void
ControlProblem::findStructure()
{
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  const auto add = [&](std::size_t a, std::size_t b) {
    if (a != b)
      pairs.emplace(std::min(a, b), std::max(a, b));
  };
  for (const PoseLink& link : map_.links)
    add(link.from, link.to);
  for (const ControlObservation& a : observations_)
    for (const ControlObservation& b : observations_)
      if (a.point == b.point)
        add(a.vertex, b.vertex);
  couplings_.assign(pairs.begin(), pairs.end());
  system_ = BlockSystem<6>(map_.poses.size(), couplings_);
}

void
ControlProblem::move(const Eigen::Isometry3d& T)
{
  for (Eigen::Isometry3d& pose : map_.poses)
    pose = T * pose;
}

double
ControlProblem::sigmaOf(std::size_t point) const
{
  return options_.points[point].sigma.value_or(options_.control_sigma);
}

std::vector<std::size_t>
ControlProblem::observationsOf(std::size_t point, bool active) const
{
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < observations_.size(); ++k)
    if (observations_[k].point == point && observations_[k].is_active == active)
      found.push_back(k);
  return found;
}

/** \return the weight [1/m^2] of the product of two residuals of a point with this number of
 * residuals: the inverse of target_sigma^2 delta_kl + sigma^2 by Sherman and Morrison */
double
ControlProblem::weightBetween(std::size_t point, std::size_t count, bool same) const
{
  const double target_sq = options_.target_sigma * options_.target_sigma;
  const double point_sq = sigmaOf(point) * sigmaOf(point);
  const double shared = point_sq / (target_sq + static_cast<double>(count) * point_sq);
  return ((same ? 1 : 0) - shared) / target_sq;
}

Eigen::Vector3d
ControlProblem::residual(std::size_t observation) const
{
  const ControlObservation& one = observations_[observation];
  return map_.poses[one.vertex] * one.position - options_.points[one.point].position;
}

/** \param[in] block in row a, column b; its transpose in row b, column a is implied */
void
ControlProblem::addTo(std::size_t a, std::size_t b, const Matrix6& block)
{
  if (a == b) {
    system_.diagonal(a) += block;
    return;
  }
  const auto pair = std::make_pair(std::min(a, b), std::max(a, b));
  const auto found = std::lower_bound(couplings_.begin(), couplings_.end(), pair);
  Matrix6& target =
      system_.coupling(static_cast<std::size_t>(found - couplings_.begin()));
  target += a < b ? block : Matrix6(block.transpose());
}

void
ControlProblem::addLinks()
{
  for (const PoseLink& link : map_.links) {
    const LinkError e = linearizeLink(link, map_.poses[link.from], map_.poses[link.to]);
    const Matrix6 from = e.J_from.transpose() * link.information;
    const Matrix6 to = e.J_to.transpose() * link.information;
    addTo(link.from, link.from, from * e.J_from);
    addTo(link.to, link.to, to * e.J_to);
    addTo(link.from, link.to, from * e.J_to);
    right_side_[link.from] -= from * e.error;
    right_side_[link.to] -= to * e.error;
  }
}

void
ControlProblem::addPoints()
{
  for (std::size_t point = 0; point < options_.points.size(); ++point) {
    const auto active = observationsOf(point, true);
    for (const std::size_t k : active) {
      const ControlObservation& a = observations_[k];
      const auto J_a = targetJacobian(map_.poses[a.vertex], a.position);
      Eigen::Vector3d weighted = Eigen::Vector3d::Zero();
      for (const std::size_t l : active) {
        const ControlObservation& b = observations_[l];
        const double weight = weightBetween(point, active.size(), k == l);
        weighted += weight * residual(l);
        if (l < k)
          continue; // with (l, k)
        const auto J_b = targetJacobian(map_.poses[b.vertex], b.position);
        addTo(a.vertex, b.vertex, weight * J_a.transpose() * J_b);
      }
      right_side_[a.vertex] -= J_a.transpose() * weighted;
    }
  }
}

void
ControlProblem::build()
{
  system_.setZero();
  for (Vector6& b : right_side_)
    b.setZero();
  addLinks();
  addPoints();
}

bool
ControlProblem::adjust()
{
  for (int i = 0; i < kMostSteps; ++i) {
    build();
    if (!system_.factorize(0, options_.num_threads))
      return false;
    const auto step = system_.solve(right_side_);
    double largest = 0;
    for (std::size_t v = 0; v < step.size(); ++v) {
      if (!step[v].allFinite())
        return false;
      moveBy(step[v], map_.poses[v]);
      largest = std::max(largest, step[v].cwiseAbs().maxCoeff());
    }
    if (largest < kStepOfRounding)
      break;
  }
  findCovariances();
  return dense_.allFinite();
}

/** Column by column, for the poses with observations. */
void
ControlProblem::findCovariances()
{
  std::set<std::size_t> vertices;
  for (const ControlObservation& one : observations_)
    vertices.insert(one.vertex);
  std::size_t column = 0;
  for (const std::size_t v : vertices)
    column_of_[v] = 6 * column++;
  const auto size = static_cast<Eigen::Index>(6 * vertices.size());
  dense_.resize(size, size);
  std::vector<Vector6> unit(map_.poses.size(), Vector6::Zero());
  for (const std::size_t v : vertices)
    for (int i = 0; i < 6; ++i) {
      unit[v](i) = 1;
      const auto solution = system_.solve(unit);
      unit[v](i) = 0;
      for (const std::size_t w : vertices)
        dense_.block<6, 1>(static_cast<Eigen::Index>(column_of_[w]),
                           static_cast<Eigen::Index>(column_of_[v]) + i) = solution[w];
    }
}

/** \return [m^2] covariance of T target of two observations, from the covariance of the poses */
Eigen::Matrix3d
ControlProblem::poseCovariance(std::size_t k, std::size_t l) const
{
  const ControlObservation& a = observations_[k];
  const ControlObservation& b = observations_[l];
  return targetJacobian(map_.poses[a.vertex], a.position) *
         dense_.block<6, 6>(static_cast<Eigen::Index>(column_of_[a.vertex]),
                            static_cast<Eigen::Index>(column_of_[b.vertex])) *
         targetJacobian(map_.poses[b.vertex], b.position).transpose();
}

ControlTest
ControlProblem::test(std::size_t point, std::optional<std::size_t> only) const
{
  const auto active = observationsOf(point, true);
  const double target_sq = options_.target_sigma * options_.target_sigma;
  const double point_sq = sigmaOf(point) * sigmaOf(point);
  std::vector<double> weights;
  double total = 0;
  for (const std::size_t k : active) {
    double weight = 0;
    for (const std::size_t l : active)
      if (!only || *only == l)
        weight += weightBetween(point, active.size(), k == l);
    weights.push_back(weight);
    total += !only || *only == k ? weight : 0;
  }
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < active.size(); ++i) {
    vector += weights[i] * residual(active[i]);
    for (std::size_t j = 0; j < active.size(); ++j)
      covariance +=
          weights[i] * weights[j] *
          (((i == j ? target_sq : 0) + point_sq) * Eigen::Matrix3d::Identity() -
           poseCovariance(active[i], active[j]));
  }
  return testOf(vector, covariance, total);
}

ControlTest
ControlProblem::predict(const std::vector<std::size_t>& observations) const
{
  const auto count = static_cast<double>(observations.size());
  const double target_sq = options_.target_sigma * options_.target_sigma;
  const double sigma = sigmaOf(observations_[observations.front()].point);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance =
      (target_sq / count + sigma * sigma) * Eigen::Matrix3d::Identity();
  for (const std::size_t k : observations) {
    mean += residual(k) / count;
    for (const std::size_t l : observations)
      covariance += poseCovariance(k, l) / (count * count);
  }
  ControlTest test = testOf(mean, covariance, 0);
  // The full error is observed, not a share.
  test.detectable = std::sqrt(kNoncentrality * symmetricEigenvalues<3>(covariance)(2));
  return test;
}

double
ControlProblem::varianceFactor() const
{
  double sum = 0;
  std::size_t count = 6 * map_.links.size();
  for (const PoseLink& link : map_.links) {
    const Vector6 e = linkError(link, map_.poses[link.from], map_.poses[link.to]);
    sum += e.dot(link.information * e);
  }
  for (std::size_t point = 0; point < options_.points.size(); ++point) {
    const auto active = observationsOf(point, true);
    count += 3 * active.size();
    for (const std::size_t k : active)
      for (const std::size_t l : active)
        sum +=
            weightBetween(point, active.size(), k == l) * residual(k).dot(residual(l));
  }
  const std::size_t unknowns = 6 * map_.poses.size();
  return count > unknowns ? sum / static_cast<double>(count - unknowns) : 0;
}

} // namespace pcl6d::graph_relaxation
