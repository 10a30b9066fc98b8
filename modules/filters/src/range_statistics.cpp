// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/median.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/search/point_tree.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>

namespace pcl6d {

namespace {
std::vector<double>
rangesOf(const Points& points)
{
  std::vector<double> ranges;
  ranges.reserve(points.size());
  for (const auto& p : points)
    if (p.allFinite())
      ranges.push_back(p.cast<double>().norm());
  return ranges;
}
} // namespace

void
validateRangeLimits(double min_range, double max_range)
{
  require(min_range >= 0, "min_range", min_range, ">= 0");
  std::ostringstream rule;
  rule << ">= min_range = " << min_range;
  require(max_range >= min_range, "max_range", max_range, rule.str());
}

bool
isWithinRange(const Eigen::Vector3f& p, double min_range, double max_range)
{
  const double range_sq = p.cast<double>().squaredNorm();
  return p.allFinite() && range_sq >= min_range * min_range &&
         range_sq <= max_range * max_range;
}

Points
gateByRange(const Points& points, double min_range, double max_range)
{
  Points kept;
  kept.reserve(points.size());
  for (const auto& p : points)
    if (isWithinRange(p, min_range, max_range))
      kept.push_back(p);
  return kept;
}

void
maskOutOfRange(double min_range, double max_range, Points& points)
{
  for (auto& p : points)
    if (!isWithinRange(p, min_range, max_range))
      p.setConstant(std::numeric_limits<float>::quiet_NaN());
}

std::optional<double>
noReturnRange(const Points& points)
{
  const std::vector<double> ranges = rangesOf(points);
  if (ranges.empty())
    return std::nullopt;
  const double largest = *std::max_element(ranges.begin(), ranges.end());
  // Where most points are at about the largest range, this range is
  // measured on an object.
  if (upperMedian(ranges) >= 0.9 * largest)
    return std::nullopt;
  const double tolerance = 1e-4 * largest;
  const auto sharing = std::count_if(
      ranges.begin(), ranges.end(), [&](double r) { return r >= largest - tolerance; });
  // A few points are no evidence: any small cloud has a farthest point.
  const double needed = std::max(10.0, 0.005 * static_cast<double>(ranges.size()));
  if (static_cast<double>(sharing) > needed)
    return largest;
  return std::nullopt;
}

double
medianRange(const Points& points)
{
  return upperMedian(rangesOf(points));
}

double
medianSpread(const Points& points)
{
  Eigen::Vector3f middle;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> coordinates;
    for (const auto& p : points)
      if (p.allFinite())
        coordinates.push_back(p[axis]);
    middle[axis] = static_cast<float>(upperMedian(std::move(coordinates)));
  }
  std::vector<double> distances;
  for (const auto& p : points)
    if (p.allFinite())
      distances.push_back((p - middle).cast<double>().norm());
  return upperMedian(std::move(distances));
}

namespace {
/** \return about 1000 evenly chosen points, duplicates side by side */
Points
samplesOf(const Points& points)
{
  constexpr std::size_t kSamples = 1000;
  const std::size_t step = std::max<std::size_t>(1, points.size() / kSamples);
  Points samples;
  for (std::size_t i = 0; i < points.size(); i += step)
    samples.push_back(points[i]);
  std::sort(samples.begin(), samples.end(), [](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  });
  return samples;
}

/** \return the distance to the nearest point at another place; empty
 * without such a point */
std::optional<double>
spacingAt(const Eigen::Vector3f& place, const PointTree& tree, std::size_t tree_size)
{
  for (std::size_t k = 2; k < 4 * tree_size; k *= 4) { // duplicates are rare
    const auto found = tree.nearestK(place, k);
    if (!found.empty() && found.back().distance_sq > 0) {
      const auto other = std::find_if(
          found.begin(), found.end(), [](const auto& n) { return n.distance_sq > 0; });
      return std::sqrt(static_cast<double>(other->distance_sq));
    }
  }
  return std::nullopt;
}
} // namespace

double
medianSpacing(const Points& all)
{
  Points points; // finite points, to choose samples from
  std::copy_if(all.begin(), all.end(), std::back_inserter(points), [](const auto& p) {
    return p.allFinite();
  });
  const PointTree tree(points);
  const Points samples = samplesOf(points);
  std::vector<double> spacings;
  std::optional<double> spacing; // of the last sample; a heap of equal points asks once
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i == 0 || samples[i] != samples[i - 1])
      spacing = spacingAt(samples[i], tree, points.size());
    if (spacing)
      spacings.push_back(*spacing);
  }
  return upperMedian(std::move(spacings));
}

} // namespace pcl6d
