// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/placed_scans.h"

#include <algorithm>

namespace pcl6d::app {

std::vector<std::size_t>
placedScans(const RunResult& run)
{
  std::vector<std::size_t> placed;
  for (std::size_t i = 0; i < run.scans.size(); ++i) {
    const ScanResult& scan = run.scans[i];
    const bool is_floating =
        std::find(run.floating.begin(), run.floating.end(), scan.file) !=
        run.floating.end();
    if (scan.state != ScanState::kPredicted && !is_floating)
      placed.push_back(i);
  }
  return placed;
}

} // namespace pcl6d::app
