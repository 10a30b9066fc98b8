// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/driven_scanner.h>
#include <pcl6d/scanner/range_projection.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Projects points into the measuring order of a driven 2D scanner: rows are its
 * lines, columns the samples of a line.
 *
 * A point p lies in the plane of the fan, which the drive turned by theta: n .
 * (R_drive(-theta) (p - c) - o) = 0 with n = R_m e_z. This gives a cos(theta) + b
 * sin(theta) = d with two solutions, and the mirror angle follows. The result is the
 * pixel with the nearest angles, at most half a step off. If two lines see a point (a
 * full roll), the earlier line counts. The drive's axis is visible to every line: only
 * the order separates points on the axis, see RangeImage::inOrder().
 * \note Geometry: book 2.2. \ingroup scanner */
class DrivenScannerProjection : public RangeProjection {
public:
  /** \throws BadArgument as DrivenScannerOptions::validate(), or a fan of less than two
   * lines or samples, or too many pixels */
  explicit DrivenScannerProjection(const DrivenScannerOptions& options);

  int
  rows() const override;
  int
  cols() const override;
  std::optional<PixelRange>
  project(const Eigen::Vector3d& point) const override;
  Ray
  ray(const Pixel& pixel) const override;

private:
  std::optional<PixelRange>
  seenAt(double theta, const Eigen::Vector3d& from_axis) const;
  std::optional<PixelRange>
  seenInFan(double theta, const Eigen::Vector3d& from_axis) const;

  DrivenScannerOptions options_;
  DrivenScanner scanner_;
  Eigen::Vector3d axis_;
  std::vector<double> turn_; // [rad] of the drive from the line's start, per sample
};

} // namespace pcl6d
