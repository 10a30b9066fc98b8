// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/scanner/ray_caster.h>

#include <Eigen/Core>

#include <vector>

namespace pcl6d {

/** \brief What all laser scanners have in common: the way from (line, sample) to a ray
 * in the scanner's frame (x forward, y left, z up). An organized scan has one row per
 * line. \ingroup scanner */
class ScannerModel {
public:
  virtual ~ScannerModel() = default;
  virtual int
  numLines() const = 0;
  virtual int
  samplesPerLine() const = 0;
  /** \return the beam of a sample; its range counts from the ray's origin */
  virtual Ray
  ray(int line, int sample) const = 0;
};

/** \brief Equally spaced angles, both ends included. */
struct AngleRange {
  double first = 0; ///< [rad]
  double last = 0;  ///< [rad]
  int count = 1;    ///< >= 1

  double
  angle(int i) const
  {
    return count > 1 ? first + (last - first) * i / (count - 1) : first;
  }
};

/** \brief The axis about which a 2D scanner is driven. */
enum class Drive {
  kPitching, ///< y: theta > 0 looks up
  kRolling,  ///< x: positive towards the left side up
  kYawing    ///< z: counter-clockwise seen from above
};

/** \brief A 2D scanner on a drive. */
struct DrivenScannerOptions {
  Drive drive = Drive::kYawing;
  AngleRange beam;  ///< mirror angle alpha, one per sample
  AngleRange theta; ///< drive angle, one per line
  Eigen::Matrix3d mounting = Eigen::Matrix3d::Identity(); ///< R_m, a rotation
  Eigen::Vector3d lever_arm = Eigen::Vector3d::Zero();    ///< o, axis to optical centre
  Eigen::Vector3d axis_position = Eigen::Vector3d::Zero(); ///< c, in the scanner frame
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \return full turns about the vertical of a fan that stands upright: 360 lines of
 * 121 samples, 1 deg apart, from 60 deg below the horizon to 60 deg above */
DrivenScannerOptions
rotatingScanner();

/** \return Kurt3D's scanner: 241 lines of 181 samples, 120 deg high, 180 deg wide */
DrivenScannerOptions
pitchingScanner();

/** \brief 3D scanner made of a 2D scanner and a drive (book 2.2):
 * p = c + R_drive(theta) (o + R_m r (cos alpha, sin alpha, 0)). \ingroup scanner */
class DrivenScanner : public ScannerModel {
public:
  /** \throws BadArgument see DrivenScannerOptions::validate() */
  explicit DrivenScanner(const DrivenScannerOptions& options = rotatingScanner());

  int
  numLines() const override;
  int
  samplesPerLine() const override;
  Ray
  ray(int line, int sample) const override;

private:
  Eigen::Vector3d lever_arm_, axis_position_;
  std::vector<Eigen::Matrix3d> drive_;    // R_drive per line
  std::vector<Eigen::Vector3d> mirrored_; // R_m (cos alpha, sin alpha, 0) per sample
};

} // namespace pcl6d
