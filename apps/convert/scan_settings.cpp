// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/option_table.h"
#include "convert/scan_settings.h"
#include "convert/verbs.h"

namespace pcl6d::app {

namespace {
constexpr const char* kScansUsage =
    R"( scans IN -o OUT [options]
Writes scans in another format: a scan (OUT is a file), the scans of a folder (OUT
is a new folder; the poses go along, as .pose files for uos and uosr, as VIEWPOINT
for pcd, else as poses.txt) or, with --full, all of them joined at their poses (OUT
is a file). IN may be the folder of a pcl_slam6d run: its scans and final poses.
Right-handed metres; uos and uosr: 3DTK's left-handed centimetres. Numbers keep all
digits; what the format cannot hold is told line by line.
)";

void
addOptions(OptionTable& table, ScanSettings& s)
{
  table.positional("IN", &s.input);
  table.group("Output");
  table.add("output,o OUT", &s.output).required().help("file or folder");
  table.add("format NAME", &s.writer.format, scanFormatFromName)
      .help("auto|pcd|ply|uos|uosr|kitti|xyz; auto: by the extension of OUT; uosr: uos "
            "with reflectance, kitti: .bin");
  table.add("encoding NAME", &s.encoding)
      .help(
          "auto|ascii|binary|binary_compressed (pcd only); auto: binary_compressed for "
          "pcd, binary for ply and with --full");
  table.add("full", &s.full)
      .help("join the scans of a folder at full resolution in one file");
  table.group("Input");
  table.add("input-format NAME", &s.folder.format, scanFormatFromName)
      .help("as --format; auto: by extension, .3d is uos");
  table.add("poses FILE", &s.folder.poses_file)
      .help("poses of a folder, KITTI or TUM rows");
  table.add("first N", &s.folder.first).help("first scan of a folder");
  table.add("last N", &s.folder.last).help("last scan of a folder");
  table.add("every N", &s.folder.every).help("each N-th scan of a folder");
  table.group("Run");
  s.memory.addTo(table);
  table.add("quiet", &s.quiet).help("no progress");
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
                     ": pcd, ply, uos, uosr, kitti or xyz");
  if (named != ScanFormat::kAuto && of_file != ScanFormat::kAuto &&
      extensionOf(named) != extensionOf(of_file))
    throw UsageError(std::string("--format = ") + toString(named) + ", but " +
                     s.output + " has the extension of " + toString(of_file));
  return named == ScanFormat::kAuto ? of_file : named;
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
} // namespace

bool
parseScanSettings(const std::vector<std::string>& arguments, ScanSettings& s)
{
  OptionTable table(std::string("usage: ") + kConvert + kScansUsage);
  addOptions(table, s);
  if (!table.parse(arguments))
    return false;
  const bool folder = std::filesystem::is_directory(s.input);
  table.needFolder(s.input, {"full", "poses", "first", "last", "every"});
  s.writer.format = outputFormat(s, !folder || s.full);
  s.writer.encoding = outputEncoding(s);
  table.check([&] { s.folder.validate(); });
  const bool encodes =
      s.writer.format == ScanFormat::kPcd || s.writer.format == ScanFormat::kPly;
  s.without_effect = table.withoutEffect({{"encoding", encodes, "of pcd and ply"}});
  if (!folder)
    refuseInputs(s.output, {s.input}, "the input");
  return true;
}

} // namespace pcl6d::app
