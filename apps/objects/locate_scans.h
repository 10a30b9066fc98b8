// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/interrupt.h"
#include "common/progress_bar.h"
#include "objects/locate_settings.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace pcl6d::app {

/** \brief What one scan shows. */
struct ScanObjects {
  std::filesystem::path file;
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
  std::vector<std::size_t> observations; ///< places in the list of all
  /** per observation its points, as places in the file */
  std::vector<std::vector<std::uint32_t>> points;
};

/** \brief What the scans of an input show. */
struct Located {
  std::vector<MapObject> observations;
  std::vector<ScanObjects> scans;
  double seconds = 0; ///< of the search, without reading
};

/** \brief Looks for objects in the scans of an input, one after the other.
 * \return nothing if interrupted
 * \throws IoFailed, BadArgument a model, a cascade or a scan cannot be used */
std::optional<Located>
locateScans(const LocateSettings& settings,
            ProgressBar& bar,
            const Interrupt& interrupt);

} // namespace pcl6d::app
