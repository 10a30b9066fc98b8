// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/light_source.h>
#include <pcl6d/scanner/ray.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Base class of scanners: maps (line, sample) to a ray in the scanner's frame
 * (x forward, y left, z up) and to the time of its measurement. An organized scan has
 * one row per line. \ingroup scanner */
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
  /** \return time of the sample [s], from the start of the scan; in [0, duration()). Not
   * always in the order of the samples: a spinning lidar fires its lines in turns */
  virtual double
  time(int line, int sample) const = 0;
  /** \return time [s] from the start of a scan to the start of the next, without a
   * pause; > 0 */
  virtual double
  duration() const = 0;
  /** \return a light source apart from the receiver, which casts shadows: in a
   * triangulating scanner; null: the light comes from the scanner */
  virtual const LightSource*
  lightSource() const
  {
    return nullptr;
  }
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
  /** \return difference of successive angles [rad]; 0 of a single angle */
  double
  step() const
  {
    return count > 1 ? (last - first) / (count - 1) : 0;
  }
};

} // namespace pcl6d
