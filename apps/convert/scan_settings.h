// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/process/memory_budget.h"

#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/scan_writer.h>

#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief The command line of `convert scans`, interpreted. */
struct ScanSettings {
  std::string input;           ///< a file or a folder; an E57 file counts as a folder
  std::string output;          ///< a file; a folder for an input folder, unless E57
  std::string format = "auto"; ///< of the output, as given
  bool to_e57 = false;         ///< writes one E57 file; else see writer.format
  ScanWriterOptions writer;    ///< with its format
  ScanFolderOptions folder;    ///< format of a file, too
  std::string encoding = "auto";
  int epsg = 0;      ///< code of the coordinate system; 0: from the run, if any
  bool full = false; ///< join the scans of a folder into one file
  MemoryOption memory;
  bool quiet = false;
  std::string without_effect; ///< options without effect, in words
};

/** \return how a single file is read */
inline ScanReaderOptions
readingOf(const ScanSettings& settings)
{
  ScanReaderOptions reading;
  reading.format = settings.folder.format;
  reading.columns = settings.folder.columns;
  reading.bin_layout = settings.folder.bin_layout;
  return reading;
}

/** \return false: --help or --version was given, and the program is to end
 * \throws UsageError, boost::program_options::error the arguments break a rule */
bool
parseScanSettings(const std::vector<std::string>& arguments, ScanSettings& settings);

/** \return the code of the coordinate system given to a run (--epsg); 0: not given, or
 * the input is no run */
int
epsgOfRun(const std::string& input);

} // namespace pcl6d::app
