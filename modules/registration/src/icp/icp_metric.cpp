// SPDX-License-Identifier: BSD-3-Clause
#include "icp/icp_metric.h"
#include "icp/pair_weights.h"

#include <pcl6d/common/parallel.h>

#include <cmath>

namespace pcl6d::registration {

namespace {
/** Adds the pairs of each block, and merges the blocks in a fixed order.
 * \param[in] add called with an accumulator and the place of a source point in a pair */
template <typename Accumulator, typename Sums, typename Add>
Sums
sumPairs(const std::vector<Partner>& partners, unsigned int num_threads, Add add)
{
  constexpr std::size_t kBlockSize = CorrespondenceSearch::kBlockSize;
  std::vector<Sums> partials((partners.size() + kBlockSize - 1) / kBlockSize);
  parallelBlocks(partners.size(), kBlockSize, num_threads, [&](const Block& block) {
    Accumulator accumulator;
    for (std::size_t i = block.begin; i < block.end; ++i)
      if (partners[i].weight > 0)
        add(accumulator, i);
    partials[block.index] = accumulator.sums();
  });
  return mergeTree(std::move(partials), &Sums::merge);
}

template <typename Sums>
MetricStep
stepOf(const Sums& sums, double distance_sq, double residual_sq)
{
  MetricStep step;
  step.pairs = sums.count;
  step.centroid = sums.mean_source;
  if (sums.count > 0) {
    step.rms = std::sqrt(distance_sq / sums.weight);
    step.residual = std::sqrt(std::max(0.0, residual_sq) / sums.weight);
  }
  return step;
}

double
squared(double x)
{
  return x * x;
}
} // namespace

PairSums
IcpMetric::pairSums(const Eigen::Isometry3d& T,
                    const std::vector<Partner>& partners) const
{
  return sumPairs<PairAccumulator, PairSums>(
      partners, options_.num_threads, [&](PairAccumulator& sums, std::size_t i) {
        sums.add(T * (*source_.points)[i].cast<double>(),
                 partners[i].point.cast<double>(),
                 partners[i].weight);
      });
}

PlaneSums
IcpMetric::planeSums(const Eigen::Isometry3d& T,
                     const std::vector<Partner>& partners) const
{
  const bool planes = options_.metric == Metric::kGicp;
  return sumPairs<PlaneAccumulator, PlaneSums>(
      partners, options_.num_threads, [&](PlaneAccumulator& sums, std::size_t i) {
        const Partner& partner = partners[i];
        const Eigen::Vector3d p = T * (*source_.points)[i].cast<double>();
        const Eigen::Vector3d m = partner.point.cast<double>();
        if (planes)
          sums.addNorm(p, m, normOf(T, partner, i), partner.weight);
        else
          sums.add(p, m, partner.normal.cast<double>(), partner.weight);
      });
}

Eigen::Matrix3d
IcpMetric::normOf(const Eigen::Isometry3d& T,
                  const Partner& partner,
                  std::size_t i) const
{
  return planeToPlane(partner.normal.cast<double>(),
                      T.linear() * (*source_.normals)[i].cast<double>(),
                      options_.gicp_epsilon);
}

void
IcpMetric::weigh(const Eigen::Isometry3d& T, std::vector<Partner>& partners) const
{
  if (options_.robust == RobustKernel::kNone && options_.kept_share >= 1)
    return;
  std::vector<float> residuals(partners.size());
  constexpr std::size_t kBlockSize = CorrespondenceSearch::kBlockSize;
  parallelBlocks(
      partners.size(), kBlockSize, options_.num_threads, [&](const Block& block) {
        for (std::size_t i = block.begin; i < block.end; ++i) {
          const Partner& partner = partners[i];
          if (partner.weight == 0)
            continue;
          const Eigen::Vector3d e =
              partner.point.cast<double>() - T * (*source_.points)[i].cast<double>();
          double residual_sq = e.squaredNorm();
          if (options_.metric == Metric::kPlane)
            residual_sq = squared(partner.normal.cast<double>().dot(e));
          else if (options_.metric == Metric::kGicp)
            residual_sq = e.dot(normOf(T, partner, i) * e);
          residuals[i] = static_cast<float>(std::sqrt(residual_sq));
        }
      });
  weightPairs(options_, residuals, partners);
}

MetricStep
IcpMetric::step(const Eigen::Isometry3d& T, const std::vector<Partner>& partners) const
{
  if (options_.metric == Metric::kPoint) {
    const PairSums sums = pairSums(T, partners);
    const double error = sums.errorSq(Eigen::Isometry3d::Identity());
    MetricStep step = stepOf(sums, error, error);
    step.motion = options_.minimiser(sums);
    return step;
  }
  const PlaneSums sums = planeSums(T, partners);
  MetricStep step = stepOf(sums, sums.distance_sq, sums.residual_sq);
  step.motion = options_.plane_minimiser(sums);
  return step;
}

void
IcpMetric::rate(const std::vector<Partner>& partners, IcpResult& result) const
{
  const Eigen::Isometry3d& T = result.T_target_source;
  const auto fill = [&](const auto& sums, double distance_sq, double residual_sq) {
    const MetricStep at_end = stepOf(sums, distance_sq, residual_sq);
    result.pairs = at_end.pairs;
    result.rms = at_end.rms;
    result.residual = at_end.residual;
    result.information = poseInformation(sums, T);
    result.covariance = poseCovariance(sums, T);
  };
  if (options_.metric == Metric::kPoint) {
    const PairSums sums = pairSums(T, partners);
    const double error = sums.errorSq(Eigen::Isometry3d::Identity());
    fill(sums, error, error);
  }
  else {
    const PlaneSums sums = planeSums(T, partners);
    fill(sums, sums.distance_sq, sums.residual_sq);
  }
}

} // namespace pcl6d::registration
