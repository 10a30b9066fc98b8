// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "doctor/doctor_settings.h"
#include "evaluate/result_file.h"

#include <cmath>
#include <sstream>

namespace pcl6d::app {

namespace {
std::string
usage()
{
  return std::string("usage: ") + kDoctor +
         R"( SOURCE TARGET [options]
Runs the registration classes of PCL and of pcl6d on two clouds and reports silent
failures of PCL, the reliability of each result, and the options to set. Every statement
is measured on the clouds, by runs with a time limit in separate processes.
Distances in metres, angles in degrees. Meaning of the words: share/doc/doctor.md.
Exit code 0: done, and the result of pcl6d is verified; 3: the result is doubtful.
)";
}

/** \throws UsageError the text is no position */
Eigen::Vector3d
placeOfText(const std::string& option, const std::string& text)
{
  std::istringstream stream(text);
  Eigen::Vector3d place;
  for (double& value : place)
    if (!(stream >> value) || !std::isfinite(value))
      throw UsageError(option + " \"" + text +
                       "\": expected three finite numbers, x y z [m]");
  if (!(stream >> std::ws).eof())
    throw UsageError(option + " \"" + text + "\": more than three numbers");
  return place;
}

void
addOptions(OptionTable& table, DoctorSettings& s)
{
  table.positional("SOURCE", &s.source);
  table.positional("TARGET", &s.target);
  table.group("Input");
  table.add("guess \"X Y Z R P Y\"|FILE", &s.guess)
      .help("start: pose of SOURCE in the frame of TARGET, [m] and roll pitch yaw "
            "[deg]; a file may hold a matrix (12 or 16 numbers, row by row) instead; "
            "by default the identity, like align()");
  table.add("indices FILE", &s.indices)
      .help("numbers of the points of SOURCE to use, from 0, for setIndices()");
  table.add("format", &s.format, scanFormatFromName)
      .help("auto|pcd|ply|uos|uosr|kitti|xyz|las|laz");
  const auto addOrigin = [&](const std::string& name,
                             std::optional<Eigen::Vector3d>* place,
                             const std::string& cloud) {
    table
        .addWord(
            name + " \"X Y Z\"",
            "",
            [=](const std::string& text) { *place = placeOfText("--" + name, text); })
        .help("[m] where the scanner stood in " + cloud +
              ", for the free-space test; by default the origin, the VIEWPOINT or the "
              "middle of the cloud, the first possible");
  };
  addOrigin("source-origin", &s.source_origin, "SOURCE");
  addOrigin("target-origin", &s.target_origin, "TARGET");
  table.group("Runs");
  table.add("max-distance", &s.max_distance)
      .above(0, "finite and > 0", kFinite)
      .help("[m] limit of the pair distance; by default derived from the clouds");
  table.add("time-limit", &s.time_limit)
      .above(0, "finite and > 0", kFinite)
      .help("[s] longest time of a run");
  table.group("Output");
  table.add("output,o FILE", &s.html).help("report to write, one HTML file (.html)");
  table.add("json FILE", &s.json).help("the report as data (.json)");
  table.add("quiet", &s.quiet).help("print the report, warnings and errors only");
}
} // namespace

bool
parseDoctorSettings(const std::vector<std::string>& arguments, DoctorSettings& s)
{
  OptionTable table(usage());
  addOptions(table, s);
  if (!table.parse(arguments))
    return false;
  requireResultFile("--output", s.html, {".html", ".htm"});
  requireResultFile("--json", s.json, {".json"});
  for (const auto& [file, option] :
       {std::pair(s.html, "--output"), std::pair(s.json, "--json")})
    refuseInputs(file, {s.source, s.target, s.guess, s.indices}, "an input", option);
  if (!s.html.empty() && s.html == s.json)
    throw UsageError("--output and --json name one file");
  return true;
}

} // namespace pcl6d::app
