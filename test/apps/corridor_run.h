// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/run_program.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pcl6d::test {

inline constexpr int kScans = 16; // 1.3 m apart over a part of the corridor's loop

/** Simulated scans, made once for all tests. */
inline const std::filesystem::path&
scans()
{
  static const TempFolder folder;
  static const std::filesystem::path path = folder / "scans";
  if (!std::filesystem::exists(path))
    runProgram(
        "pcl_slam6d_simulate",
        {"corridor", "-o", path.string(), "--seed", "3", "--scans", "40", "--quiet"});
  return path;
}

inline Outcome
slam(const std::filesystem::path& in,
     const std::filesystem::path& out,
     std::vector<std::string> more = {})
{
  more.insert(more.begin(), {in.string(), "-o", out.string()});
  return runProgram("pcl_slam6d", more);
}

} // namespace pcl6d::test
