// SPDX-License-Identifier: BSD-3-Clause
#include "size_limits.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/driven_scanner_projection.h>

#include <Eigen/Geometry>

#include <cmath>

namespace pcl6d {
using namespace scanner;

namespace {
/** \return the axis of counter-clockwise turns of the drive */
Eigen::Vector3d
axisOf(Drive drive)
{
  switch (drive) {
  case Drive::kPitching: // Ry(-theta)
    return -Eigen::Vector3d::UnitY();
  case Drive::kRolling:
    return Eigen::Vector3d::UnitX();
  case Drive::kYawing:
    break;
  }
  return Eigen::Vector3d::UnitZ();
}

/** \return v turned about a unit axis */
Eigen::Vector3d
turned(const Eigen::Vector3d& v, const Eigen::Vector3d& axis, double angle)
{
  const auto [s, c] = portableSinCos(angle);
  const Eigen::Vector3d along = axis.dot(v) * axis;
  return along + c * (v - along) + s * axis.cross(v);
}

/** \return the index of the nearest angle, modulo full turns; empty if the nearest
 * angle is more than half a step away */
std::optional<int>
nearestIndex(const AngleRange& range, double angle)
{
  const double step = range.step();
  const double middle = (range.first + range.last) / 2;
  const double near_middle = middle + std::remainder(angle - middle, 2 * M_PI);
  const double index = std::round((near_middle - range.first) / step);
  if (!(index >= 0 && index < range.count))
    return std::nullopt;
  return static_cast<int>(index);
}
} // namespace

DrivenScannerProjection::DrivenScannerProjection(const DrivenScannerOptions& options)
: options_(options), scanner_(options), axis_(axisOf(options.drive))
{
  requireImageSize(rows(), cols());
  const auto requireFan = [](const AngleRange& range, const char* count) {
    require(range.count >= 2 && range.first != range.last,
            count,
            range.count,
            "at least 2 different angles");
  };
  requireFan(options.theta, "theta.count");
  requireFan(options.beam, "beam.count");
  turn_.assign(static_cast<std::size_t>(cols()), 0);
  if (options.motion == DriveMotion::kContinuous)
    for (int i = 0; i < cols(); ++i)
      turn_[static_cast<std::size_t>(i)] =
          options.theta.step() * scanner_.time(0, i) / scanner_.time(1, 0);
}

int
DrivenScannerProjection::rows() const
{
  return options_.theta.count;
}

int
DrivenScannerProjection::cols() const
{
  return options_.beam.count;
}

/** \return sample and range at a drive angle, in row 0 */
std::optional<PixelRange>
DrivenScannerProjection::seenInFan(double theta, const Eigen::Vector3d& from_axis) const
{
  const Eigen::Vector3d in_fan =
      options_.mounting.transpose() *
      (turned(from_axis, axis_, -theta) - options_.lever_arm);
  const double range = in_fan.norm();
  const auto sample =
      nearestIndex(options_.beam, portableAtan2(in_fan.y(), in_fan.x()));
  if (!sample || !(range > 0))
    return std::nullopt;
  return PixelRange{{0, *sample}, range};
}

std::optional<PixelRange>
DrivenScannerProjection::seenAt(double theta, const Eigen::Vector3d& from_axis) const
{
  auto seen = seenInFan(theta, from_axis);
  if (!seen)
    return std::nullopt;
  const double turn = turn_[static_cast<std::size_t>(seen->pixel.col)];
  const auto line = nearestIndex(options_.theta, theta - turn);
  if (!line)
    return std::nullopt;
  seen->pixel.row = *line;
  return seen;
}

std::optional<PixelRange>
DrivenScannerProjection::project(const Eigen::Vector3d& point) const
{
  constexpr double kOnAxis = 1e-6; // [rad] float coordinates are no better
  if (!point.allFinite())
    return std::nullopt;
  const Eigen::Vector3d v = point - options_.axis_position;
  const Eigen::Vector3d n = options_.mounting.col(2);
  const Eigen::Vector3d along = axis_.dot(v) * axis_;
  const double a = n.dot(v - along);
  const double b = -n.dot(axis_.cross(v));
  const double d = n.dot(options_.lever_arm - along);
  const double h = std::sqrt(a * a + b * b);
  if (h <= kOnAxis * v.norm() && std::abs(d) <= kOnAxis * v.norm())
    return seenInFan(options_.theta.first, v); // by every line
  if (!(std::abs(d) <= h))
    return std::nullopt; // nearer to the axis than the fan ever comes
  const double middle = portableAtan2(b, a);
  const double half = portableAcos(d / h);
  const auto one = seenAt(middle - half, v);
  const auto other = seenAt(middle + half, v);
  if (!one || !other)
    return one ? one : other;
  return one->pixel.row <= other->pixel.row ? one : other;
}

Ray
DrivenScannerProjection::ray(const Pixel& pixel) const
{
  return scanner_.ray(pixel.row, pixel.col);
}

} // namespace pcl6d
