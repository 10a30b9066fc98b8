// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/camera_scanner.h>
#include <pcl6d/scanner/light_source.h>
#include <pcl6d/scanner/scanner_model.h>

#include <Eigen/Geometry>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A projector of stripes beside the camera. */
struct StripeProjectorOptions {
  double baseline = 0.2;     ///< [m] to the right of the camera; not 0
  double vergence = 0;       ///< [rad] towards the camera's axis, within 45 deg
  int columns = 1024;        ///< > 0
  double focal_length = 900; ///< [px] > 0
  double height = 0.6;       ///< height of the picture over its distance, > 0
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Projector of stripes: each column is a plane of light. Columns are real
 * numbers [px]; the middle column is (columns - 1) / 2. \ingroup scanner */
class StripeProjector : public LightSource {
public:
  /** \throws BadArgument see StripeProjectorOptions::validate() */
  explicit StripeProjector(const StripeProjectorOptions& options = {});

  Eigen::Vector3d
  position() const override;
  bool
  lights(const Eigen::Vector3d& point) const override;

  /** \return the column that lights a point of the scanner's frame, possibly outside
   * the picture; NaN if the point is behind the projector */
  double
  column(const Eigen::Vector3d& point) const;

  /** \return the plane n.X = rho of a column, in the scanner's frame */
  Eigen::Hyperplane<double, 3>
  lightPlane(double column) const;

private:
  StripeProjectorOptions options_;
  Eigen::Isometry3d T_scanner_projector_; // projector in camera axes: z ahead, x right
};

/** \brief Structured light scanner (book 2.2.4): a camera intersects its rays with the
 * planes of light of a stripe projector. \ingroup scanner */
class ProjectionScanner : public CameraScanner {
public:
  /** \param[in] num_patterns number of pictures per scan, > 0
   * \param[in] picture_period [s] from picture to picture, > 0
   * \throws BadArgument an option is invalid */
  ProjectionScanner(const CameraIntrinsics& camera,
                    const StripeProjectorOptions& projector,
                    int num_patterns,
                    double picture_period);

  const StripeProjector*
  lightSource() const override;

  /** \return the range [m] along a pixel's ray to the plane of a column; NaN without
   * intersection in front of the camera */
  double
  range(int line, int sample, double column) const;

private:
  StripeProjector projector_;
};

} // namespace pcl6d
