// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/run_program.h"

#include <pcl6d/io/scan_reader.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <iomanip>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace pcl6d::test {

using PluginWords = std::vector<std::string>;

/** \return the file of a plug-in of these tests */
inline std::string
pluginFile(const std::string& name)
{
  return PCL6D_PLUGIN_DIR "/libpcl6d_test_" + name + ".so";
}

/** \return whether a run came to its end; whether a corridor of so few scans is then trusted is
 * another matter */
inline bool
isDone(const Outcome& outcome)
{
  return outcome.exit_code == 0 || outcome.exit_code == 3;
}

/** The first four scans of a drive along a corridor as plain text, each with its name and the title, if any, before
 * its rows; made once. */
inline const std::filesystem::path&
textScans(const std::string& extension, const std::string& title = "")
{
  static const TempFolder folder;
  static std::map<std::string, std::filesystem::path> made;
  const auto known = made.find(extension);
  if (known != made.end())
    return known->second;
  const std::filesystem::path simulated = folder / "simulated";
  if (!std::filesystem::exists(simulated))
    runProgram("pcl_slam6d_simulate",
               {"corridor", "-o", simulated.string(), "--scans", "40", "--quiet"});
  const std::filesystem::path path = folder / ("scans" + extension);
  std::filesystem::create_directory(path);
  std::istringstream odometry(readText(simulated / "odometry.txt"));
  std::string poses, row;
  for (int i = 0; i < 4 && std::getline(odometry, row); ++i)
    poses += row + '\n';
  writeText(path / "odometry.txt", poses);
  for (const char* const name : {"scan000", "scan001", "scan002", "scan003"}) {
    std::ostringstream rows;
    rows << title << std::setprecision(9);
    for (const auto& p : readScan(simulated / (name + std::string(".pcd"))).points)
      rows << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    writeText(path / (name + extension), rows.str());
  }
  return made.emplace(extension, path).first->second;
}

/** A run over four scans, with their plain text as the usual input. */
struct PluginRun {
  explicit PluginRun(PluginWords more,
                     const std::filesystem::path& scans = textScans(".xyz"))
  {
    more.insert(more.begin(),
                {scans.string(), "-o", (folder / "out").string(), "--no-picture"});
    outcome = runProgram("pcl_slam6d", more);
    if (isDone()) {
      poses = readText(folder / "out/trajectory.kitti");
      summary = nlohmann::json::parse(readText(folder / "out/summary.json"));
    }
  }

  bool
  isDone() const
  {
    return test::isDone(outcome);
  }

  std::string
  option(const char* name) const
  {
    return summary.at("options").at(name).at("value");
  }

  TempFolder folder;
  Outcome outcome;
  std::string poses = "none";
  nlohmann::json summary;
};

} // namespace pcl6d::test
