// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/options/verbs.h"

#include <pcl6d/io/scan_folder.h>
#include <pcl6d/simulation/intruders.h>

#include <optional>
#include <string>

namespace pcl6d::app {

constexpr const char* kIntrude = "intrude"; ///< the job's name

/** \brief The command line of pcl_slam6d_simulate intrude. */
struct IntrudeSettings {
  std::string input; ///< folder of scans, or a run
  ScanFolderOptions scans;
  std::string poses;            ///< file with the poses; empty: the folder's poses
  std::string up = "auto";      ///< auto, or x,y,z in the frame of the poses
  std::optional<double> period; ///< [s] from scan to scan; default: the stamps, else 1
  IntruderOptions intruders;
  std::string out;
  bool force = false;
  bool quiet = false;
};

/** \return false after --help \throws UsageError, boost::program_options::error an
 * option is invalid */
bool
parseIntrudeSettings(const Arguments& arguments, IntrudeSettings& settings);

/** \brief People and cars walk through recorded scans. \return the exit code */
int
runIntrude(const Arguments& arguments);

} // namespace pcl6d::app
