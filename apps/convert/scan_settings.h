// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/memory_budget.h"

#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/scan_writer.h>

#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief The command line of `convert scans`, interpreted. */
struct ScanSettings {
  std::string input;        ///< a file or a folder
  std::string output;       ///< a file; a folder for a folder
  ScanWriterOptions writer; ///< with its format
  ScanFolderOptions folder; ///< format of a file, too
  std::string encoding = "auto";
  bool full = false; ///< join the scans of a folder into one file
  MemoryOption memory;
  bool quiet = false;
  std::string without_effect; ///< options that do not count here, in words
};

/** \return false when the program has nothing more to do
 * \throws UsageError, boost::program_options::error the arguments break a rule */
bool
parseScanSettings(const std::vector<std::string>& arguments, ScanSettings& settings);

} // namespace pcl6d::app
