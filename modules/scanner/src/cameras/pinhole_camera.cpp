// SPDX-License-Identifier: BSD-3-Clause
#include "size_limits.h"

#include <pcl6d/common/require.h>
#include <pcl6d/scanner/pinhole_camera.h>

#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <string>

namespace pcl6d {
using namespace scanner;

namespace {
constexpr int kMostPixels = 65536; // along one side
} // namespace

Eigen::Matrix3d
CameraIntrinsics::matrix() const
{
  Eigen::Matrix3d K;
  K << fx, skew, cx, 0, fy, cy, 0, 0, 1;
  return K;
}

void
CameraIntrinsics::validate() const
{
  const std::string side = "in [1, " + std::to_string(kMostPixels) + "]";
  require(width >= 1 && width <= kMostPixels, "width", width, side);
  require(height >= 1 && height <= kMostPixels, "height", height, side);
  requireImageSize(height, width);
  require(fx > 0 && std::isfinite(fx), "fx", fx, "> 0 and finite");
  require(fy > 0 && std::isfinite(fy), "fy", fy, "> 0 and finite");
  require(std::isfinite(cx), "cx", cx, "finite");
  require(std::isfinite(cy), "cy", cy, "finite");
  require(std::isfinite(skew), "skew", skew, "finite");
  for (std::size_t i = 0; i < k.size(); ++i)
    require(std::isfinite(k[i]), ("k" + std::to_string(i + 1)).c_str(), k[i], "finite");
  for (std::size_t i = 0; i < p.size(); ++i)
    require(std::isfinite(p[i]), ("p" + std::to_string(i + 1)).c_str(), p[i], "finite");
}

PinholeCamera::PinholeCamera(const CameraIntrinsics& intrinsics)
: intrinsics_(intrinsics)
{
  intrinsics_.validate();
  largest_radius_ = findLargestRadius();
}

PinholeCamera::Radial
PinholeCamera::radial(double r2) const
{
  const auto& k = intrinsics_.k;
  const double n = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[2]));
  const double d = 1 + r2 * (k[3] + r2 * (k[4] + r2 * k[5]));
  const double dn = k[0] + r2 * (2 * k[1] + r2 * 3 * k[2]);
  const double dd = k[3] + r2 * (2 * k[4] + r2 * 3 * k[5]);
  if (!(d > 0)) // a pole: the model ends before the pole
    return {0, -1};
  return {n / d, (dn * d - n * dd) / (d * d)};
}

double
PinholeCamera::findLargestRadius() const
{
  constexpr double kFarthest = 100;
  constexpr double kStep = 0.01;
  // d(r f)/dr = f + 2 r2 df/dr2
  const auto rises = [this](double r) {
    const Radial at = radial(r * r);
    return at.f > 0 && at.f + 2 * r * r * at.df > 0;
  };
  double low = 0;
  while (low < kFarthest && rises(low + kStep))
    low += kStep;
  if (low >= kFarthest)
    return std::numeric_limits<double>::infinity();
  double high = low + kStep;
  for (double middle = (low + high) / 2; low < middle && middle < high;
       middle = (low + high) / 2)
    (rises(middle) ? low : high) = middle;
  return low;
}

Eigen::Vector2d
PinholeCamera::distort(const Eigen::Vector2d& xy) const
{
  const auto [p1, p2] = intrinsics_.p;
  const double x = xy.x(), y = xy.y();
  const double r2 = x * x + y * y;
  const double f = radial(r2).f;
  return {x * f + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
          y * f + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

Eigen::Matrix2d
PinholeCamera::jacobian(const Eigen::Vector2d& xy) const
{
  const auto [p1, p2] = intrinsics_.p;
  const double x = xy.x(), y = xy.y();
  const Radial at = radial(x * x + y * y);
  const double mixed = 2 * (x * y * at.df + p1 * x + p2 * y);
  Eigen::Matrix2d J;
  J << at.f + 2 * x * x * at.df + 2 * p1 * y + 6 * p2 * x, mixed, //
      mixed, at.f + 2 * y * y * at.df + 6 * p1 * y + 2 * p2 * x;
  return J;
}

std::optional<Eigen::Vector2d>
PinholeCamera::project(const Eigen::Vector3d& point) const
{
  if (!(point.z() > 0))
    return std::nullopt;
  const Eigen::Vector2d xy = point.head<2>() / point.z();
  if (!(xy.squaredNorm() <= largest_radius_ * largest_radius_))
    return std::nullopt;
  const Eigen::Vector2d at = distort(xy);
  return Eigen::Vector2d(intrinsics_.fx * at.x() + intrinsics_.skew * at.y() +
                             intrinsics_.cx,
                         intrinsics_.fy * at.y() + intrinsics_.cy);
}

std::optional<Eigen::Vector2d>
PinholeCamera::fixedPoint(const Eigen::Vector2d& distorted) const
{
  constexpr int kMostSteps = 100;
  constexpr double kSmallStep = 1e-10;
  const auto [p1, p2] = intrinsics_.p;
  Eigen::Vector2d at = distorted;
  for (int i = 0; i < kMostSteps; ++i) {
    const double x = at.x(), y = at.y();
    const double r2 = at.squaredNorm();
    const double f = radial(r2).f;
    if (!(f > 0))
      return std::nullopt;
    const Eigen::Vector2d bend(2 * p1 * x * y + p2 * (r2 + 2 * x * x),
                               p1 * (r2 + 2 * y * y) + 2 * p2 * x * y);
    const Eigen::Vector2d next = (distorted - bend) / f;
    const double step = (next - at).norm();
    at = next;
    if (step < kSmallStep)
      break;
  }
  return at;
}

std::optional<Eigen::Vector2d>
PinholeCamera::undistort(const Eigen::Vector2d& pixel) const
{
  constexpr int kMostSteps = 20;
  constexpr double kClose = 1e-14; // a few last bits of coordinates about 1
  const double yd = (pixel.y() - intrinsics_.cy) / intrinsics_.fy;
  const Eigen::Vector2d distorted(
      (pixel.x() - intrinsics_.cx - intrinsics_.skew * yd) / intrinsics_.fx, yd);
  auto xy = fixedPoint(distorted);
  if (!xy)
    return std::nullopt;
  // The fixed point comes nearer by a factor per step, slowly where the model ends.
  Eigen::Vector2d error = distort(*xy) - distorted;
  for (int i = 0; i < kMostSteps && error.squaredNorm() > 0; ++i) {
    const Eigen::Vector2d next = *xy - jacobian(*xy).inverse() * error;
    const Eigen::Vector2d next_error = distort(next) - distorted;
    if (!(next_error.squaredNorm() < error.squaredNorm()))
      break;
    xy = next;
    error = next_error;
  }
  const bool found = error.norm() <= kClose * (1 + distorted.norm()) &&
                     xy->squaredNorm() <= largest_radius_ * largest_radius_;
  return found ? xy : std::nullopt;
}

bool
PinholeCamera::isInImage(const Eigen::Vector2d& pixel) const
{
  return pixel.x() >= -0.5 && pixel.y() >= -0.5 &&
         pixel.x() < intrinsics_.width - 0.5 && pixel.y() < intrinsics_.height - 0.5;
}

} // namespace pcl6d
