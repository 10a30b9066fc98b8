// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/global_registration/pcl/correspondence_rejector_compatibility.h>
#include <pcl6d/registration/pcl/impl/blob_points.h>

#include <pcl/point_types.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace pcl6d {
using namespace registration;

namespace {
/** [median spacings] Largest distance of equal points of two scans of a surface: half the
 * diagonal of a square of points is 0.7; the noise of both scans adds the rest. */
constexpr double kNoiseSpacings = 1.25;
} // namespace

void
CorrespondenceRejectorCompatibility::setNoise(const std::optional<double>& noise)
{
  CompatibilityOptions options = options_;
  options.noise = noise.value_or(options.noise);
  options.validate();
  noise_ = noise;
}

void
CorrespondenceRejectorCompatibility::setMaximumPairs(std::size_t pairs)
{
  CompatibilityOptions options = options_;
  options.max_pairs = pairs;
  options.validate();
  options_ = options;
}

void
CorrespondenceRejectorCompatibility::setSourcePoints(
    pcl::PCLPointCloud2::ConstPtr cloud)
{
  set(source_, toPoints(*cloudOfBlob<pcl::PointXYZ>(cloud, "x")));
}

void
CorrespondenceRejectorCompatibility::setTargetPoints(
    pcl::PCLPointCloud2::ConstPtr cloud)
{
  set(target_, toPoints(*cloudOfBlob<pcl::PointXYZ>(cloud, "x")));
}

void
CorrespondenceRejectorCompatibility::set(Side& side, Points points)
{
  if (side.is_set && side.points == points)
    return; // pipelines pass an unchanged target with each source: keep its spacing
  side = {true, std::move(points), std::nullopt};
}

double
CorrespondenceRejectorCompatibility::spacingOf(Side& side)
{
  if (!side.spacing)
    side.spacing = medianSpacing(side.points);
  return *side.spacing;
}

pcl::Correspondences
CorrespondenceRejectorCompatibility::select(const pcl::Correspondences& original)
{
  if (!source_.is_set || !target_.is_set)
    throw BadArgument(this->rejection_name_ + ": no input " +
                      (source_.is_set ? "target" : "source") + " is set");
  const pcl::Correspondences pairs = usablePairs(original);
  requireIndicesOfPairs(pairs, source_.points.size(), target_.points.size());
  Points source, target;
  for (const auto& pair : pairs) {
    source.push_back(source_.points[static_cast<std::size_t>(pair.index_query)]);
    target.push_back(target_.points[static_cast<std::size_t>(pair.index_match)]);
  }
  CompatibilityOptions options = options_;
  options.noise =
      noise_
          ? *noise_
          : std::max(kNoiseSpacings * std::max(spacingOf(source_), spacingOf(target_)),
                     static_cast<double>(std::numeric_limits<float>::min()));
  pcl::Correspondences kept;
  for (const std::size_t i : compatiblePairs(source, target, options))
    kept.push_back(pairs[i]);
  return kept;
}

} // namespace pcl6d
