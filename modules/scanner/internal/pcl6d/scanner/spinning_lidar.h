// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/scanner_model.h>

#include <Eigen/Core>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A head with several lasers, one above another, which spins about the vertical. */
struct SpinningLidarOptions {
  std::vector<double> elevations; ///< [rad] one per laser, in the order of the lines
  /** [s] >= 0 delay of each laser's shot after the first shot of the column, in the order
   * of the lines; each within a column's share of the turn. Empty: simultaneous. */
  std::vector<double> fire_times;
  int columns = 1800;       ///< per turn, samples of a line
  double turn_period = 0.1; ///< [s] > 0
  double first_azimuth = 0; ///< [rad] of column 0, counter-clockwise from ahead
  bool clockwise = true;    ///< sense of the turn seen from above
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \return similar to a Velodyne VLP-16: 16 lines from +15 to -15 deg with its firing
 * order, 1800 columns, 10 turns a second */
SpinningLidarOptions
vlp16Lidar();

/** \brief Spinning multi-line lidar: one line per laser, one turn per scan. The head
 * turns between the shots of a column: a column is not a straight line. With e the
 * laser's elevation and a the azimuth at the time of the shot the direction is (cos e
 * cos a, cos e sin a, sin e). \ingroup scanner */
class SpinningLidar : public ScannerModel {
public:
  /** \throws BadArgument see SpinningLidarOptions::validate() */
  explicit SpinningLidar(const SpinningLidarOptions& options = vlp16Lidar());

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
  SpinningLidarOptions options_;
  std::vector<Eigen::Vector2d> heights_; // cos and sin of the elevations
};

} // namespace pcl6d
