// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/dataset_layout.h>
#include <pcl6d/io/scan_folder.h>

#include <optional>
#include <string>
#include <vector>

/** \file The files of the scans in a folder. */
namespace pcl6d::io {

/** \brief The scans of a folder, in one format. */
struct FoundScans {
  std::vector<std::filesystem::path> files; ///< in natural order
  ScanFormat format = ScanFormat::kAuto;
  std::string entered; ///< the subfolder with the scans; empty: the folder itself
  /** folder of the scans, then the given folder and the folder of the sequence, if different:
   * the order of the search for poses, stamps and calibration */
  std::vector<std::filesystem::path> folders;
  std::optional<DatasetLayout> layout; ///< of a known data set
};

/** \brief Finds the scans of a folder: directly inside, else in a subfolder of a usual name,
 * else in the only sequence of a data set below.
 * \throws IoFailed the folder is missing, holds no scans, scans of several formats, or several
 * folders with scans */
FoundScans
findScans(const std::filesystem::path& folder, const ScanFolderOptions& options);

} // namespace pcl6d::io
