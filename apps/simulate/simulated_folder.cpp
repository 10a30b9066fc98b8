// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/settings.h"
#include "simulate/simulated_folder.h"

#include <pcl6d/common/error.h>

namespace pcl6d::app {
namespace fs = std::filesystem;

OutputRules
simulatedFolder(const std::string& out, bool force, const std::vector<fs::path>& inputs)
{
  OutputRules rules;
  rules.folder = out;
  rules.inputs = inputs;
  rules.program = kSimulate;
  rules.marker = kSceneFile;
  rules.files = std::regex("scan[0-9]+\\.pcd|odometry\\.txt|groundtruth\\.txt|"
                           "groundtruth_motion\\.txt|times\\.txt|"
                           "(planes|objects)_truth\\.json|scene\\.json");
  rules.force = force;
  return rules;
}

void
requireNoOtherScans(const OutputFolder& folder)
{
  if (folder.holdsEarlierRun())
    return;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder.folder(), error))
    if (entry.path().extension() == ".pcd")
      throw IoFailed(folder.folder().string() +
                     ": holds measured scans; use another folder");
}

} // namespace pcl6d::app
