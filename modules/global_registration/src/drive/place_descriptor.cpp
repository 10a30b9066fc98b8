// SPDX-License-Identifier: BSD-3-Clause
#include "drive/place_descriptor.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pcl6d::global_registration {

namespace {
/** A surface is upright if its normal is nearly level: cosine of 60 deg. */
constexpr double kUprightNormal = 0.5;

/** Bins of the histograms. More bins distinguish places better, but fewer points fall into
 * each: 600 points in 36 bins give a count to a quarter. */
constexpr int kLengths = 16, kAngles = 4, kRings = 12, kHeights = 12;

/** [reach] Ends of lengths and heights; values beyond count in the last bin. */
constexpr double kLongest = 2, kLowest = -0.25, kHighest = 0.5;

/** A histogram with each entry shared by the two nearest bins, so that a small change of a
 * value changes the histogram little. */
class Histogram {
public:
  Histogram(int lengths, int angles)
  : angles_(angles)
  , bins_(static_cast<std::size_t>(lengths) * static_cast<std::size_t>(angles))
  , lengths_(lengths)
  {}

  /** \param[in] length, angle in [0, 1] */
  void
  add(double length, double angle)
  {
    const double l = std::clamp(length, 0.0, 1.0) * (lengths_ - 1);
    const double a = std::clamp(angle, 0.0, 1.0) * (angles_ - 1);
    const int l0 = std::min(static_cast<int>(l), std::max(0, lengths_ - 2));
    const int a0 = std::min(static_cast<int>(a), std::max(0, angles_ - 2));
    for (int i = 0; i < std::min(2, lengths_); ++i)
      for (int k = 0; k < std::min(2, angles_); ++k)
        bins_[static_cast<std::size_t>(l0 + i) * static_cast<std::size_t>(angles_) +
              static_cast<std::size_t>(a0 + k)] +=
            (1 - std::abs(l - l0 - i)) * (angles_ > 1 ? 1 - std::abs(a - a0 - k) : 1);
  }

  void
  appendTo(PlaceDescriptor& descriptor) const
  {
    double sum = 0;
    for (const double bin : bins_)
      sum += bin;
    for (const double bin : bins_)
      descriptor.push_back(sum > 0 ? bin / sum : 0);
  }

private:
  int angles_;
  std::vector<double> bins_;
  int lengths_;
};

/** Upright surfaces from above. */
struct Wall {
  Eigen::Vector2d place, facing;
};

std::vector<Wall>
wallsOf(const PlaceableScan& scan, const Eigen::Matrix3d& R_level_scan)
{
  std::vector<Wall> walls;
  const auto& sample = scan.evaluated();
  for (std::size_t i = 0; i < sample.points.size(); ++i) {
    const Eigen::Vector3d n = R_level_scan * sample.normals[i].cast<double>();
    if (!sample.normals[i].isZero(0) && std::abs(n.z()) <= kUprightNormal)
      walls.push_back({(R_level_scan * sample.points[i].cast<double>()).head<2>(),
                       n.head<2>().normalized()});
  }
  return walls;
}
} // namespace

PlaceDescriptor
describePlace(const PlaceableScan& scan, double reach)
{
  const Eigen::Matrix3d R_level_scan = uprightRotation(scan.vertical().up);
  const std::vector<Wall> walls = wallsOf(scan, R_level_scan);
  Histogram pairs(kLengths, kAngles), rings(kRings, kAngles), heights(kHeights, 1);
  for (std::size_t i = 0; i < walls.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      pairs.add((walls[i].place - walls[j].place).norm() / (kLongest * reach),
                std::abs(walls[i].facing.dot(walls[j].facing)));
    const double range = walls[i].place.norm();
    if (range > 0)
      rings.add(range / (kLongest * reach),
                std::abs(walls[i].facing.dot(walls[i].place)) / range);
  }
  for (const auto& point : scan.evaluated().points) {
    const double height = (R_level_scan * point.cast<double>()).z() / reach;
    heights.add((height - kLowest) / (kHighest - kLowest), 0);
  }
  PlaceDescriptor descriptor;
  for (const Histogram* const part : {&pairs, &rings, &heights})
    part->appendTo(descriptor);
  return descriptor;
}

double
distanceOf(const PlaceDescriptor& a, const PlaceDescriptor& b)
{
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += std::abs(a[i] - b[i]);
  return sum;
}

} // namespace pcl6d::global_registration
