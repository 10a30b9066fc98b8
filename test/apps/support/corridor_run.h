// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/run_program.h"
#include "support/shared_run.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace pcl6d::test {

inline constexpr int kScans = 16; // 1.3 m apart over a part of the corridor's loop

/** Simulated scans, made once for all tests, which only read them. */
inline const std::filesystem::path&
scans()
{
  static const std::filesystem::path path = sharedOutput(
      "pcl_slam6d_simulate", {"corridor", "--seed", "3", "--scans", "40", "--quiet"});
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

/** \return the files of a run, without the times and memory in its summary */
inline std::map<std::string, std::string>
withoutTimes(const std::filesystem::path& run)
{
  static const std::regex times("\"(seconds|peak_memory_mb)\": [^,\n]*");
  auto files = contentOf(run);
  if (files.count("summary.json") > 0)
    files["summary.json"] = std::regex_replace(files["summary.json"], times, "");
  return files;
}

/** \return those of a run over the scans that one process did alone and undisturbed */
inline std::map<std::string, std::string>
filesAlone(const std::vector<std::string>& options)
{
  const TempFolder folder;
  EXPECT_EQ(slam(scans(), folder / "out", options).exit_code, 0);
  return withoutTimes(folder / "out");
}

} // namespace pcl6d::test
