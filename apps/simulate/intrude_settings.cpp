// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "simulate/intrude.h"
#include "simulate/settings.h"

#include <pcl6d/simulation/body_ways.h>

#include <sstream>

namespace pcl6d::app {
namespace {
Eigen::Vector3d
directionOf(const std::string& text)
{
  std::istringstream stream(text);
  Eigen::Vector3d up;
  char comma[2] = {0, 0};
  stream >> up.x() >> comma[0] >> up.y() >> comma[1] >> up.z();
  if (!stream || comma[0] != ',' || comma[1] != ',' || !(stream >> std::ws).eof() ||
      !up.allFinite() || up.norm() == 0)
    throw UsageError("--up = " + text + ", but must be auto or a direction x,y,z");
  return up;
}

void
addOptions(OptionTable& table, IntrudeSettings& s)
{
  table.positional("RUN", &s.input);
  table.group("What moves");
  table.add("people", &s.intruders.people)
      .within(0, kMostBodies, "in [0, 200]")
      .help("walk about the scanner, never nearer than 1.2 m");
  table.add("cars", &s.intruders.cars)
      .within(0, kMostBodies, "in [0, 200]")
      .help("drive about the scanner, never nearer than 3.5 m");
  table.addAs<std::int64_t>("seed", &s.intruders.seed)
      .within(0, kNoBound, ">= 0")
      .help("same seed, same bytes");
  table.group("Input");
  table.add("poses FILE", &s.poses)
      .help("KITTI or TUM, a row per scan: poses better than the initial poses of the "
            "folder; the initial poses are written unchanged");
  table.add("format", &s.scans.format, scanFormatFromName)
      .help("auto|pcd|ply|uos|uosr|kitti|xyz|las|laz");
  table.addAuto("period", &s.period)
      .within(1e-6, 36000, "in [1e-6, 36000]")
      .help("[s] from scan to scan; auto: the time stamps of the folder, else 1");
  table.add("up", &s.up)
      .help("auto, or x,y,z: upward direction in the frame of the poses; auto: from "
            "the surfaces of the scans if possible, else z");
  table.group("Run");
  table.add("output,o DIR", &s.out).required().help("folder to write; made if missing");
  table.add("force", &s.force)
      .help("write into a folder that is not empty, but holds no scans");
  table.addAs<int>("threads", &s.intruders.num_threads)
      .within(0, kNoBound, ">= 0")
      .help("0: a thread per core; never changes results");
  table.add("quiet", &s.quiet).help("print errors only");
}
} // namespace

bool
parseIntrudeSettings(const Arguments& arguments, IntrudeSettings& s)
{
  OptionTable table(
      std::string("usage: ") + kSimulate + " " + kIntrude +
      " RUN -o DIR --people N --cars N [options]\nLets people and cars move through "
      "recorded scans, each point labelled: dynamic is 1 on people and cars, else "
      "0.\nRUN is a folder of scans with initial poses, or the folder of a finished "
      "run. A point is the end of a ray from the origin of the scan: a nearer body "
      "takes the point. Rays without a return are missing in a scan, and so are bodies "
      "on these rays.");
  addOptions(table, s);
  if (!table.parse(arguments))
    return false;
  if (s.intruders.people + s.intruders.cars == 0)
    throw UsageError("--people or --cars must be above 0");
  if (s.up != "auto")
    s.intruders.up = directionOf(s.up);
  return true;
}

} // namespace pcl6d::app
