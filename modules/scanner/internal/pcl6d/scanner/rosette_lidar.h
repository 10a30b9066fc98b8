// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/scanner_model.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Field of view of a rosette. */
enum class RosetteShape {
  kDisc, ///< an ellipse ahead, by two turning prisms
  kBelt  ///< all around the vertical, by a turning head with a nodding mirror
};

/** \brief Lidars with beams along curves that do not close within a scan. */
struct RosetteLidarOptions {
  RosetteShape shape = RosetteShape::kDisc;
  /** [turns/s] of the first prism, or of the head; not 0 */
  double first_rate = 7294.0 / 60;
  /** [turns/s] of the second prism, or nods of the mirror; not 0 */
  double second_rate = -4664.0 / 60;
  double half_width = 0.6; ///< [rad] of the ellipse; in (0, pi / 2]; unused for a belt
  double lowest = -0.6;    ///< [rad] elevation; within 90 degrees of the horizon
  double highest = 0.6;    ///< [rad] elevation; above lowest
  /** number of lasers, >= 1. Their curves are turned by equal parts of a turn, in a
   * disc about its middle, in a belt about the vertical */
  int lasers = 1;
  int samples = 24000;      ///< of each laser in a scan, at equal times; >= 1
  double scan_period = 0.1; ///< [s] > 0
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Lidar with a rosette: one line per laser, samples in the order of time.
 *
 * Disc: with the angles a = 2 pi first_rate t and b = 2 pi second_rate t of two prisms
 * of equal power the beam is deflected by (cos a + cos b) / 2 upward and (sin a + sin
 * b) / 2 to the left, in units of the half height and the half width (small angles; a
 * beam through the middle at each crossing). Belt: azimuth a, elevation between lowest
 * and highest as (1 - cos b) / 2. Each scan starts at t = 0: the curves of two scans
 * differ only by the motion of the scanner. Source: J. Lin, F. Zhang, "Loam livox",
 * ICRA 2020, figure 2 (rates of the prisms). \ingroup scanner */
class RosetteLidar : public ScannerModel {
public:
  /** \throws BadArgument see RosetteLidarOptions::validate() */
  explicit RosetteLidar(const RosetteLidarOptions& options = {});

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
  RosetteLidarOptions options_;
};

} // namespace pcl6d
