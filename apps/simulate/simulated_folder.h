// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/output_folder.h"

#include <string>
#include <vector>

namespace pcl6d::app {

constexpr const char* kSceneFile = "scene.json"; ///< only simulated folders have it

/** \brief What a simulation may do to the folder that it writes. */
OutputRules
simulatedFolder(const std::string& out,
                bool force,
                const std::vector<std::filesystem::path>& inputs = {});

/** \throws IoFailed the folder holds scans, but not those of an earlier simulation */
void
requireNoOtherScans(const OutputFolder& folder);

} // namespace pcl6d::app
