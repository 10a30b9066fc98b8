// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/number_range.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/registration/pcl/correspondence_rejector_one_to_one.h>
#include <pcl6d/registration/pcl/correspondence_rejector_surface_normal.h>
#include <pcl6d/registration/pcl/correspondence_rejector_trimmed.h>
#include <pcl6d/registration/pcl/correspondence_rejector_var_trimmed.h>
#include <pcl6d/registration/pcl/impl/blob_points.h>

#include <pcl/console/print.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace pcl6d {
namespace registration {

namespace {
bool
isCloserPair(const pcl::Correspondence& a, const pcl::Correspondence& b)
{
  return std::tie(a.distance, a.index_query, a.index_match) <
         std::tie(b.distance, b.index_query, b.index_match);
}
} // namespace

pcl::Correspondences
usablePairs(const pcl::Correspondences& pairs)
{
  pcl::Correspondences usable;
  usable.reserve(pairs.size());
  for (const auto& pair : pairs)
    if (pair.index_query >= 0 && pair.index_match >= 0 && !std::isnan(pair.distance))
      usable.push_back(pair);
  return usable;
}

pcl::Correspondences
closestPairs(const pcl::Correspondences& pairs, std::size_t count)
{
  if (count >= pairs.size())
    return pairs;
  if (count == 0)
    return {};
  pcl::Correspondences by_distance = pairs;
  const auto last = by_distance.begin() + static_cast<std::ptrdiff_t>(count - 1);
  std::nth_element(by_distance.begin(), last, by_distance.end(), isCloserPair);
  pcl::Correspondences kept;
  kept.reserve(count);
  for (const auto& pair : pairs) // of equal pairs, the first
    if (!isCloserPair(*last, pair) && kept.size() < count)
      kept.push_back(pair);
  return kept;
}

void
requireIndicesOfPairs(const pcl::Correspondences& pairs,
                      std::size_t num_source,
                      std::size_t num_target)
{
  pcl::Indices of_source, of_target;
  for (const auto& pair : pairs) {
    of_source.push_back(pair.index_query);
    of_target.push_back(pair.index_match);
  }
  requireIndices(of_source, num_source);
  requireIndices(of_target, num_target);
}

} // namespace registration

using namespace registration;

pcl::Correspondences
CorrespondenceRejectorOneToOne::select(const pcl::Correspondences& original)
{
  const pcl::Correspondences pairs = usablePairs(original);
  std::vector<std::size_t> order(pairs.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto key = [&](std::size_t i) {
      return std::make_tuple(
          pairs[i].index_match, pairs[i].distance, pairs[i].index_query, i);
    };
    return key(a) < key(b);
  });
  std::vector<bool> is_kept(pairs.size(), false);
  for (std::size_t i = 0; i < order.size(); ++i)
    is_kept[order[i]] =
        i == 0 || pairs[order[i]].index_match != pairs[order[i - 1]].index_match;
  pcl::Correspondences kept;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (is_kept[i])
      kept.push_back(pairs[i]);
  return kept;
}

void
CorrespondenceRejectorTrimmed::setOverlapRatio(float ratio)
{
  require(!std::isnan(ratio), "overlap ratio", ratio, "a number");
  overlap_ratio_ = std::min(1.0f, std::max(0.0f, ratio));
}

pcl::Correspondences
CorrespondenceRejectorTrimmed::select(const pcl::Correspondences& original)
{
  // The share was rounded to float: of ten pairs, 0.7f means seven.
  constexpr double kHalfUlp =
      0.5 * static_cast<double>(std::numeric_limits<float>::epsilon());
  const double share = static_cast<double>(overlap_ratio_) * (1 + kHalfUlp);
  const auto count =
      clampedTo<std::size_t>(share * static_cast<double>(original.size()));
  return closestPairs(usablePairs(original),
                      std::max<std::size_t>(count, min_correspondences_));
}

void
CorrespondenceRejectorVarTrimmed::setMinRatio(double ratio)
{
  require(ratio >= 0 && ratio <= 1, "min_ratio", ratio, "in [0, 1]");
  min_ratio_ = ratio;
}

void
CorrespondenceRejectorVarTrimmed::setMaxRatio(double ratio)
{
  require(ratio >= 0 && ratio <= 1, "max_ratio", ratio, "in [0, 1]");
  max_ratio_ = ratio;
}

void
CorrespondenceRejectorVarTrimmed::setSourcePoints(pcl::PCLPointCloud2::ConstPtr cloud)
{
  setInputSource<pcl::PointXYZ>(cloudOfBlob<pcl::PointXYZ>(cloud, "x"));
}

void
CorrespondenceRejectorVarTrimmed::setTargetPoints(pcl::PCLPointCloud2::ConstPtr cloud)
{
  setInputTarget<pcl::PointXYZ>(cloudOfBlob<pcl::PointXYZ>(cloud, "x"));
}

namespace {
/** \return the number of closest pairs with the least fractional RMSD
 * \param[in] distances_sq ascending \param[in] least, most number of pairs; > 0 */
std::size_t
countByFractionalRmsd(const std::vector<float>& distances_sq,
                      std::size_t least,
                      std::size_t most)
{
  constexpr double kLambda = 0.95; // Phillips et al. for three dimensions
  double sum = 0, best = std::numeric_limits<double>::infinity();
  std::size_t count = most;
  for (std::size_t k = 1; k <= most; ++k) {
    sum += static_cast<double>(distances_sq[k - 1]);
    // Twice the logarithm of rms / f^lambda, without terms independent of k.
    const double n = static_cast<double>(k);
    const double cost = portableLog(sum / n) - 2 * kLambda * portableLog(n);
    if (k >= least && cost <= best) {
      best = cost;
      count = k;
    }
  }
  return count;
}
} // namespace

pcl::Correspondences
CorrespondenceRejectorVarTrimmed::select(const pcl::Correspondences& original)
{
  require(min_ratio_ <= max_ratio_, "min_ratio", min_ratio_, "at most max_ratio");
  pcl::Correspondences pairs = usablePairs(original);
  if (source_ && target_) {
    const Points source = source_(), target = target_();
    requireIndicesOfPairs(pairs, source.size(), target.size());
    for (auto& pair : pairs)
      pair.distance = distanceSq(source[static_cast<std::size_t>(pair.index_query)],
                                 target[static_cast<std::size_t>(pair.index_match)]);
    pairs = usablePairs(pairs);
  }
  factor_ = trimmed_distance_ = 0;
  if (pairs.empty())
    return pairs;
  std::vector<float> distances_sq;
  for (const auto& pair : pairs)
    distances_sq.push_back(pair.distance);
  std::sort(distances_sq.begin(), distances_sq.end());
  const double n = static_cast<double>(pairs.size());
  const auto least = std::max<std::size_t>(1, clampedTo<std::size_t>(min_ratio_ * n));
  const auto most = std::max(least, clampedTo<std::size_t>(max_ratio_ * n));
  const std::size_t count = countByFractionalRmsd(distances_sq, least, most);
  factor_ = static_cast<double>(count) / n;
  trimmed_distance_ = static_cast<double>(distances_sq[count - 1]);
  return closestPairs(pairs, count);
}

void
CorrespondenceRejectorSurfaceNormal::setThreshold(double threshold)
{
  require(!std::isnan(threshold), "threshold", threshold, "a number");
  threshold_ = threshold;
}

void
CorrespondenceRejectorSurfaceNormal::setSourceNormals(
    pcl::PCLPointCloud2::ConstPtr cloud)
{
  setNormals<pcl::Normal>(cloudOfBlob<pcl::Normal>(cloud, "normal_x"), source_);
}

void
CorrespondenceRejectorSurfaceNormal::setTargetNormals(
    pcl::PCLPointCloud2::ConstPtr cloud)
{
  setNormals<pcl::Normal>(cloudOfBlob<pcl::Normal>(cloud, "normal_x"), target_);
}

void
CorrespondenceRejectorSurfaceNormal::setSourcePoints(
    pcl::PCLPointCloud2::ConstPtr cloud)
{
  setInputSource<pcl::PointXYZ>(cloudOfBlob<pcl::PointXYZ>(cloud, "x"));
}

void
CorrespondenceRejectorSurfaceNormal::setTargetPoints(
    pcl::PCLPointCloud2::ConstPtr cloud)
{
  setInputTarget<pcl::PointXYZ>(cloudOfBlob<pcl::PointXYZ>(cloud, "x"));
}

pcl::Correspondences
CorrespondenceRejectorSurfaceNormal::select(const pcl::Correspondences& original)
{
  if (!source_.read || !target_.read)
    throw BadArgument(this->rejection_name_ + ": no normals of the " +
                      (source_.read ? "target" : "source") + " are set");
  const Normals source = source_.read(), target = target_.read();
  const pcl::Correspondences pairs = usablePairs(original);
  requireIndicesOfPairs(pairs, source.size(), target.size());
  if (threshold_ >= 1)
    PCL_WARN("[pcl6d::%s] no pair has a cosine above %g: set the threshold\n",
             this->rejection_name_.c_str(),
             threshold_);
  pcl::Correspondences kept;
  for (const auto& pair : pairs) {
    const Eigen::Vector3d n =
        source[static_cast<std::size_t>(pair.index_query)].cast<double>();
    const Eigen::Vector3d m =
        target[static_cast<std::size_t>(pair.index_match)].cast<double>();
    const double lengths = n.norm() * m.norm();
    if (lengths > 0 && std::min(1.0, n.dot(m) / lengths) > threshold_)
      kept.push_back(pair);
  }
  return kept;
}

} // namespace pcl6d
