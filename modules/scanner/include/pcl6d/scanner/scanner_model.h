// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/light_source.h>
#include <pcl6d/scanner/ray.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What all scanners have in common: the way from (line, sample) to a ray in the
 * scanner's frame (x forward, y left, z up) and to the time of its measurement. An
 * organized scan has one row per line. \ingroup scanner */
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
  /** \return when the sample is measured [s], from the start of the scan; in
   * [0, duration()). Not always in the order of the samples: a spinning lidar fires its
   * lines in turns */
  virtual double
  time(int line, int sample) const = 0;
  /** \return [s] from the start of a scan to that of the next one, if the scanner goes
   * on without a pause; > 0 */
  virtual double
  duration() const = 0;
  /** \return where the light comes from if not from where the scanner looks, which
   * casts shadows: in a triangulating scanner; null: there is no such place */
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
  /** \return from one angle to the next [rad]; 0 of a single angle */
  double
  step() const
  {
    return count > 1 ? (last - first) / (count - 1) : 0;
  }
};

} // namespace pcl6d
