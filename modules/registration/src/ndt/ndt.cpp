// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/registration/ndt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace pcl6d {

void
NdtOptions::validate() const
{
  require(step_size > 0, "step_size", step_size, "> 0");
  require(outlier_ratio > 0 && outlier_ratio < 1,
          "outlier_ratio",
          outlier_ratio,
          "in (0, 1)");
  require(max_iterations > 0, "max_iterations", max_iterations, "> 0");
  require(translation_epsilon >= 0, "translation_epsilon", translation_epsilon, ">= 0");
  require(rotation_epsilon >= 0, "rotation_epsilon", rotation_epsilon, ">= 0");
}

namespace {
/** The score of a point at a squared Mahalanobis distance: height exp(-slope / 2 d^2), an
 * approximation of the logarithm of a normal distribution with a level of outliers. */
struct Score {
  /** Magnusson 2009, (6.8) and the constants after it. */
  Score(double outlier_ratio, double resolution)
  {
    const double normal = 10 * (1 - outlier_ratio);
    const double level = outlier_ratio / (resolution * resolution * resolution);
    const double floor = -portableLog(level);
    const double top = -portableLog(normal + level) - floor;
    slope = -2 * portableLog(
                     (-portableLog(normal * portableExp(-0.5) + level) - floor) / top);
    height = -top;
  }

  double
  operator()(double distance_sq) const
  {
    return height * portableExp(-slope / 2 * distance_sq);
  }

  double slope, height;
};

/** Sums of a pass over the source. */
struct NdtSums {
  PlaneSums of_score; ///< weighted by the score
  PlaneSums of_form;  ///< constraints of the distributions on directions
  double score = 0;
  std::size_t points = 0;

  static NdtSums
  merge(const NdtSums& a, const NdtSums& b)
  {
    return {PlaneSums::merge(a.of_score, b.of_score),
            PlaneSums::merge(a.of_form, b.of_form),
            a.score + b.score,
            a.points + b.points};
  }
};

class NdtRun {
public:
  NdtRun(const DistributionGrid& target,
         const Points& source,
         const NdtOptions& options)
  : target_(target)
  , source_(source)
  , o_(options)
  , score_(options.outlier_ratio, target.resolution())
  {}

  NdtResult
  run(const Eigen::Isometry3d& guess)
  {
    NdtResult result;
    result.T_target_source = guess;
    result.stop = IcpStop::kIterationLimit;
    for (int i = 1; i <= o_.max_iterations; ++i) {
      result.iterations = i;
      if (const auto stop = iterate(result)) {
        result.stop = *stop;
        break;
      }
    }
    if (result.stop == IcpStop::kTooFewPairs || result.stop == IcpStop::kDiverged)
      result.T_target_source = guess;
    finish(result);
    return result;
  }

private:
  /** One step, limited in length, and taken whether the score rises or not: the score jumps where a
   * distribution comes within reach of a point, and would hold back small steps.
   * \return the reason to stop, if any */
  std::optional<IcpStop>
  iterate(NdtResult& result) const
  {
    const NdtSums sums = sumsAt(result.T_target_source, false);
    if (sums.points < 3)
      return IcpStop::kTooFewPairs;
    const RigidEstimate step = planeStepByHelix(sums.of_score);
    if (step.status == Status::kTooFewPairs)
      return IcpStop::kTooFewPairs;
    if (step.status == Status::kDiverged || !step.transform.matrix().allFinite())
      return IcpStop::kDiverged;
    const Eigen::Vector3d centroid = sums.of_score.mean_source;
    const MotionSize size = sizeOf(step.transform, centroid);
    const double length =
        std::sqrt(size.translation * size.translation + size.rotation * size.rotation);
    result.last_step = length > o_.step_size
                           ? partOf(step.transform, centroid, o_.step_size / length)
                           : step.transform;
    result.T_target_source = exactlyRigid(result.last_step * result.T_target_source);
    if (size.translation <= o_.translation_epsilon &&
        size.rotation <= o_.rotation_epsilon)
      return IcpStop::kAtRest;
    return std::nullopt;
  }

  static MotionSize
  sizeOf(const Eigen::Isometry3d& step, const Eigen::Vector3d& centroid)
  {
    return {(step * centroid - centroid).norm(), rotationAngle(step.linear())};
  }

  /** \return a share of a step, about a place */
  static Eigen::Isometry3d
  partOf(const Eigen::Isometry3d& step, const Eigen::Vector3d& centroid, double share)
  {
    Eigen::Isometry3d part = step;
    part.linear() = slerp(Eigen::Matrix3d::Identity(), step.linear(), share);
    part.translation() =
        centroid + share * (step * centroid - centroid) - part.linear() * centroid;
    return part;
  }

  NdtSums
  sumsAt(const Eigen::Isometry3d& T, bool with_form) const
  {
    constexpr std::size_t kSources = 256;
    std::vector<NdtSums> partials((source_.size() + kSources - 1) / kSources);
    parallelBlocks(source_.size(), kSources, o_.num_threads, [&](const Block& block) {
      PlaneAccumulator of_score, of_form;
      NdtSums& sums = partials[block.index];
      for (std::size_t i = block.begin; i < block.end; ++i)
        addPoint(T * source_[i].cast<double>(),
                 of_score,
                 with_form ? &of_form : nullptr,
                 sums);
      sums.of_score = of_score.sums();
      sums.of_form = of_form.sums();
    });
    return mergeTree(std::move(partials), &NdtSums::merge);
  }

  /** Adds a point with the distributions of nearby means: for the step within half the diagonal of
   * a cell's face, enough to include a surface's own cell; to rate a pose within a cell's side,
   * like PCL's score. */
  void
  addPoint(const Eigen::Vector3d& p,
           PlaneAccumulator& of_score,
           PlaneAccumulator* of_form,
           NdtSums& sums) const
  {
    std::array<Neighbour, kMostCells> near;
    const std::size_t count =
        target_.tree().nearestK(p.cast<float>(), near.size(), near.data());
    const double side_sq = target_.resolution() * target_.resolution();
    const double reach_sq = of_form ? side_sq : side_sq / 2;
    bool is_near = false;
    for (std::size_t k = 0; k < count && near[k].distance_sq < reach_sq; ++k) {
      const Distribution& d = target_.distributions()[near[k].index];
      const Eigen::Vector3d e = d.mean - p;
      const Eigen::Vector3d pull = d.information * e;
      const double distance_sq = e.dot(pull), score = score_(distance_sq);
      sums.score += score;
      // The score's curvature (Magnusson 2009, (6.13)) without its negative part: N minus a share
      // of pull pull^T, with the gradient unchanged.
      const double bend = std::min(score_.slope * distance_sq, kMostBend);
      if (distance_sq > 0)
        of_score.addNorm(p,
                         p + e / (1 - bend),
                         d.information - bend / distance_sq * pull * pull.transpose(),
                         score_.slope * score);
      if (of_form)
        of_form->addNorm(p, d.mean, d.form, score);
      is_near = true;
    }
    sums.points += is_near ? 1 : 0;
  }

  /** Rates the final pose. */
  void
  finish(NdtResult& result) const
  {
    const NdtSums sums = sumsAt(result.T_target_source, true);
    result.points = sums.points;
    if (!source_.empty())
      result.likelihood = sums.score / static_cast<double>(source_.size());
    result.localizability = localizabilityOf(sums.of_form);
    const bool is_open = result.localizability.openDirections() > 0;
    result.status = result.stop == IcpStop::kAtRest
                        ? (is_open ? Status::kRankDeficient : Status::kOk)
                    : result.stop == IcpStop::kTooFewPairs ? Status::kTooFewPairs
                    : result.stop == IcpStop::kDiverged    ? Status::kDiverged
                                                           : Status::kMaxIterations;
  }

  static constexpr std::size_t kMostCells =
      12; ///< 8 share a corner, and means lie anywhere

  /** At 1, a point beyond the inflexion of its score would leave the step unbounded. */
  static constexpr double kMostBend = 0.8;

  const DistributionGrid& target_;
  const Points& source_;
  const NdtOptions& o_;
  Score score_;
};
} // namespace

NdtResult
ndt(const DistributionGrid& target,
    const Points& source,
    const Eigen::Isometry3d& guess,
    const NdtOptions& options)
{
  options.validate();
  return NdtRun(target, source, options).run(guess);
}

} // namespace pcl6d
