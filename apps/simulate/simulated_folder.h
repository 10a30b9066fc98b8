// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/output/output_folder.h"

#include <string>
#include <vector>

namespace pcl6d::app {

constexpr const char* kSceneFile = "scene.json"; ///< only in simulated folders

/** \brief Rules for the output folder of a simulation. */
OutputRules
simulatedFolder(const std::string& out,
                bool force,
                const std::vector<std::filesystem::path>& inputs = {});

/** \throws IoFailed the folder holds scans that are not from an earlier simulation */
void
requireNoOtherScans(const OutputFolder& folder);

} // namespace pcl6d::app
