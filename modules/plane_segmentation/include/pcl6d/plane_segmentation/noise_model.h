// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief How much a sensor errs, over range: that of a lidar is almost constant, that
 * of a structured-light camera grows with the square of the range. Between the ranges
 * where it is known it is interpolated, beyond it stays. \ingroup plane_segmentation */
class NoiseModel {
public:
  /** \brief The same at any range. \param[in] sigma [m] */
  explicit NoiseModel(double sigma = 0) : ranges_{0}, sigmas_{sigma} {}

  /** \brief Learns from residuals: their lower quartiles within bins of equal counts, as
   * some places are rough and not the sensor's fault.
   * \param[in] ranges [m] from the sensor
   * \param[in] residuals [m] of a point to the plane of its neighbourhood, made unbiased
   * \param[in] least [m] the noise is not taken for less */
  NoiseModel(const std::vector<double>& ranges,
             const std::vector<double>& residuals,
             double least);

  /** \return the standard deviation [m] at a range [m] */
  double
  at(double range) const;

private:
  std::vector<double> ranges_; // ascending
  std::vector<double> sigmas_;
};

} // namespace pcl6d
