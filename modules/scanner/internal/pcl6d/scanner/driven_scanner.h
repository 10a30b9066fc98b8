// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/scanner_model.h>

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Axis of the drive of a 2D scanner. */
enum class Drive {
  kPitching, ///< y: theta > 0 looks up
  kRolling,  ///< x: positive towards the left side up
  kYawing    ///< z: counter-clockwise seen from above
};

/** \brief How the drive moves. */
enum class DriveMotion {
  kStepped,   ///< the drive stands still during a line
  kContinuous ///< the drive turns at constant speed during the line
};

/** \brief A 2D scanner on a drive. With one line it is a static 2D scanner, with one
 * line of one sample a 1D scanner. */
struct DrivenScannerOptions {
  Drive drive = Drive::kYawing;
  DriveMotion motion = DriveMotion::kStepped;
  AngleRange beam;  ///< mirror angle alpha, one per sample
  AngleRange theta; ///< drive angle at the start of a line, one per line
  Eigen::Matrix3d mounting = Eigen::Matrix3d::Identity(); ///< R_m, a rotation
  Eigen::Vector3d lever_arm = Eigen::Vector3d::Zero();    ///< o, axis to optical centre
  Eigen::Vector3d axis_position = Eigen::Vector3d::Zero(); ///< c, in the scanner frame
  double line_period = 1.0 / 75; ///< [s] from line to line; > 0 (SICK LMS: 75 Hz)
  /** [s] from sample to sample, >= 0; the samples of a line fit into line_period.
   * Empty: period of a mirror that turns once per line_period. */
  std::optional<double> sample_period;
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \return an upright fan in full turns about the vertical: 360 lines of 121 samples, 1
 * deg apart, from 60 deg below the horizon to 60 deg above */
DrivenScannerOptions
rotatingScanner();

/** \return Kurt3D's scanner: 241 lines of 181 samples, 120 deg high, 180 deg wide */
DrivenScannerOptions
pitchingScanner();

/** \brief 3D scanner from a 2D scanner on a drive (book 2.2): p = c + R_drive(theta) (o
 * + R_m r (cos alpha, sin alpha, 0)). \ingroup scanner */
class DrivenScanner : public ScannerModel {
public:
  /** \throws BadArgument see DrivenScannerOptions::validate() */
  explicit DrivenScanner(const DrivenScannerOptions& options = rotatingScanner());

  /** \brief A drive with measured angles.
   * \param[in] theta drive angle at the start of each line [rad], in place of
   * options.theta; a continuous drive keeps the speed of the line before during the
   * last line
   * \param[in] times starts of the lines [s], increasing; empty: options.line_period
   * apart
   * \throws BadArgument no angle, an angle that is not finite, not one time per angle,
   * or times that do not increase */
  DrivenScanner(const DrivenScannerOptions& options,
                const std::vector<double>& theta,
                const std::vector<double>& times = {});

  int
  numLines() const override;
  int
  samplesPerLine() const override;
  Ray
  ray(int line, int sample) const override;
  double
  time(int line, int sample) const override;
  double
  duration() const override;

private:
  struct Line {
    double theta = 0;        // [rad] at its start
    double turn = 0;         // [rad] until the next line; 0 of a stepped drive
    double start = 0;        // [s]
    double period = 0;       // [s] until the next line
    Eigen::Matrix3d R_drive; // at its start
  };
  void
  addLines(const DrivenScannerOptions& options,
           const std::vector<double>& theta,
           const std::vector<double>& starts);

  Drive drive_;
  Eigen::Vector3d lever_arm_, axis_position_;
  double sample_period_; // [s]
  std::vector<Line> lines_;
  std::vector<Eigen::Vector3d> mirrored_; // R_m (cos alpha, sin alpha, 0) per sample
};

} // namespace pcl6d
