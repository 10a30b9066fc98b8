// SPDX-License-Identifier: BSD-3-Clause
#include "knot_shares.h"

#include <pcl6d/common/median.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/deskew/motion_correction.h>
#include <pcl6d/deskew/motion_icp.h>
#include <pcl6d/registration/icp_options.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <string>

namespace pcl6d {

namespace {
using deskew::KnotShare;
using deskew::knotShare;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr std::size_t kPairsPerBlock = 256;

/** Of a normal distribution: standard deviation over median of absolute values. */
constexpr double kOfMedian = 1.4826;

/** Least points on planes: twice the unknowns of a pose. */
constexpr std::size_t kLeastPairs = 12;

void
requireTimes(const TimedPoints& scan)
{
  require(scan.times.size() == scan.points.size(),
          "number of times",
          scan.times.size(),
          "one per point, " + std::to_string(scan.points.size()));
}

/** A point with its plane. */
struct Pair {
  bool is_used = false;
  double residual = 0;    ///< [m]
  double deviation = 1;   ///< [m] expected of the residual
  Eigen::Vector3d normal; ///< d residual / d position
  Eigen::Vector3d
      turning; ///< d residual / d rotation about the position of the scanner
};

/** The normal equations of a block of points. */
struct Equations {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
};

Equations
sum(const Equations& a, const Equations& b)
{
  return {a.A + b.A, a.b + b.b};
}

/** State of the iteration of a match. */
class Match {
public:
  Match(const SurfaceMap& map,
        const TimedPoints& scan,
        const MotionStart& start,
        const MotionIcpOptions& options)
  : map_(map), scan_(scan), start_(start), options_(options)
  {
    for (const double time : scan.times)
      shares_.push_back(knotShare(start.knots.stamps, time));
    pairs_.resize(scan.points.size());
    scales_.assign(start.knots.poses.size() - 1, 1);
  }

  MotionIcpResult
  run()
  {
    MotionIcpResult result;
    result.knots = start_.knots;
    limit_ = options_.max_distance_start;
    while (result.iterations < options_.max_iterations) {
      ++result.iterations;
      findPairs(result.knots);
      weigh(result);
      if (result.pairs < kLeastPairs)
        return stopped(Status::kTooFewPairs, result);
      Eigen::VectorXd step;
      if (!solve(result.knots, step))
        return stopped(Status::kRankDeficient, result);
      move(step, result.knots);
      if (!step.allFinite())
        return stopped(Status::kDiverged, result);
      const bool is_narrow = limit_ <= narrowest();
      limit_ = std::max(narrowest(), limit_ * options_.distance_decay);
      if (is_narrow && largestMove(step) < options_.epsilon * options_.noise) {
        result.status = Status::kOk;
        return result;
      }
    }
    result.status = Status::kMaxIterations;
    return result;
  }

private:
  MotionIcpResult
  stopped(Status status, MotionIcpResult result) const
  {
    result.status = status;
    result.knots = start_.knots;
    return result;
  }

  void
  findPairs(const Trajectory& knots)
  {
    const MotionCorrection path(knots);
    parallelBlocks(
        pairs_.size(), kPairsPerBlock, options_.num_threads, [&](const Block& block) {
          for (std::size_t i = block.begin; i < block.end; ++i)
            pairs_[i] = pairOf(i, path.poseAt(scan_.times[i]));
        });
  }

  Pair
  pairOf(std::size_t i, const Eigen::Isometry3d& T_world_scanner) const
  {
    Pair pair;
    if (!scan_.points[i].allFinite())
      return pair;
    const Eigen::Vector3d arm =
        T_world_scanner.linear() * scan_.points[i].cast<double>();
    const Eigen::Vector3d place = arm + T_world_scanner.translation();
    const SurfacePlane* plane = map_.planeAt(place);
    if (!plane)
      return pair;
    pair.residual = plane->normal.dot(place - plane->mean);
    pair.is_used = std::abs(pair.residual) <= limitOf(shares_[i].knot);
    pair.deviation = std::sqrt(plane->variance + options_.noise * options_.noise);
    pair.normal = plane->normal;
    pair.turning = arm.cross(plane->normal);
    return pair;
  }

  /** Finds the scale of the residuals, the base of weights and limit: in total, and of each step
   * between knots. Where a scan begins to turn, the following points start farther away than the
   * others, and must not be taken for outliers. */
  void
  weigh(MotionIcpResult& result)
  {
    std::vector<double> sizes, deviations;
    std::vector<std::vector<double>> of_steps(scales_.size());
    for (std::size_t i = 0; i < pairs_.size(); ++i)
      if (pairs_[i].is_used) {
        sizes.push_back(std::abs(pairs_[i].residual) / pairs_[i].deviation);
        of_steps[shares_[i].knot].push_back(sizes.back());
        deviations.push_back(pairs_[i].deviation);
      }
    result.pairs = sizes.size();
    result.deviation = scaleOf(std::move(sizes));
    usual_ = upperMedian(std::move(deviations));
    for (std::size_t k = 0; k < scales_.size(); ++k)
      scales_[k] = of_steps[k].size() < kLeastPairs ? result.deviation
                                                    : scaleOf(std::move(of_steps[k]));
    widest_ = *std::max_element(scales_.begin(), scales_.end());
  }

  /** Never below the expected deviation: an accidentally small median must not exclude
   * the other points. */
  static double
  scaleOf(std::vector<double> sizes)
  {
    return std::max(1.0, kOfMedian * upperMedian(std::move(sizes)));
  }

  double
  limitOf(std::size_t step) const
  {
    return std::max(limit_, options_.max_deviations * scales_[step] * usual_);
  }

  double
  narrowest() const
  {
    return options_.max_deviations * widest_ * usual_;
  }

  std::size_t
  numUnknowns() const
  {
    return 6 * start_.knots.poses.size();
  }

  /** \return false if a motion is not fixed */
  bool
  solve(const Trajectory& knots, Eigen::VectorXd& step) const
  {
    const std::size_t blocks = (pairs_.size() + kPairsPerBlock - 1) / kPairsPerBlock;
    std::vector<Equations> parts(blocks);
    parallelBlocks(pairs_.size(),
                   kPairsPerBlock,
                   options_.num_threads,
                   [&](const Block& block) { parts[block.index] = equations(block); });
    Equations all = mergeTree(std::move(parts), sum);
    addTerms(knots, all);
    const Eigen::LDLT<Eigen::MatrixXd> factor(all.A);
    if (factor.info() != Eigen::Success || !factor.isPositive())
      return false;
    const Eigen::VectorXd pivots = factor.vectorD();
    if (pivots.minCoeff() <= 1e-14 * pivots.maxCoeff()) // lost to rounding
      return false;
    step = factor.solve(all.b);
    return true;
  }

  Equations
  equations(const Block& block) const
  {
    const auto n = static_cast<Eigen::Index>(numUnknowns());
    Equations sums{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const Pair& pair = pairs_[i];
      if (!pair.is_used)
        continue;
      const KnotShare& at = shares_[i];
      const double expected = pair.deviation * scales_[at.knot];
      const double weight = robustWeight(RobustKernel::kGemanMcClure,
                                         std::abs(pair.residual) / expected) /
                            (expected * expected);
      Eigen::Matrix<double, 12, 1> row;
      row << (1 - at.share) * pair.normal, (1 - at.share) * pair.turning,
          at.share * pair.normal, at.share * pair.turning;
      const auto place = static_cast<Eigen::Index>(6 * at.knot);
      sums.A.block<12, 12>(place, place) += weight * row * row.transpose();
      sums.b.segment<12>(place) -= weight * pair.residual * row;
    }
    return sums;
  }

  void
  addTerms(const Trajectory& knots, Equations& sums) const
  {
    const std::size_t num_held = start_.held.poses.size();
    std::vector<Eigen::Isometry3d> world = start_.held.poses;
    world.insert(world.end(), knots.poses.begin(), knots.poses.end());
    for (const ElasticTerm& term : start_.terms) {
      const Vector6 residual = term.residual(world);
      const auto coefficients = term.coefficients();
      const Vector6 weights = term.weights(residual);
      for (std::size_t i = 0; i < 4; ++i) {
        if (term.knots[i] < num_held)
          continue;
        const auto row = static_cast<Eigen::Index>(6 * (term.knots[i] - num_held));
        sums.b.segment<6>(row) -= coefficients[i] * weights.cwiseProduct(residual);
        for (std::size_t j = 0; j < 4; ++j)
          if (term.knots[j] >= num_held)
            sums.A
                .block<6, 6>(row,
                             static_cast<Eigen::Index>(6 * (term.knots[j] - num_held)))
                .diagonal() += coefficients[i] * coefficients[j] * weights;
      }
    }
  }

  static void
  move(const Eigen::VectorXd& step, Trajectory& knots)
  {
    for (std::size_t k = 0; k < knots.poses.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(6 * k);
      Eigen::Isometry3d& pose = knots.poses[k];
      pose.translation() += step.segment<3>(at);
      pose.linear() =
          nearestRotation(rotationFromVector(step.segment<3>(at + 3)) * pose.linear());
    }
  }

  /** \return how far the step moves points a median range away [m] */
  double
  largestMove(const Eigen::VectorXd& step)
  {
    if (range_ == 0) {
      std::vector<double> ranges;
      for (const auto& p : scan_.points)
        if (p.allFinite())
          ranges.push_back(p.norm());
      range_ = upperMedian(std::move(ranges));
    }
    double largest = 0;
    for (Eigen::Index at = 0; at < step.size(); at += 6)
      largest = std::max(largest,
                         step.segment<3>(at).norm() +
                             range_ * step.segment<3>(at + 3).norm());
    return largest;
  }

  const SurfaceMap& map_;
  const TimedPoints& scan_;
  const MotionStart& start_;
  const MotionIcpOptions& options_;
  std::vector<KnotShare> shares_;
  std::vector<Pair> pairs_;
  double limit_ = 0;           ///< [m] of residuals
  std::vector<double> scales_; ///< of residuals over expected deviations, per step
  double widest_ = 1;          ///< the largest of scales_
  double usual_ = 1;           ///< [m] median of the expected deviations
  double range_ = 0;           ///< [m] median
};
} // namespace

void
MotionIcpOptions::validate() const
{
  require(max_iterations > 0, "max_iterations", max_iterations, "> 0");
  require(std::isfinite(noise) && noise > 0, "noise", noise, "finite and > 0");
  require(max_distance_start > 0, "max_distance_start", max_distance_start, "> 0");
  require(distance_decay > 0 && distance_decay < 1,
          "distance_decay",
          distance_decay,
          "in (0, 1)");
  require(max_deviations > 0, "max_deviations", max_deviations, "> 0");
  require(epsilon > 0, "epsilon", epsilon, "> 0");
}

MotionIcpResult
motionIcp(const SurfaceMap& map,
          const TimedPoints& scan,
          const MotionStart& start,
          const MotionIcpOptions& options)
{
  options.validate();
  requireTimes(scan);
  const MotionCorrection check(start.knots); // checks the knots
  const std::size_t all = start.held.poses.size() + start.knots.poses.size();
  for (const ElasticTerm& term : start.terms)
    for (const std::size_t knot : term.knots)
      require(knot < all, "knot of a rule", knot, "< " + std::to_string(all));
  return Match(map, scan, start, options).run();
}

Points
undoMotion(const TimedPoints& scan,
           const Trajectory& knots,
           double time,
           unsigned int num_threads)
{
  requireTimes(scan);
  Points points = scan.points;
  std::vector<double> times = scan.times;
  for (double& t : times)
    t -= time;
  MotionCorrection(knots).correct(points, times, time, num_threads);
  return points;
}

std::vector<Eigen::Vector3d>
worldPoints(const TimedPoints& scan, const Trajectory& knots, unsigned int num_threads)
{
  requireTimes(scan);
  const MotionCorrection path(knots);
  std::vector<Eigen::Vector3d> points(scan.points.size());
  parallelBlocks(points.size(), kPairsPerBlock, num_threads, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i)
      points[i] = path.poseAt(scan.times[i]) * scan.points[i].cast<double>();
  });
  return points;
}

} // namespace pcl6d
