// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Standard deviation of a sensor's noise over range: almost constant for a
 * lidar, growing with the square of the range for a structured-light camera.
 * Interpolated between known ranges, constant beyond them. \ingroup
 * plane_segmentation */
class NoiseModel {
public:
  /** \brief Constant noise. \param[in] sigma [m] */
  explicit NoiseModel(double sigma = 0) : ranges_{0}, sigmas_{sigma} {}

  /** \brief Estimates noise from residuals: their lower quartiles within bins of equal
   * counts, as rough surfaces add to the sensor's noise.
   * \param[in] ranges [m] from the sensor
   * \param[in] residuals [m] of a point to the plane of its neighbourhood, made
   * unbiased
   * \param[in] least [m] lower limit of the noise */
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
