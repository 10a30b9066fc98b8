// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "convert/verbs.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/range_lines_io.h>
#include <pcl6d/scanner/line_assembly.h>

#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

namespace pcl6d::app {

namespace {
/** \brief Three numbers in one word: 0.1,0,-0.05 */
struct Triple {
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
};

std::istream&
operator>>(std::istream& stream, Triple& triple)
{
  char comma[2] = {};
  stream >> triple.value.x() >> comma[0] >> triple.value.y() >> comma[1] >>
      triple.value.z();
  if (comma[0] != ',' || comma[1] != ',')
    stream.setstate(std::ios::failbit);
  return stream;
}

std::ostream&
operator<<(std::ostream& stream, const Triple& triple)
{
  return stream << triple.value.x() << ',' << triple.value.y() << ','
                << triple.value.z();
}

struct LinesSettings {
  std::string input;
  std::string angles;
  std::string output;
  bool continuous = false;
  double beam_first = -90;         // [deg]
  double beam_last = 90;           // [deg]
  std::optional<Triple> mounting;  // [deg] empty: suited to the drive
  Triple lever_arm, axis_position; // [m]
  double range_unit = 1;           // [m]
  LineAssemblyOptions options;
};

void
addOptions(OptionTable& table, LinesSettings& s)
{
  DrivenScannerOptions& scanner = s.options.scanner;
  table.positional("LINES.csv", &s.input);
  table.group("Files");
  table.add("angles FILE", &s.angles)
      .help("CSV of the drive: angle [deg] and optionally, in a second column, time "
            "[s]; LINES.csv then holds ranges only");
  table.add("range-unit M", &s.range_unit)
      .above(0, "> 0 and finite", kFinite)
      .help("[m] length of a unit of the ranges; 0.001 for millimetres");
  table.add("output,o FILE", &s.output).required().help("PCD file");
  table.group("Scanner");
  scanner.drive = Drive::kPitching;
  table
      .add("drive NAME",
           &scanner.drive,
           {{"pitching", Drive::kPitching},
            {"rolling", Drive::kRolling},
            {"yawing", Drive::kYawing}})
      .help("pitching|rolling|yawing: about y (positive looks up), x or z");
  table.add("continuous", &s.continuous)
      .help("the drive turns on during a line; without: the drive stands still");
  table.add("beam-first DEG", &s.beam_first)
      .within(-360, 360, "within a full turn")
      .help("[deg] direction of the first range in the plane of the 2D scanner, from "
            "the x axis to the y axis");
  table.add("beam-last DEG", &s.beam_last)
      .within(-360, 360, "within a full turn")
      .help("[deg] direction of the last range");
  table.add("mounting R,P,Y", &s.mounting)
      .help("[deg] roll, pitch, yaw of the 2D scanner on the drive; default 0,0,0, for "
            "a yawing drive with an upright fan 90,0,0");
  table.add("lever-arm X,Y,Z", &s.lever_arm)
      .help("[m] from the drive's axis to the 2D scanner's centre, turning with the "
            "drive");
  table.add("axis-position X,Y,Z", &s.axis_position)
      .help("[m] of the axis in the frame of the scan");
  table.add("min-range", &s.options.min_range).help("[m] shorter ranges are no return");
  table.add("max-range", &s.options.max_range).help("[m] longer ranges are no return");
}

/** Moves the words into the library's options. */
void
applyWords(LinesSettings& s)
{
  DrivenScannerOptions& scanner = s.options.scanner;
  scanner.motion = s.continuous ? DriveMotion::kContinuous : DriveMotion::kStepped;
  scanner.beam.first = s.beam_first * kDegree;
  scanner.beam.last = s.beam_last * kDegree;
  const bool upright = scanner.drive == Drive::kYawing;
  const Triple mounting = s.mounting.value_or(Triple{{upright ? 90. : 0., 0, 0}});
  require(mounting.value.allFinite(), "mounting", mounting, "finite");
  const Eigen::Vector3d angles = mounting.value * kDegree;
  scanner.mounting = rotationFromEuler({angles.x(), angles.y(), angles.z()});
  scanner.lever_arm = s.lever_arm.value;
  scanner.axis_position = s.axis_position.value;
  s.options.validate();
}

bool
parse(const std::vector<std::string>& arguments, LinesSettings& s)
{
  OptionTable table(std::string("usage: ") + kConvert +
                    R"( lines LINES.csv -o OUT.pcd [options]
Puts the lines of a 2D scanner on a drive together to an organized scan, a row
per line, in metres: x ahead, y left, z up.
A row of LINES.csv: the drive's angle [deg] and the ranges [m], separated by
commas, semicolons or blanks. Rows that start with # are comments. The first row
may name the columns: angle,range..., or angle,time,range... where the second
column is the time [s] at which a line starts; then each point gets its time, t
[s] since the first line. A range that is empty, nan, inf or 0 is no return and
becomes a point of NaN.
)");
  addOptions(table, s);
  if (!table.parse(arguments))
    return false;
  table.check([&] { applyWords(s); });
  refuseInputs(s.output, {s.input, s.angles});
  return true;
}
} // namespace

int
runLines(const std::vector<std::string>& arguments)
{
  LinesSettings s;
  if (!parse(arguments, s))
    return kDone;
  const RangeLines lines = readRangeLines(s.input, s.angles, s.range_unit);
  s.options.scanner.beam.count = static_cast<int>(lines.samples_per_line);
  const LineAssembly assembly(lines, s.options);
  const auto cloud = assembly.cloud();
  pcl::PCLPointCloud2 fields;
  pcl::toPCLPointCloud2(cloud, fields);
  if (!lines.times.empty())
    addTimeField(fields, assembly.scanner());
  writePcd(s.output, fields);
  const auto returns = std::count_if(
      cloud.begin(), cloud.end(), [](const auto& p) { return std::isfinite(p.x); });
  std::printf("%s: %u lines of %u ranges, %td returns\n",
              s.output.c_str(),
              cloud.height,
              cloud.width,
              returns);
  flushOutput();
  return kDone;
}

} // namespace pcl6d::app
