// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "slam6d/options/settings.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/control_points_io.h>
#include <pcl6d/io/scan_folder.h>

#include <sstream>

namespace pcl6d::app {

namespace {
std::vector<std::string>
namesOf(const std::string& words)
{
  std::vector<std::string> names;
  std::istringstream stream(words);
  for (std::string name; std::getline(stream, name, ',');) {
    name.erase(0, name.find_first_not_of(' '));
    name.erase(name.find_last_not_of(' ') + 1);
    if (!name.empty())
      names.push_back(name);
  }
  return names;
}
} // namespace

void
Settings::readControl(const ScanFolder& scans)
{
  if (control.points.empty() != control.targets.empty())
    throw UsageError(
        control.points.empty()
            ? "--targets needs --control FILE with the control points"
            : "--control needs --targets FILE with the points in the scans");
  if (control.points.empty() && !control.checks.empty())
    throw UsageError("--check needs --control FILE and --targets FILE");
  if (control.points.empty())
    return;
  std::vector<std::string> names;
  std::vector<int> numbers;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    names.push_back(scans.name(i));
    numbers.push_back(scans.index(i));
  }
  slam.control.points = readControlPoints(control.points);
  slam.control.targets = readScanTargets(control.targets, names, numbers);
  slam.control.checks = namesOf(control.checks);
  if (const auto moved = scans.moved())
    for (ScanTarget& target : slam.control.targets)
      target.position = moved->toNear(scans.initialPose(target.scan)) * target.position;
  try {
    slam.control.validate(scans.size());
  } catch (const BadArgument& e) {
    throw BadArgument(control.points + ": " + e.what());
  }
}

} // namespace pcl6d::app
