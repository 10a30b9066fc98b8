// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/line.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/projection_scanner.h>

#include <cmath>
#include <limits>

namespace pcl6d {
namespace {
constexpr double kUnlit = std::numeric_limits<double>::quiet_NaN();
}

void
StripeProjectorOptions::validate() const
{
  require(baseline != 0 && std::isfinite(baseline),
          "projector.baseline",
          baseline,
          "finite and not 0");
  require(std::abs(vergence) <= M_PI / 4,
          "projector.vergence",
          vergence,
          "within pi / 4 of 0");
  require(columns > 0, "projector.columns", columns, "> 0");
  require(focal_length > 0 && std::isfinite(focal_length),
          "projector.focal_length",
          focal_length,
          "> 0 and finite");
  require(height > 0 && std::isfinite(height), "projector.height", height, "> 0");
}

StripeProjector::StripeProjector(const StripeProjectorOptions& options)
: options_(options)
{
  options.validate();
  // Towards the side of the camera.
  const SinCos turn =
      portableSinCos(options.baseline > 0 ? options.vergence : -options.vergence);
  Eigen::Matrix3d R; // Ry(-turn) of the camera's axes: z ahead goes to the left
  R << turn.cos, 0, -turn.sin, 0, 1, 0, turn.sin, 0, turn.cos;
  T_scanner_projector_.linear() = scannerFromCameraAxes() * R;
  T_scanner_projector_.translation() =
      scannerFromCameraAxes() * Eigen::Vector3d(options.baseline, 0, 0);
}

Eigen::Vector3d
StripeProjector::position() const
{
  return T_scanner_projector_.translation();
}

double
StripeProjector::column(const Eigen::Vector3d& point) const
{
  const Eigen::Vector3d p = T_scanner_projector_.inverse() * point;
  if (!(p.z() > 0))
    return kUnlit;
  return options_.focal_length * p.x() / p.z() + (options_.columns - 1) / 2.0;
}

bool
StripeProjector::lights(const Eigen::Vector3d& point) const
{
  const double at = column(point);
  const Eigen::Vector3d p = T_scanner_projector_.inverse() * point;
  return at >= -0.5 && at <= options_.columns - 0.5 &&
         2 * std::abs(p.y()) <= options_.height * p.z();
}

Eigen::Hyperplane<double, 3>
StripeProjector::lightPlane(double column) const
{
  const double x = (column - (options_.columns - 1) / 2.0) / options_.focal_length;
  const Eigen::Vector3d normal =
      T_scanner_projector_.linear() * Eigen::Vector3d(1, 0, -x).normalized();
  return {normal, position()};
}

ProjectionScanner::ProjectionScanner(const CameraIntrinsics& camera,
                                     const StripeProjectorOptions& projector,
                                     int num_patterns,
                                     double picture_period)
: CameraScanner(camera, num_patterns * picture_period), projector_(projector)
{
  require(num_patterns > 0, "num_patterns", num_patterns, "> 0");
}

const StripeProjector*
ProjectionScanner::lightSource() const
{
  return &projector_;
}

double
ProjectionScanner::range(int line, int sample, double column) const
{
  const Eigen::Hyperplane<double, 3> plane = projector_.lightPlane(column);
  const Ray axis = ray(line, sample);
  const auto lit = meetOf(lineAlong(axis.origin, axis.direction),
                          PlaneEquation{plane.normal(), -plane.offset()});
  if (!lit)
    return kUnlit;
  const double range = axis.direction.dot(*lit - axis.origin);
  return range > 0 ? range : kUnlit;
}

} // namespace pcl6d
