// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/command_line.h"
#include "convert/verbs.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/name_table.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/range_lines_io.h>
#include <pcl6d/scanner/line_assembly.h>

#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace pcl6d::app {

namespace {
namespace po = boost::program_options;
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
  std::string drive = "pitching";
  bool continuous = false;
  double beam_first = -90; // [deg]
  double beam_last = 90;   // [deg]
  Triple mounting;         // [deg]
  bool has_mounting = false;
  Triple lever_arm, axis_position; // [m]
  double range_unit = 1;           // [m]
  LineAssemblyOptions options;
};

void
describe(LinesSettings& s, CommandLine& line)
{
  line.group("Files").add_options() //
      ("angles",
       po::value(&s.angles)->value_name("FILE"),
       "CSV of the drive: angle [deg] and, if there is a second column, time [s]; "
       "LINES.csv then holds ranges only") //
      ("range-unit",
       valueOf(s.range_unit)->value_name("M"),
       "[m] of one unit of the ranges; 0.001 for millimetres") //
      ("output,o", po::value(&s.output)->value_name("FILE")->required(), "PCD file");
  line.group("Scanner").add_options() //
      ("drive",
       valueOf(s.drive)->value_name("NAME"),
       "pitching|rolling|yawing: about y (positive looks up), x or z") //
      ("continuous",
       po::bool_switch(&s.continuous),
       "the drive turns on during a line; without: it stands still") //
      ("beam-first",
       valueOf(s.beam_first)->value_name("DEG"),
       "[deg] direction of the first range in the 2D scanner's plane, from its x axis "
       "to its y axis")                                                               //
      ("beam-last", valueOf(s.beam_last)->value_name("DEG"), "[deg] of the last one") //
      ("mounting",
       po::value(&s.mounting)->value_name("R,P,Y"),
       "[deg] roll, pitch, yaw of the 2D scanner on the drive; default 0,0,0, for a "
       "yawing drive 90,0,0: its fan stands upright") //
      ("lever-arm",
       valueOf(s.lever_arm)->value_name("X,Y,Z"),
       "[m] from the drive's axis to the 2D scanner's centre, turning with the "
       "drive") //
      ("axis-position",
       valueOf(s.axis_position)->value_name("X,Y,Z"),
       "[m] of the axis in the frame of the scan")(
          "min-range",
          valueOf(s.options.min_range),
          "[m] shorter ranges are no return") //
      ("max-range", valueOf(s.options.max_range), "[m] longer ranges are no return");
}

Drive
driveFromName(const std::string& name)
{
  constexpr Named<Drive> kDrives[] = {{Drive::kPitching, "pitching"},
                                      {Drive::kRolling, "rolling"},
                                      {Drive::kYawing, "yawing"}};
  return fromName(kDrives, "drive", name, WordList::kOr);
}

/** Moves the words into the library's options. */
void
applyWords(LinesSettings& s)
{
  DrivenScannerOptions& scanner = s.options.scanner;
  scanner.drive = driveFromName(s.drive);
  scanner.motion = s.continuous ? DriveMotion::kContinuous : DriveMotion::kStepped;
  require(s.range_unit > 0 && std::isfinite(s.range_unit),
          "range_unit",
          s.range_unit,
          "> 0 and finite");
  for (const auto& [name, value] :
       {std::pair("beam_first", s.beam_first), std::pair("beam_last", s.beam_last)})
    require(std::abs(value) <= 360, name, value, "within a full turn");
  scanner.beam.first = s.beam_first * kDegree;
  scanner.beam.last = s.beam_last * kDegree;
  if (!s.has_mounting && scanner.drive == Drive::kYawing)
    s.mounting.value = {90, 0, 0};
  require(s.mounting.value.allFinite(), "mounting", s.mounting, "finite");
  const Eigen::Vector3d angles = s.mounting.value * kDegree;
  scanner.mounting = rotationFromEuler({angles.x(), angles.y(), angles.z()});
  scanner.lever_arm = s.lever_arm.value;
  scanner.axis_position = s.axis_position.value;
  s.options.validate();
}

bool
parse(const std::vector<std::string>& arguments, LinesSettings& s)
{
  CommandLine line(
      std::string("usage: ") + kConvert +
      " lines LINES.csv -o OUT.pcd [options]\n"
      "Puts the lines of a 2D scanner on a drive together to an organized scan, a row\n"
      "per line, in metres: x ahead, y left, z up.\n"
      "A row of LINES.csv: the drive's angle [deg] and the ranges [m], separated by\n"
      "commas, semicolons or blanks. Rows that start with # are comments. The first "
      "row\n"
      "may name the columns: angle,range..., or angle,time,range... where the second\n"
      "column is the time [s] at which a line starts; then each point gets its time, "
      "t\n"
      "[s] since the first line. A range that is empty, nan, inf or 0 is no return "
      "and\n"
      "becomes a point of NaN.\n");
  line.positional("LINES.csv", &s.input);
  describe(s, line);
  if (!line.parse(arguments))
    return false;
  s.has_mounting = line.given("mounting");
  checkOptions([&] { applyWords(s); });
  for (const auto& input : {s.input, s.angles}) {
    std::error_code missing; // a missing file is no input
    if (!input.empty() && std::filesystem::equivalent(s.output, input, missing))
      throw UsageError("--output = " + s.output + ", but that is an input");
  }
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
