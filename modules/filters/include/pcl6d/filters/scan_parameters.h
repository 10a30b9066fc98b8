// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/parameter.h>
#include <pcl6d/common/points.h>

#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

class OptionList;

/** \return the given option, else the derived value */
Parameter
orDerived(const std::optional<double>& option, const Parameter& otherwise);

/** \return a derived value, rounded to a number of digits fit for typing */
Parameter
derivedParameter(double value, const std::string& why, int digits = 2);

/** \brief Given options of range gate and reduction of scans. */
struct ScanParameterOptions {
  std::optional<double> min_range;    ///< [m]
  std::optional<double> max_range;    ///< [m] >= min_range
  std::optional<double> voxel;        ///< [m] finite and > 0
  std::optional<double> line_spacing; ///< [m] of the lines of a scan; finite and >= 0
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Range gate and reduction of scans. */
struct ScanParameters {
  Parameter min_range;     ///< [m]
  Parameter max_range;     ///< [m] infinite only if given
  Parameter voxel;         ///< [m]
  Parameter line_spacing;  ///< [m] of the scans used for the derivation
  double median_range = 0; ///< [m] of the scans used for the derivation
};

/** \brief Adds the options of range gate and reduction to a list.
 * \param[in,out] options the variables set by the options
 * \param[in,out] used the values used in a run */
void
describe(ScanParameterOptions& options, ScanParameters& used, OptionList& list);

/** \brief Fills in the options left open by the user, from a few scans. Derived values are rounded
 * to two digits (max_range below a code: four; line_spacing: three): a run with the printed values
 * is identical. \ingroup filters */
ScanParameters
deriveScanParameters(const ScanParameterOptions& options,
                     const std::vector<Points>& scans);

} // namespace pcl6d
