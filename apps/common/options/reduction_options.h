// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/options/listed_options.h"

#include <pcl6d/filters/scan_parameters.h>

namespace pcl6d::app {

/** \brief The options of range gate and reduction, for programs that reduce scans.
 * \param[out] parameters the variables set by the options */
inline void
addReductionOptions(OptionTable& table, ScanParameterOptions& parameters)
{
  OptionList options;
  ScanParameters unused;
  describe(parameters, unused, options);
  for (const OptionSpec& option : options.rows())
    addOption(table, option);
}

} // namespace pcl6d::app
