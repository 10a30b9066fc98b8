// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/app.h"
#include "common/progress_bar.h"

#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/run/registered_scans.h>
#include <pcl6d/sources/bag.h>
#include <pcl6d/sources/open_source.h>

#include <optional>
#include <sstream>
#include <string>

namespace pcl6d::app {

/** \return whether the file contains several scans, such as E57, PTX or a recording */
inline bool
holdsScans(const std::filesystem::path& path)
{
  return isSourceFile(path) && (isBag(path) || !std::filesystem::is_directory(path));
}

/** \brief Opens the scans of a folder, raw or of a finished run, or of a file with
 * several scans.
 * \throws UsageError the options select no scan, or give poses for a run
 * \throws IoFailed as RegisteredScans */
inline RegisteredScans
openScans(const std::filesystem::path& path, const ScanFolderOptions& options)
{
  std::optional<RegisteredScans> scans;
  checkOptions(
      [&] {
        if (holdsSourceScans(path))
          scans.emplace(openScanFolder(path, options));
        else
          scans.emplace(path, options);
      },
      {{"poses_file", "poses"}});
  return *std::move(scans);
}

/** \brief As above; also prints the number of scans and the source of the poses. */
inline RegisteredScans
openScans(const std::filesystem::path& path,
          const ScanFolderOptions& options,
          ProgressBar& bar)
{
  RegisteredScans scans = openScans(path, options);
  bar.say(std::to_string(scans.folder().size()) + " scans, poses from " +
          scans.poseSource());
  if (!scans.folder().coordinates().empty())
    bar.warn(scans.folder().coordinates());
  return scans;
}

/** \return "  voxel = 0.1 m (auto: 2 x spacing)" */
inline std::string
parameterLine(const std::string& name,
              const Parameter& parameter,
              const std::string& unit = "m")
{
  std::ostringstream line;
  line << "  " << name << " = " << parameter.value << ' ' << unit << " ("
       << (!parameter.given        ? "auto: "
           : parameter.why.empty() ? "given"
                                   : "")
       << parameter.why << ")";
  return line.str();
}

} // namespace pcl6d::app
