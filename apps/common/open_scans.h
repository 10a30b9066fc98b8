// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/app.h"

#include <pcl6d/run/registered_scans.h>

#include <optional>

namespace pcl6d::app {

/** \brief Opens the scans of a folder, raw or of a finished run.
 * \throws UsageError the options select no scan, or give poses for a run
 * \throws IoFailed as RegisteredScans */
inline RegisteredScans
openScans(const std::filesystem::path& path, const ScanFolderOptions& options)
{
  std::optional<RegisteredScans> scans;
  checkOptions([&] { scans.emplace(path, options); }, {{"poses_file", "poses"}});
  return *std::move(scans);
}

} // namespace pcl6d::app
