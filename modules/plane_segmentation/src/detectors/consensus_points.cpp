// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/random.h>
#include <pcl6d/plane_segmentation/consensus_points.h>

#include <algorithm>

namespace pcl6d {

namespace {
constexpr std::size_t kCentreSamples = 101; // enough to make outliers irrelevant

/** \return a number below a size, a function of the key alone */
std::size_t
drawBelow(std::size_t size, std::uint64_t key)
{
  return ((mixBits(key) >> 32) * size) >> 32;
}

float
medianOfSome(const float* values, std::size_t size)
{
  std::vector<float> some;
  const std::size_t stride = std::max<std::size_t>(1, size / kCentreSamples);
  some.reserve(size / stride + 1);
  for (std::size_t i = 0; i < size; i += stride)
    some.push_back(values[i]);
  const auto middle = some.begin() + static_cast<std::ptrdiff_t>(some.size() / 2);
  std::nth_element(some.begin(), middle, some.end());
  return *middle;
}
} // namespace

ConsensusPoints::ConsensusPoints(std::size_t capacity, bool with_normals)
: xs_(capacity + 1), ys_(capacity + 1), zs_(capacity + 1), places_(capacity + 1)
{
  // One more, as a point is written before it is found to be non-finite.
  if (!with_normals)
    return;
  for (auto& column : normals_)
    column.resize(capacity + 1);
  weights_.resize(capacity + 1);
}

void
ConsensusPoints::add(const Eigen::Vector3f& point,
                     const Eigen::Vector3f& normal,
                     float weight)
{
  const double length = normal.cast<double>().norm();
  if (!(length > 0) || !std::isfinite(length) || !std::isfinite(weight)) {
    ++offered_;
    return;
  }
  const Eigen::Vector3f unit = (normal.cast<double>() / length).cast<float>();
  for (std::size_t axis = 0; axis < 3; ++axis)
    normals_[axis][size_] = unit[static_cast<Eigen::Index>(axis)];
  weights_[size_] = weight;
  add(point.x(), point.y(), point.z());
}

std::optional<std::size_t>
ConsensusPoints::find(std::uint32_t place) const
{
  const auto end = places_.begin() + static_cast<std::ptrdiff_t>(size_);
  const auto found = std::lower_bound(places_.begin(), end, place);
  if (found == end || *found != place)
    return {};
  return static_cast<std::size_t>(found - places_.begin());
}

void
ConsensusPoints::centre()
{
  if (size_ == 0)
    return;
  const Eigen::Vector3f middle(
      medianOfSome(x(), size_), medianOfSome(y(), size_), medianOfSome(z(), size_));
  for (std::size_t i = 0; i < size_; ++i) {
    xs_[i] -= middle.x();
    ys_[i] -= middle.y();
    zs_[i] -= middle.z();
  }
  origin_ += middle;
}

ConsensusPoints
ConsensusPoints::sample(std::size_t count, std::uint64_t seed) const
{
  count = std::min(count, size_);
  std::vector<std::size_t> chosen(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t begin = k * size_ / count, end = (k + 1) * size_ / count;
    chosen[k] = begin + drawBelow(end - begin, seed + k);
  }
  for (std::size_t k = count; k > 1; --k)
    std::swap(chosen[k - 1], chosen[drawBelow(k, seed + count + k)]);
  ConsensusPoints some(count, hasNormals());
  some.origin_ = origin_;
  for (const auto i : chosen) {
    if (hasNormals()) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        some.normals_[axis][some.size_] = normals_[axis][i];
      some.weights_[some.size_] = weights_[i];
    }
    some.add(xs_[i], ys_[i], zs_[i]);
    some.places_[some.size_ - 1] = places_[i];
  }
  return some;
}

} // namespace pcl6d
