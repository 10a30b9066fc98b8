// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/shared_run.h"

#include <filesystem>

namespace pcl6d::test {

/** Ten sweeps a second at 1.5 m/s, with the motion inside them, times of points and stamps. */
inline const std::filesystem::path&
simulatedDrive()
{
  static const std::filesystem::path path = sharedOutput("pcl_slam6d_simulate",
                                                         {"corridor",
                                                          "--scanner",
                                                          "vlp16",
                                                          "--speed",
                                                          "1.5",
                                                          "--motion",
                                                          "continuous",
                                                          "--period",
                                                          "0.1",
                                                          "--scans",
                                                          "64",
                                                          "--quiet"});
  return path;
}

} // namespace pcl6d::test
