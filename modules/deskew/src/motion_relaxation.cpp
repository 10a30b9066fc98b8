// SPDX-License-Identifier: BSD-3-Clause
#include "surface_pieces.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/deskew/motion_correction.h>
#include <pcl6d/deskew/motion_relaxation.h>
#include <pcl6d/graph_relaxation/block_system.h>
#include <pcl6d/registration/icp_options.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace pcl6d::semi_rigid {

namespace {
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Couplings = BlockSystem<6>::Couplings;

/** Largest bending of a rigid scan, relative to the noise. */
constexpr double kRigid = 1e-3;

/** Standard deviation at the junction of two scans, relative to the noise: the accuracy of a
 * pose, the mean of a hundred planes. */
constexpr double kSlack = 0.1;

/** Rounds end when every knot moves by less than this share of the noise. */
constexpr double kRest = 0.2;

/** Width of the robust weights of links, in standard deviations, in the first round; halved in
 * each round. A scan with a large error comes nearer before its links lose their weight. */
constexpr double kWideStart = 16;

/** Sums of links with equal knots: rows and columns of from, from + 1, to, to + 1. */
struct KnotSums {
  std::array<std::size_t, 4> knots{};
  Eigen::Matrix<double, 24, 24> A = Eigen::Matrix<double, 24, 24>::Zero();
  Eigen::Matrix<double, 24, 1> b = Eigen::Matrix<double, 24, 1>::Zero();
};

/** One relaxation: its state. */
class SemiRigid {
public:
  SemiRigid(const std::vector<MotionScan>& scans,
            const MotionRelaxationOptions& options)
  : scans_(scans), options_(options)
  {
    for (const MotionScan& scan : scans_) {
      first_.push_back(poses_.size());
      const MotionCorrection check(scan.knots); // checks the knots
      poses_.insert(poses_.end(), scan.knots.poses.begin(), scan.knots.poses.end());
    }
    initial_ = poses_;
    addTerms();
  }

  MotionRelaxationResult
  run()
  {
    MotionRelaxationResult result;
    for (const MotionScan& scan : scans_)
      result.knots.push_back(scan.knots);
    while (result.rounds < options_.max_rounds) {
      const auto pieces = piecesOf(scans_, first_, options_);
      const auto links = linksOf(pieces);
      result.links = links.size();
      if (links.empty())
        return result;
      ++result.rounds;
      const bool is_wide = scale_ > 1;
      const double moved = step(pieces, links);
      if (!std::isfinite(moved)) {
        result.status = Status::kDiverged;
        return result;
      }
      result.status = Status::kMaxIterations;
      scale_ = std::max(1.0, scale_ / 2);
      if (moved > kRest * options_.noise || is_wide)
        continue;
      result.status = Status::kOk;
      break;
    }
    for (std::size_t i = 0; i < scans_.size(); ++i)
      result.knots[i] = scans_[i].knots;
    return result;
  }

private:
  void
  addTerms()
  {
    const double slack = kSlack * options_.noise;
    const double turn = slack * options_.hold_rotation / options_.hold_translation;
    for (std::size_t i = 0; i < scans_.size(); ++i) {
      const auto& stamps = scans_[i].knots.stamps;
      const std::size_t last = first_[i] + stamps.size() - 1;
      if (scans_[i].is_rigid)
        for (std::size_t k = first_[i]; k < last; ++k)
          terms_.push_back(rigidTerm(k, k + 1, kRigid * options_.noise));
      else {
        const auto within = elasticTermsWithin(stamps, first_[i], options_.motion);
        terms_.insert(terms_.end(), within.begin(), within.end());
      }
      if (i + 1 == scans_.size() || !isNext(i))
        continue;
      const auto& next = scans_[i + 1].knots.stamps;
      const auto between = elasticTermsBetween({last - 1, stamps[stamps.size() - 2]},
                                               {last, stamps.back()},
                                               {first_[i + 1], next[0]},
                                               {first_[i + 1] + 1, next[1]},
                                               options_.motion,
                                               slack,
                                               turn);
      terms_.insert(terms_.end(), between.begin(), between.end());
    }
  }

  /** \return whether the motion of a scan continues into the next: both move, and the next
   * begins after the middle of this scan */
  bool
  isNext(std::size_t i) const
  {
    const auto& stamps = scans_[i].knots.stamps;
    const double begin = scans_[i + 1].knots.stamps.front();
    return !scans_[i].is_rigid && !scans_[i + 1].is_rigid &&
           begin > (stamps.front() + stamps.back()) / 2;
  }

  /** \return [m] largest step of a knot, rotations by the lever of the hold; not finite without
   * a solution */
  double
  step(const std::vector<SurfacePiece>& pieces, const std::vector<PieceLink>& links)
  {
    const std::vector<std::size_t> groups = groupsOf(pieces, links);
    Couplings couplings = couplingsOf(pieces, links, groups);
    BlockSystem<6> system(poses_.size(), couplings);
    std::vector<Vector6> b(poses_.size(), Vector6::Zero());
    const auto place = [&](std::size_t row, std::size_t column) {
      return static_cast<std::size_t>(std::lower_bound(couplings.begin(),
                                                       couplings.end(),
                                                       std::make_pair(row, column)) -
                                      couplings.begin());
    };
    const auto add = [&](std::size_t row,
                         std::size_t column,
                         const Eigen::Matrix<double, 6, 6>& block) {
      if (row == column)
        system.diagonal(row) += block;
      else if (row < column)
        system.coupling(place(row, column)) += block;
    };
    addLinks(pieces, links, groups, add, b);
    addElastic(add, b);
    addHold(add, b);
    if (!system.factorize(0, options_.num_threads))
      return INFINITY;
    return move(system.solve(b));
  }

  /** \return the first link of each group with equal knots, and the end */
  static std::vector<std::size_t>
  groupsOf(const std::vector<SurfacePiece>& pieces, const std::vector<PieceLink>& links)
  {
    std::vector<std::size_t> begins;
    for (std::size_t k = 0; k < links.size(); ++k)
      if (k == 0 || pieces[links[k].from].knot != pieces[links[k - 1].from].knot ||
          pieces[links[k].to].knot != pieces[links[k - 1].to].knot)
        begins.push_back(k);
    begins.push_back(links.size());
    return begins;
  }

  Couplings
  couplingsOf(const std::vector<SurfacePiece>& pieces,
              const std::vector<PieceLink>& links,
              const std::vector<std::size_t>& groups) const
  {
    std::set<std::pair<std::size_t, std::size_t>> all;
    const auto join = [&](const std::array<std::size_t, 4>& knots) {
      for (const std::size_t i : knots)
        for (const std::size_t j : knots)
          if (i < j)
            all.emplace(i, j);
    };
    for (std::size_t g = 0; g + 1 < groups.size(); ++g) {
      const std::size_t from = pieces[links[groups[g]].from].knot;
      const std::size_t to = pieces[links[groups[g]].to].knot;
      join({from, from + 1, to, to + 1});
    }
    for (const ElasticTerm& term : terms_)
      join(term.knots);
    for (std::size_t k = 1; k < poses_.size(); ++k)
      all.emplace(k - 1, k);
    return {all.begin(), all.end()};
  }

  template <typename Add>
  void
  addLinks(const std::vector<SurfacePiece>& pieces,
           const std::vector<PieceLink>& links,
           const std::vector<std::size_t>& groups,
           const Add& add,
           std::vector<Vector6>& b) const
  {
    constexpr std::size_t kAtATime = 1024; // a few megabytes
    const std::size_t count = groups.size() - 1;
    for (std::size_t begin = 0; begin < count; begin += kAtATime) {
      std::vector<KnotSums> sums(std::min(kAtATime, count - begin));
      parallelFor(sums.size(), options_.num_threads, [&](std::size_t g) {
        for (std::size_t k = groups[begin + g]; k < groups[begin + g + 1]; ++k)
          addLink(pieces[links[k].from], pieces[links[k].to], links[k].share, sums[g]);
      });
      for (const KnotSums& sum : sums)
        for (std::size_t i = 0; i < 4; ++i) {
          const auto row = static_cast<Eigen::Index>(6 * i);
          b[sum.knots[i]] += sum.b.segment<6>(row);
          for (std::size_t j = 0; j < 4; ++j)
            add(sum.knots[i],
                sum.knots[j],
                sum.A.block<6, 6>(row, static_cast<Eigen::Index>(6 * j)));
        }
    }
  }

  void
  addLink(const SurfacePiece& from,
          const SurfacePiece& to,
          double share,
          KnotSums& sum) const
  {
    const double residual = to.height - from.height;
    const double variance = from.variance + to.variance;
    const double weight =
        share / variance *
        robustWeight(RobustKernel::kGemanMcClure,
                     std::abs(residual) / std::sqrt(variance) / scale_);
    Eigen::Matrix<double, 24, 1> row;
    row << -from.row, to.row;
    sum.knots = {from.knot, from.knot + 1, to.knot, to.knot + 1};
    sum.A += weight * row * row.transpose();
    sum.b -= weight * residual * row;
  }

  template <typename Add>
  void
  addElastic(const Add& add, std::vector<Vector6>& b) const
  {
    for (const ElasticTerm& term : terms_) {
      const Vector6 residual = term.residual(poses_);
      const auto coefficients = term.coefficients();
      const Vector6 weights = term.weights(residual);
      for (std::size_t i = 0; i < 4; ++i) {
        b[term.knots[i]] -= coefficients[i] * weights.cwiseProduct(residual);
        for (std::size_t j = 0; j < 4; ++j)
          add(term.knots[i],
              term.knots[j],
              (coefficients[i] * coefficients[j] * weights).asDiagonal());
      }
    }
  }

  /** Fixes the first knot, and weakly each step from knot to knot. */
  template <typename Add>
  void
  addHold(const Add& add, std::vector<Vector6>& b) const
  {
    Vector6 weights;
    weights << Eigen::Vector3d::Constant(
        1 / (options_.hold_translation * options_.hold_translation)),
        Eigen::Vector3d::Constant(1 /
                                  (options_.hold_rotation * options_.hold_rotation));
    add(0, 0, (weights / (kRigid * kRigid)).asDiagonal());
    for (std::size_t k = 1; k < poses_.size(); ++k) {
      ElasticTerm step;
      step.knots = {k - 1, k, k, k};
      step.first = 1;
      const Vector6 off =
          weights.cwiseProduct(step.residual(poses_) - step.residual(initial_));
      b[k] -= off;
      b[k - 1] += off;
      add(k, k, weights.asDiagonal());
      add(k - 1, k - 1, weights.asDiagonal());
      add(k - 1, k, (-weights).asDiagonal());
    }
  }

  double
  move(const std::vector<Vector6>& steps)
  {
    double largest = 0;
    const double lever = options_.hold_translation / options_.hold_rotation;
    for (std::size_t i = 0; i < scans_.size(); ++i)
      for (std::size_t k = 0; k < scans_[i].knots.poses.size(); ++k) {
        const Vector6& by = steps[first_[i] + k];
        Eigen::Isometry3d& pose = scans_[i].knots.poses[k];
        pose.translation() += by.head<3>();
        pose.linear() =
            nearestRotation(rotationFromVector(by.tail<3>()) * pose.linear());
        poses_[first_[i] + k] = pose;
        const double way = by.head<3>().norm() + lever * by.tail<3>().norm();
        largest = std::isfinite(way) ? std::max(largest, way) : INFINITY;
      }
    return largest;
  }

  std::vector<MotionScan> scans_;
  const MotionRelaxationOptions& options_;
  std::vector<std::size_t> first_; ///< number of the first knot of each scan
  std::vector<Eigen::Isometry3d> poses_, initial_;
  std::vector<ElasticTerm> terms_;
  double scale_ = kWideStart; ///< of residuals, in deviations
};
} // namespace
} // namespace pcl6d::semi_rigid

namespace pcl6d {

void
MotionRelaxationOptions::validate() const
{
  map.validate();
  motion.validate();
  require(std::isfinite(noise) && noise > 0, "noise", noise, "finite and > 0");
  require(hold_translation > 0, "hold_translation", hold_translation, "> 0");
  require(hold_rotation > 0, "hold_rotation", hold_rotation, "> 0");
  require(max_rounds > 0, "max_rounds", max_rounds, "> 0");
}

MotionRelaxationResult
relaxMotions(const std::vector<MotionScan>& scans,
             const MotionRelaxationOptions& options)
{
  options.validate();
  for (const MotionScan& scan : scans)
    require(scan.sample.times.size() == scan.sample.points.size(),
            "number of times",
            scan.sample.times.size(),
            "one per point, " + std::to_string(scan.sample.points.size()));
  if (scans.empty())
    return {};
  return semi_rigid::SemiRigid(scans, options).run();
}

} // namespace pcl6d
