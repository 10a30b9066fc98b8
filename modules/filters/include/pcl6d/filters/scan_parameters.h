// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A value that was given, or derived from the scans, and why. */
struct Parameter {
  double value = 0;
  bool given = false; ///< by the user, not derived
  std::string why;    ///< of a derived value: the numbers that it follows from
};

/** \return the option as given, else what was derived */
Parameter
orDerived(const std::optional<double>& option, const Parameter& otherwise);

/** \return a derived value, rounded to so many digits: as a user would type it */
Parameter
derivedParameter(double value, const std::string& why, int digits = 2);

/** \brief Range gate and reduction of scans as far as they are given. */
struct ScanParameterOptions {
  std::optional<double> min_range;    ///< [m]
  std::optional<double> max_range;    ///< [m] >= min_range
  std::optional<double> voxel;        ///< [m] finite and > 0
  std::optional<double> line_spacing; ///< [m] of the lines of a scan; finite and >= 0
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Range gate and reduction of scans. */
struct ScanParameters {
  Parameter min_range;     ///< [m]
  Parameter max_range;     ///< [m] infinite only if given so
  Parameter voxel;         ///< [m]
  Parameter line_spacing;  ///< [m] of the scans that they were derived from
  double median_range = 0; ///< [m] of the scans that they were derived from
};

/** \brief Fills in what the user left open, from some scans. Derived values are rounded to
 * two digits (max_range below a code: four; line_spacing: three), so that giving the printed value gives the
 * same run. \ingroup filters */
ScanParameters
deriveScanParameters(const ScanParameterOptions& options,
                     const std::vector<Points>& scans);

} // namespace pcl6d
