// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/range_scan.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A scanner ready to use. */
struct ScannerPreset {
  std::string name;
  std::string description; ///< one line: device, field of view, size, time
  std::shared_ptr<const ScannerModel> scanner;
  RangeOptions range; ///< ranges and errors of the device
};

/** \return the names accepted by scannerByName() */
std::vector<std::string>
scannerNames();

/** \return ScannerPreset::description \throws BadArgument the name is not known */
std::string
scannerDescription(const std::string& name);

/** \param[in] resolution [rad] in (0, pi / 2]: angle between neighbouring samples and lines,
 * of a spinning lidar between its columns, of a camera between pixels at the centre of its
 * image, of a rosette the root of the mean area per point; empty: resolution of the device
 * \throws BadArgument the name is not known (the message lists the known names), the
 * resolution is invalid, or the scan would take too much memory (stated in the message)
 * \ingroup scanner */
ScannerPreset
scannerByName(const std::string& name, std::optional<double> resolution = {});

} // namespace pcl6d
