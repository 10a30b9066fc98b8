// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/scanner/range_scan.h>

#include <memory>
#include <string>
#include <vector>

namespace pcl6d {

/** \brief A scanner ready to use. */
struct ScannerPreset {
  std::string name;
  std::string description; ///< one line: device, field of view, size, time
  std::shared_ptr<const ScannerModel> scanner;
  RangeOptions range; ///< how such a device measures
};

/** \return the names that scannerByName() knows */
std::vector<std::string>
scannerNames();

/** \throws BadArgument the name is not known, with those that are \ingroup scanner */
ScannerPreset
scannerByName(const std::string& name);

} // namespace pcl6d
