// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "common/progress_bar.h"
#include "objects/verbs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/control_points_io.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/text.h>
#include <pcl6d/object_localization/target_names.h>
#include <pcl6d/sources/open_source.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <ostream>
#include <sstream>

namespace pcl6d::app {
namespace {

struct TargetSettings {
  std::string input, output, control;
  std::vector<std::string> diameters, sizes; ///< [m] as given
  ScanFolderOptions folder;
  TargetOptions options;
  bool quiet = false;
};

std::vector<double>
lengthsOf(const std::vector<std::string>& words, const std::string& option)
{
  std::vector<double> lengths;
  for (const std::string& word : words) {
    double length = 0;
    if (!text::parseNumber(std::string_view(word), length) || !(length > 0) ||
        !std::isfinite(length))
      throw UsageError("--" + option + ": " + text::quoted(word) +
                       " is no length > 0 in metres");
    lengths.push_back(length);
  }
  return lengths;
}

bool
parseTargets(const Arguments& arguments, TargetSettings& s)
{
  OptionTable table(std::string("usage: ") + kObjects +
                    R"( targets SCANS -o targets.csv [options]
Finds spheres of known diameter and flat black and white targets (four quarters) in
scans, and writes their centres as pcl_slam6d reads them with --targets. SCANS: a
folder of scans, or a file of several, with the scanner at the origin. Standard
deviations, and what was rejected and why, are comments of the file.
)");
  table.positional("SCANS", &s.input);
  table.group("Output");
  table.add("output,o FILE", &s.output).required().help("table of targets");
  table.group("Targets");
  table.add("sphere-diameter", &s.diameters)
      .composing()
      .multitoken()
      .help("[m] of spheres; several may follow");
  table.add("board-size", &s.sizes)
      .composing()
      .multitoken()
      .help("[m] edge of the square of four quarters (needs intensities); several may "
            "follow");
  table.add("control FILE", &s.control)
      .help("control points (name x y z [sigma]): targets get the names of the points "
            "with equal distances");
  table.group("Input");
  table.add("first", &s.folder.first).help("index of the first scan to take");
  table.add("last", &s.folder.last)
      .help("index of the last scan to take (default: the end)");
  table.add("every", &s.folder.every).help("take each n-th scan");
  table.group("Run");
  table.addAs<int>("threads", &s.options.num_threads)
      .within(0, 1024, "0 to 1024")
      .help("0: a thread per core; never changes the result");
  table.add("quiet", &s.quiet).help("print warnings and errors only");
  if (!table.parse(arguments))
    return false;
  table.check([&] { s.folder.validate(); });
  s.options.sphere_diameters = lengthsOf(s.diameters, "sphere-diameter");
  s.options.board_sizes = lengthsOf(s.sizes, "board-size");
  if (s.diameters.empty() && s.sizes.empty())
    throw UsageError(
        "give the targets to search for: --sphere-diameter, or --board-size");
  refuseInputs(s.output, {s.input, s.control}, "the input");
  return true;
}

/** The targets of a scan, and their names. */
struct NamedTargets {
  std::string scan;
  Eigen::Isometry3d T_file_near; ///< from the searched points to the points of the file
  TargetSearch search;
  TargetNames names;
};

/** \return the name of a scan, or its number if the name would not be a single column
 * of the table */
std::string
scanWordOf(const ScanFolder& scans, std::size_t i)
{
  const std::string& name = scans.name(i);
  const bool is_one_word = name.find_first_of(" ,;\t\"#") == std::string::npos;
  return is_one_word && !name.empty() ? name : std::to_string(scans.index(i));
}

NamedTargets
targetsOfScan(const TargetSettings& s,
              const ScanFolder& scans,
              std::size_t i,
              const std::vector<ControlPoint>& control)
{
  const Scan scan = scans.read(i);
  std::vector<float> intensity;
  if (const auto field = fieldValues(scan.cloud, "intensity"))
    intensity.assign(field->values.begin(), field->values.end());
  if (intensity.size() != scan.points.size())
    intensity.clear();
  if (intensity.empty() && s.options.sphere_diameters.empty())
    throw IoFailed(scans.title(i) + ": has no field intensity, needed for boards");
  NamedTargets found;
  found.scan = scanWordOf(scans, i);
  found.T_file_near = Eigen::Isometry3d::Identity();
  if (const auto moved = scans.moved())
    found.T_file_near = moved->toNear(scans.initialPose(i)).inverse();
  found.search = findTargets(scan.points, intensity, s.options);
  found.names.names.resize(found.search.found.size());
  if (!control.empty())
    found.names = namesByDistances(found.search.found, control);
  return found;
}

std::string
sizeOf(TargetKind kind, double size)
{
  std::ostringstream text;
  text << toString(kind) << " " << size << " m";
  return text.str();
}

/** \return the table: rows of targets, comments for people */
std::string
tableOf(const std::vector<NamedTargets>& scans)
{
  std::ostringstream text;
  text << "name,scan,x,y,z\n";
  std::size_t next = 1;
  for (const NamedTargets& scan : scans) {
    if (!scan.names.doubt.empty())
      text << "# " << scan.scan
           << ": no names from control points: " << scan.names.doubt << '\n';
    for (std::size_t k = 0; k < scan.search.found.size(); ++k) {
      const FoundTarget& target = scan.search.found[k];
      const std::string name = scan.names.names[k].empty()
                                   ? "T" + std::to_string(next++)
                                   : scan.names.names[k];
      const Eigen::Vector3d place = scan.T_file_near * target.centre;
      text << std::fixed << std::setprecision(5) << name << ',' << scan.scan << ','
           << place.x() << ',' << place.y() << ',' << place.z() << '\n';
      text.unsetf(std::ios::floatfield);
      text << "#   " << sizeOf(target.kind, target.size) << ": sigma "
           << std::setprecision(2) << 1000 * target.sigma << " mm, quality "
           << target.quality << ", " << target.points << " points\n";
    }
    for (const RejectedTarget& one : scan.search.rejected) {
      const Eigen::Vector3d place = scan.T_file_near * one.centre;
      text << "# " << scan.scan << ": rejected " << sizeOf(one.kind, one.size) << " at "
           << std::fixed << std::setprecision(2) << place.x() << ' ' << place.y() << ' '
           << place.z() << ": " << toWords(one) << '\n';
      text.unsetf(std::ios::floatfield);
    }
  }
  return text.str();
}

void
printFound(const std::vector<NamedTargets>& scans, const std::string& output)
{
  std::size_t found = 0, rejected = 0, named = 0;
  for (const NamedTargets& scan : scans) {
    found += scan.search.found.size();
    rejected += scan.search.rejected.size();
    named += static_cast<std::size_t>(std::count_if(
        scan.names.names.begin(), scan.names.names.end(), [](const std::string& name) {
          return !name.empty();
        }));
    if (!scan.names.doubt.empty())
      std::printf("%s: no names from control points: %s\n",
                  scan.scan.c_str(),
                  scan.names.doubt.c_str());
  }
  std::printf("%s in %s, %zu named by control points, %zu rejected: %s\n",
              text::counted(found, "target").c_str(),
              text::counted(scans.size(), "scan").c_str(),
              named,
              rejected,
              output.c_str());
  flushOutput();
}
} // namespace

int
runTargets(const Arguments& arguments)
{
  TargetSettings s;
  if (!parseTargets(arguments, s))
    return kDone;
  requireWritable(s.output);
  std::vector<ControlPoint> control;
  if (!s.control.empty())
    control = readControlPoints(s.control);
  const ScanFolder scans = openScanFiles({s.input}, s.folder);
  ProgressBar bar(s.quiet);
  std::vector<NamedTargets> found;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    found.push_back(targetsOfScan(s, scans, i, control));
    bar.show({"searching", i + 1, scans.size()});
  }
  const std::string table = tableOf(found);
  writeFileAtomically(s.output, [&](std::ostream& stream) { stream << table; });
  if (!s.quiet)
    printFound(found, s.output);
  return kDone;
}

} // namespace pcl6d::app
