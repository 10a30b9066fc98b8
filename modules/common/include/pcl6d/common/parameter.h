// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A value, given or derived from the scans, with the reason. */
struct Parameter {
  double value = 0;
  bool given = false; ///< by the user, not derived
  std::string why;    ///< of a derived value: the numbers used
};

} // namespace pcl6d
