// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/command_line.h"
#include "convert/scan_settings.h"
#include "convert/verbs.h"

#include <pcl6d/common/error.h>

namespace pcl6d::app {

namespace {
namespace po = boost::program_options;
namespace fs = std::filesystem;

/** \brief The options as they are written. */
struct Words {
  std::string input, output, poses;
  std::string format = "auto";
  std::string input_format = "auto";
  std::string encoding = "auto";
  int last = 0;
};

constexpr const char* kUsageText =
    " scans IN -o OUT [options]\n"
    "Writes scans in another format: a scan (OUT is a file), the scans of a folder "
    "(OUT\n"
    "is a new folder; the poses go along, as .pose files for uos and uosr, as "
    "VIEWPOINT\n"
    "for pcd, else as poses.txt) or, with --full, all of them joined at their poses "
    "(OUT\n"
    "is a file). IN may be the folder of a pcl_slam6d run: its scans and final poses.\n"
    "Right-handed metres; uos and uosr: 3DTK's left-handed centimetres. Numbers keep "
    "all\n"
    "digits; what the format cannot hold is told line by line.\n";

void
describe(CommandLine& line, Words& words, ScanSettings& s)
{
  line.group("Output").add_options() //
      ("output,o",
       po::value(&words.output)->value_name("OUT")->required(),
       "file or folder") //
      ("format",
       valueOf(words.format)->value_name("NAME"),
       "auto|pcd|ply|uos|uosr|kitti|xyz; auto: by the extension of OUT; uosr: uos with "
       "reflectance, kitti: .bin") //
      ("encoding",
       valueOf(words.encoding)->value_name("NAME"),
       "auto|ascii|binary|binary_compressed (pcd only); auto: binary_compressed for "
       "pcd, "
       "binary for ply and with --full") //
      ("full",
       po::bool_switch(&s.full),
       "join the scans of a folder at full resolution in one file");
  line.group("Input").add_options() //
      ("input-format",
       valueOf(words.input_format)->value_name("NAME"),
       "as --format; auto: by extension, .3d is uos") //
      ("poses",
       po::value(&words.poses)->value_name("FILE"),
       "poses of a folder, KITTI or TUM rows")                                      //
      ("first", valueOf(s.folder.first)->value_name("N"), "first scan of a folder") //
      ("last", po::value(&words.last)->value_name("N"), "last scan of a folder")    //
      ("every", valueOf(s.folder.every)->value_name("N"), "each N-th scan of a folder");
  line.group("Messages")
      .add_options()("quiet", po::bool_switch(&s.quiet), "no progress");
}

/** \return the format to write, from its name or the extension of OUT */
ScanFormat
outputFormat(const Words& words, const ScanSettings& s, bool to_file)
{
  const ScanFormat named = scanFormatFromName(words.format);
  const ScanFormat of_file =
      to_file ? scanFormatOfExtension(s.output) : ScanFormat::kAuto;
  if (named == ScanFormat::kAuto && of_file == ScanFormat::kAuto)
    throw UsageError("--format is missing, as " +
                     (to_file ? "the extension of " + words.output + " is that of none"
                              : "a folder has no extension") +
                     ": pcd, ply, uos, uosr, kitti or xyz");
  if (named != ScanFormat::kAuto && of_file != ScanFormat::kAuto &&
      extensionOf(named) != extensionOf(of_file))
    throw UsageError("--format = " + words.format + ", but " + words.output +
                     " has the extension of " + toString(of_file));
  return named == ScanFormat::kAuto ? of_file : named;
}

PcdEncoding
outputEncoding(const std::string& name, const ScanSettings& s)
{
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

void
interpret(const CommandLine& line, const Words& words, ScanSettings& s)
{
  s.input = words.input;
  s.output = words.output;
  const bool folder = fs::is_directory(s.input);
  if (!folder)
    for (const char* const option : {"full", "poses", "first", "last", "every"})
      if (line.given(option))
        throw UsageError(std::string("--") + option + " needs a folder, but " +
                         words.input + " is none");
  checkOptions([&] { s.folder.format = scanFormatFromName(words.input_format); },
               {{"format", "input-format"}});
  checkOptions([&] { s.writer.format = outputFormat(words, s, !folder || s.full); });
  s.writer.encoding = outputEncoding(words.encoding, s);
  s.folder.poses_file = words.poses;
  if (line.given("last"))
    s.folder.last = words.last;
  checkOptions([&] { s.folder.validate(); });
  const bool encodes =
      s.writer.format == ScanFormat::kPcd || s.writer.format == ScanFormat::kPly;
  s.without_effect = line.withoutEffect({{"encoding", encodes, "of pcd and ply"}});
  std::error_code missing; // a missing file is no input
  if (!folder && fs::equivalent(s.output, s.input, missing))
    throw UsageError("--output = " + words.output + ", but that is the input");
}
} // namespace

bool
parseScanSettings(const std::vector<std::string>& arguments, ScanSettings& settings)
{
  CommandLine line(std::string("usage: ") + kConvert + kUsageText);
  Words words;
  line.positional("IN", &words.input);
  describe(line, words, settings);
  if (!line.parse(arguments))
    return false;
  interpret(line, words, settings);
  return true;
}

} // namespace pcl6d::app
