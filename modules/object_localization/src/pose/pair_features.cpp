// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/object_localization/pair_features.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
constexpr int kCosines = 2048;         // table of angles
constexpr float kFlatCosine = 0.9781F; // 12 deg: parallel normals
constexpr float kFlatSlope = 0.2079F;  // 12 deg: off the plane
} // namespace

void
PairFeatureOptions::validate() const
{
  require(distance_steps >= 4 && distance_steps <= 60,
          "distance_steps",
          distance_steps,
          "4 to 60");
  require(angle_steps >= 4 && angle_steps <= 30, "angle_steps", angle_steps, "4 to 30");
  require(largest_flat_share >= 0 && largest_flat_share <= 1,
          "largest_flat_share",
          largest_flat_share,
          "0 to 1");
}

Eigen::Isometry3f
frameOf(const Eigen::Vector3f& point, const Eigen::Vector3f& normal)
{
  const Eigen::Vector3f other =
      std::abs(normal.z()) < 0.8F ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitX();
  const Eigen::Vector3f y = other.cross(normal).normalized();
  Eigen::Isometry3f motion = Eigen::Isometry3f::Identity();
  motion.linear().row(0) = normal;
  motion.linear().row(1) = y;
  motion.linear().row(2) = normal.cross(y);
  motion.translation() = -(motion.linear() * point);
  return motion;
}

PairFeatureTable::PairFeatureTable(const OrientedPoints& model,
                                   double diameter,
                                   const PairFeatureOptions& options)
: diameter_(diameter), options_(options)
{
  options_.validate();
  require(diameter > 0 && std::isfinite(diameter), "diameter", diameter, "> 0");
  require(model.size() >= 3, "number of points of the model", model.size(), ">= 3");
  for (int i = 0; i <= kCosines; ++i) {
    const double angle = portableAcos(2.0 * i / kCosines - 1);
    const int step = static_cast<int>(angle / M_PI * options_.angle_steps);
    angle_steps_.push_back(
        static_cast<std::uint8_t>(std::min(step, options_.angle_steps - 1)));
  }
  for (std::size_t i = 0; i < model.size(); ++i)
    frames_.push_back(frameOf(model.points[i], model.normals[i]));
  fill(model);
  const double pairs = static_cast<double>(model.size() * (model.size() - 1));
  if (static_cast<double>(entries_.size()) <
      (1 - options_.largest_flat_share) * pairs) {
    skips_flat_ = false;
    fill(model);
  }
}

/** Sorts the pairs by their feature: counted first, then placed. */
void
PairFeatureTable::fill(const OrientedPoints& model)
{
  const auto forEachPair = [&](const auto& visit) {
    for (std::size_t i = 0; i < model.size(); ++i)
      for (std::size_t j = 0; j < model.size(); ++j) {
        const int feature = featureOf(
            model.points[i], model.normals[i], model.points[j], model.normals[j]);
        if (i != j && feature >= 0)
          visit(i, j, static_cast<std::size_t>(feature));
      }
  };
  const auto cubed = static_cast<std::size_t>(options_.angle_steps) *
                     static_cast<std::size_t>(options_.angle_steps) *
                     static_cast<std::size_t>(options_.angle_steps);
  begin_.assign(static_cast<std::size_t>(options_.distance_steps) * cubed + 1, 0);
  forEachPair([&](std::size_t, std::size_t, std::size_t f) { ++begin_[f + 1]; });
  for (std::size_t f = 1; f < begin_.size(); ++f)
    begin_[f] += begin_[f - 1];
  entries_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  forEachPair([&](std::size_t i, std::size_t j, std::size_t f) {
    const Eigen::Vector3f second = frames_[i] * model.points[j];
    entries_[next[f]++] = {static_cast<std::uint32_t>(i),
                           static_cast<float>(portableAtan2(second.z(), second.y()))};
  });
}

int
PairFeatureTable::angleStep(float cosine) const
{
  const float place = (std::clamp(cosine, -1.0F, 1.0F) + 1) * (0.5F * kCosines);
  return angle_steps_[static_cast<std::size_t>(place + 0.5F)];
}

int
PairFeatureTable::featureOf(const Eigen::Vector3f& p1,
                            const Eigen::Vector3f& n1,
                            const Eigen::Vector3f& p2,
                            const Eigen::Vector3f& n2) const
{
  const Eigen::Vector3f way = p2 - p1;
  const float distance = way.norm();
  const int distance_step = static_cast<int>(distance / static_cast<float>(diameter_) *
                                             options_.distance_steps);
  if (!(distance > 0) || distance_step >= options_.distance_steps)
    return -1;
  const float slope1 = n1.dot(way) / distance;
  const float slope2 = n2.dot(way) / distance;
  const float between = n1.dot(n2);
  if (skips_flat_ && between > kFlatCosine && std::abs(slope1) < kFlatSlope &&
      std::abs(slope2) < kFlatSlope)
    return -1;
  const int steps = options_.angle_steps;
  return ((distance_step * steps + angleStep(slope1)) * steps + angleStep(slope2)) *
             steps +
         angleStep(between);
}

} // namespace pcl6d
