// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/open_scans.h"
#include "common/options/option_table.h"
#include "convert/bag_table.h"
#include "convert/scan_settings.h"
#include "convert/verbs.h"

#include <pcl6d/io/text.h>
#include <pcl6d/run/run_summary.h>
#include <pcl6d/sources/coordinate_system.h>

namespace pcl6d::app {

namespace {
constexpr const char* kScansUsage =
    R"( scans IN -o OUT [options]
Writes scans in another format. IN is a scan (OUT is a file), or a folder, an E57 or
PTX file, or a robot's recording (OUT is a new folder). The poses are written as .pose
files for uos and uosr, as VIEWPOINT for pcd, in the header of ptx, else as poses.txt.
With OUT a file .e57 the scans become its stations; with --full the scans are joined
at their poses (OUT is a file). IN may be the folder of a pcl_slam6d run: scans and
final poses.
Right-handed metres; uos and uosr: 3DTK's left-handed centimetres. Numbers keep every
digit; each loss by the format is printed on a line. las and laz (1.4) hold steps of
0.1 mm, with --full in full coordinates: world offset added, index of the scan as point
source, dynamic points as class 18.
)";

void
addOptions(OptionTable& table, ScanSettings& s)
{
  table.positional("IN", &s.input);
  table.group("Output");
  table.add("output,o OUT", &s.output).required().help("file or folder");
  table.add("format NAME", &s.format)
      .help(
          "auto|pcd|ply|uos|uosr|kitti|xyz|las|laz|ptx|e57; auto: by the extension of "
          "OUT; uosr: "
          "uos with reflectance, kitti: .bin");
  table.add("encoding NAME", &s.encoding)
      .help(
          "auto|ascii|binary|binary_compressed (pcd only); auto: binary_compressed for "
          "pcd, binary for ply and with --full");
  table.add("full", &s.full)
      .help("join the scans of a folder at full resolution in one file");
  table.addAs<int>("epsg CODE", &s.epsg)
      .within(0, 999'999, "the code of a coordinate system")
      .help("coordinate system of poses and points, named in las, laz and e57: "
            "projected, in metres (default: the system given to the run)");
  table.group("Input");
  table.add("input-format NAME", &s.folder.format, scanFormatFromName)
      .help("a format of --format, or pts, csv, txt; auto: by extension, .3d is uos");
  table.add("columns LIST", &s.folder.columns, columnsFromText, "by heading")
      .help("columns of csv, txt, pts and xyz, for example x,y,z,,i: x y z intensity|i "
            "r g b nx ny nz ring time; an empty column is not read");
  table.add("bin-layout NAME", &s.folder.bin_layout, binLayoutFromName)
      .help("auto|xyz|xyzi|xyzir|xyzit|xyzirt|nclt|helipr-avia|helipr-aeva|helipr-"
            "ouster|helipr-velodyne: layout of a point in a .bin file");
  table.add("poses FILE", &s.folder.poses_file)
      .help("poses of a folder, KITTI or TUM rows");
  addBagOptions(table, s.folder.bag);
  table.add("first N", &s.folder.first).help("first scan of a folder");
  table.add("last N", &s.folder.last).help("last scan of a folder");
  table.add("every N", &s.folder.every).help("each N-th scan of a folder");
  table.group("Run");
  s.memory.addTo(table);
  table.add("quiet", &s.quiet).help("no progress");
}

/** \return whether the scans go to one E57 file, by the format or the extension of OUT */
bool
goesToE57(const ScanSettings& s)
{
  const bool is_named = s.format == "e57";
  const bool has_extension = isSourceFile(s.output) && !isBag(s.output) &&
                             // a PTX file contains one scan
                             scanFormatOfExtension(s.output) == ScanFormat::kAuto;
  if (s.format == "auto")
    return has_extension;
  if (has_extension && !is_named)
    throw UsageError("--format = " + s.format + ", but " + s.output +
                     " has the extension of e57");
  if (is_named && !has_extension && std::filesystem::path(s.output).has_extension())
    throw UsageError("--format = e57, but " + s.output + " has another extension");
  return is_named;
}

/** \return the format to write, as given or by the extension of OUT */
ScanFormat
outputFormat(const ScanSettings& s, bool to_file)
{
  const ScanFormat named = s.writer.format;
  const ScanFormat of_file =
      to_file ? scanFormatOfExtension(s.output) : ScanFormat::kAuto;
  if (named == ScanFormat::kAuto && of_file == ScanFormat::kAuto)
    throw UsageError("--format is missing, as " +
                     (to_file ? "the extension of " + s.output + " is that of none"
                              : "a folder has no extension") +
                     ": pcd, ply, uos, uosr, kitti, xyz, las, laz, ptx or e57");
  if (named != ScanFormat::kAuto && of_file != ScanFormat::kAuto &&
      extensionOf(named) != extensionOf(of_file))
    throw UsageError(std::string("--format = ") + toString(named) + ", but " +
                     s.output + " has the extension of " + toString(of_file));
  const ScanFormat format = named == ScanFormat::kAuto ? of_file : named;
  if (!isWritten(format))
    throw UsageError(
        std::string("--format = ") + toString(format) +
        ", but this format is only read; xyz is a text format for writing");
  return format;
}

PcdEncoding
outputEncoding(const ScanSettings& s)
{
  const std::string& name = s.encoding;
  const bool pcd = s.writer.format == ScanFormat::kPcd;
  if (name == "auto")
    return pcd && !s.full ? PcdEncoding::kBinaryCompressed : PcdEncoding::kBinary;
  if (name == "ascii")
    return PcdEncoding::kAscii;
  if (name == "binary")
    return PcdEncoding::kBinary;
  if (name != "binary_compressed" || s.writer.format == ScanFormat::kPly)
    throw UsageError("--encoding = " + name + ", but must be auto, ascii" +
                     (pcd ? ", binary or binary_compressed" : " or binary"));
  return PcdEncoding::kBinaryCompressed;
}

/** Fills in the well-known text of the coordinate system.
 * \throws UsageError the output cannot store the text, or the code is not a system in metres */
void
takeCoordinateSystem(const OptionTable& table, ScanSettings& s)
{
  const bool holds_it = s.to_e57 || s.writer.format == ScanFormat::kLas ||
                        s.writer.format == ScanFormat::kLaz;
  if (table.given("epsg") && !holds_it)
    throw UsageError(
        "--epsg is for las, laz and e57; further formats name no coordinate system");
  if (s.epsg == 0 && holds_it)
    s.epsg = epsgOfRun(s.input);
  if (s.epsg != 0)
    table.check([&] { s.writer.coordinate_system = wktOfEpsg(s.epsg); });
}
} // namespace

int
epsgOfRun(const std::string& input)
{
  const std::filesystem::path summary = std::filesystem::path(input) / "summary.json";
  if (!std::filesystem::exists(summary))
    return 0;
  int code = 0;
  for (const auto& option : readRunSummary(summary).options)
    if (option.name == "epsg" && !text::parseNumber(option.value, code))
      return 0;
  return code;
}

bool
parseScanSettings(const std::vector<std::string>& arguments, ScanSettings& s)
{
  OptionTable table(std::string("usage: ") + kConvert + kScansUsage);
  addOptions(table, s);
  if (!table.parse(arguments))
    return false;
  const bool several = holdsScans(s.input);
  const bool folder = several || std::filesystem::is_directory(s.input);
  if (!several)
    table.needFolder(s.input, {"full", "poses", "first", "last", "every"});
  else if (s.folder.format != ScanFormat::kAuto)
    throw UsageError(std::string("--input-format = ") + toString(s.folder.format) +
                     ", but " + s.input + " is a file of several scans");
  s.to_e57 = goesToE57(s);
  if (s.to_e57 && s.full)
    throw UsageError("--full joins scans, but an E57 file keeps each scan as a "
                     "separate station: leave --full out");
  if (!s.to_e57) {
    table.check([&] { s.writer.format = scanFormatFromName(s.format); });
    s.writer.format = outputFormat(s, !folder || s.full);
    s.writer.encoding = outputEncoding(s);
  }
  table.check([&] { s.folder.validate(); });
  takeCoordinateSystem(table, s);
  const bool encodes = !s.to_e57 && (s.writer.format == ScanFormat::kPcd ||
                                     s.writer.format == ScanFormat::kPly);
  s.without_effect = table.withoutEffect({{"encoding", encodes, "of pcd and ply"}});
  if (!folder || several || s.to_e57)
    refuseInputs(s.output, {s.input}, "the input");
  return true;
}

} // namespace pcl6d::app
