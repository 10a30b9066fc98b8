// SPDX-License-Identifier: BSD-3-Clause
#include "icp/icp_metric.h"

#include <pcl6d/common/parallel.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::registration {

namespace {
/** Adds the pairs of each block, and merges the blocks in a fixed order.
 * \param[in] add called with an accumulator and the place of a source point in a pair */
template <typename Accumulator, typename Sums, typename Add>
Sums
sumPairs(const std::vector<Partner>& partners, unsigned int num_threads, Add add)
{
  constexpr std::size_t kSources = CorrespondenceSearch::kBlockSize;
  std::vector<Sums> partials((partners.size() + kSources - 1) / kSources);
  parallelBlocks(partners.size(), kSources, num_threads, [&](const Block& block) {
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

/** Cosine of 60 degrees: points with normals farther apart lie on two surfaces, near the edge of
 * floor and wall for example; the sum of their normals fits neither. */
constexpr double kSameSurface = 0.5;

double
squared(double x)
{
  return x * x;
}

/** The square of the distance within which a share of the pairs lies. */
float
trimAt(double share, const std::vector<Partner>& partners)
{
  std::vector<float> distances;
  for (const Partner& partner : partners)
    if (partner.weight > 0)
      distances.push_back(partner.distance_sq);
  if (distances.empty())
    return 0;
  const auto kept = static_cast<std::size_t>(std::ceil(share * distances.size()));
  const auto last = distances.begin() + (std::max<std::size_t>(kept, 1) - 1);
  std::nth_element(distances.begin(), last, distances.end());
  return *last;
}

/** 1.4826 times the median of the residuals: the standard deviation of normal residuals, robust to
 * a minority of outliers (MAD about zero). */
double
scaleOf(const std::vector<float>& residuals, const std::vector<Partner>& partners)
{
  std::vector<float> of_pairs;
  for (std::size_t i = 0; i < partners.size(); ++i)
    if (partners[i].weight > 0)
      of_pairs.push_back(residuals[i]);
  if (of_pairs.empty())
    return 0;
  const auto middle = of_pairs.begin() + of_pairs.size() / 2;
  std::nth_element(of_pairs.begin(), middle, of_pairs.end());
  return 1.4826 * *middle;
}

/** Trims and weights pairs by their residuals (book 4.1.5).
 * \param[in] residuals [m] in the metric, per source point; used only for pairs */
void
weightPairs(const IcpOptions& options,
            const std::vector<float>& residuals,
            std::vector<Partner>& partners)
{
  if (options.kept_share < 1) {
    const float limit_sq = trimAt(options.kept_share, partners);
    for (Partner& partner : partners)
      if (partner.distance_sq > limit_sq)
        partner.weight = 0;
  }
  if (options.robust == RobustKernel::kNone)
    return;
  constexpr double kLeastScale = 1e-6; // [m] finer than any scanner: exact copies
  const double scale = std::max(scaleOf(residuals, partners), kLeastScale);
  for (std::size_t i = 0; i < partners.size(); ++i)
    if (partners[i].weight > 0)
      partners[i].weight =
          static_cast<float>(robustWeight(options.robust, residuals[i] / scale));
}
} // namespace

PairSums
IcpMetric::pairSums(const Placement& at, const std::vector<Partner>& partners) const
{
  return sumPairs<PairAccumulator, PairSums>(
      partners, options_.num_threads, [&](PairAccumulator& sums, std::size_t i) {
        sums.add(at((*source_.points)[i]),
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
          sums.addPlanes(p,
                         m,
                         partner.normal.cast<double>(),
                         T.linear() * (*source_.normals)[i].cast<double>(),
                         options_.gicp_epsilon,
                         partner.weight);
        else if (options_.symmetric)
          sums.add((p + m) / 2,
                   (p + m) / 2 + (m - p),
                   sumOfNormals(T, partner, i),
                   partner.weight);
        else
          sums.add(p, m, partner.normal.cast<double>(), partner.weight);
      });
}

Eigen::Vector3d
IcpMetric::sumOfNormals(const Eigen::Isometry3d& T,
                        const Partner& partner,
                        std::size_t i) const
{
  const Eigen::Vector3d n = partner.normal.cast<double>();
  const Eigen::Vector3d own =
      T.linear() * (*source_.normals)[i].cast<double>().stableNormalized();
  if (std::abs(n.dot(own)) < kSameSurface)
    return Eigen::Vector3d::Zero();
  return options_.align_normals && n.dot(own) < 0 ? Eigen::Vector3d(n - own) : n + own;
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
IcpMetric::weigh(const Placement& at, std::vector<Partner>& partners) const
{
  if (options_.robust == RobustKernel::kNone && options_.kept_share >= 1)
    return;
  std::vector<float> residuals(partners.size());
  constexpr std::size_t kSources = CorrespondenceSearch::kBlockSize;
  parallelBlocks(
      partners.size(), kSources, options_.num_threads, [&](const Block& block) {
        for (std::size_t i = block.begin; i < block.end; ++i) {
          const Partner& partner = partners[i];
          if (partner.weight == 0)
            continue;
          const Eigen::Vector3d e =
              partner.point.cast<double>() - at((*source_.points)[i]);
          double residual_sq = e.squaredNorm();
          if (options_.metric == Metric::kPlane)
            residual_sq = squared(partner.normal.cast<double>().dot(e));
          else if (options_.metric == Metric::kGicp)
            residual_sq = e.dot(normOf(at.T, partner, i) * e);
          residuals[i] = static_cast<float>(std::sqrt(residual_sq));
        }
      });
  weightPairs(options_, residuals, partners);
}

MetricStep
IcpMetric::step(const Placement& at, const std::vector<Partner>& partners) const
{
  if (options_.metric == Metric::kPoint) {
    const PairSums sums = pairSums(at, partners);
    const double error = sums.errorSq(Eigen::Isometry3d::Identity());
    MetricStep step = stepOf(sums, error, error);
    if (options_.estimate_scale) {
      const SimilarityEstimate similarity = similarityByQuaternion(sums);
      step.motion = similarity.rigid;
      step.scale = similarity.scale;
    }
    else
      step.motion = options_.minimiser(sums);
    return step;
  }
  const PlaneSums sums = planeSums(at.T, partners);
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
    const PairSums sums = pairSums({T, result.scale}, partners);
    const double error = sums.errorSq(Eigen::Isometry3d::Identity());
    fill(sums, error, error);
  }
  else {
    const PlaneSums sums = planeSums(T, partners);
    fill(sums, sums.distance_sq, sums.residual_sq);
  }
}

} // namespace pcl6d::registration
