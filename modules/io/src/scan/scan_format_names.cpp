// SPDX-License-Identifier: BSD-3-Clause
#include "scan/scan_formats.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/text.h>

#include <array>
#include <cctype>
#include <string_view>

namespace pcl6d {

namespace {

/** Names of the formats on the command line, and extensions. */
struct ScanFormatName {
  ScanFormat format;
  std::string_view name;
  std::string_view extension;
};
// If two formats share an extension, the first is the default.
constexpr std::array<ScanFormatName, 13> kScanFormats = {
    {{ScanFormat::kPcd, "pcd", ".pcd"},
     {ScanFormat::kPly, "ply", ".ply"},
     {ScanFormat::kUos, "uos", ".3d"},
     {ScanFormat::kUosr, "uosr", ".3d"},
     {ScanFormat::kKitti, "kitti", ".bin"},
     {ScanFormat::kXyz, "xyz", ".xyz"},
     {ScanFormat::kLas, "las", ".las"},
     {ScanFormat::kLaz, "laz", ".laz"},
     {ScanFormat::kPtx, "ptx", ".ptx"},
     {ScanFormat::kPts, "pts", ".pts"},
     {ScanFormat::kCsv, "csv", ".csv"},
     {ScanFormat::kTxt, "txt", ".txt"},
     {ScanFormat::kTxt, "txt", ".asc"}}};

std::string
inLowerCase(std::string text)
{
  for (char& c : text)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

} // namespace

ScanFormat
scanFormatOfExtension(const std::filesystem::path& path)
{
  const std::string extension = inLowerCase(path.extension().string());
  for (const auto& known : kScanFormats)
    if (extension == known.extension)
      return known.format;
  return ScanFormat::kAuto;
}

std::string
extensionOf(ScanFormat format)
{
  for (const auto& known : kScanFormats)
    if (known.format == format)
      return std::string(known.extension);
  return {};
}

std::string
toString(ScanFormat format)
{
  for (const auto& known : kScanFormats)
    if (known.format == format)
      return std::string(known.name);
  return "auto";
}

std::string
io::allExtensions()
{
  std::string extensions;
  for (const auto& known : kScanFormats)
    if (extensions.find(known.extension) == std::string::npos)
      extensions += (extensions.empty() ? "" : " ") + std::string(known.extension);
  return extensions;
}

ScanFormat
scanFormatFromName(const std::string& name)
{
  if (name == "auto")
    return ScanFormat::kAuto;
  for (const auto& known : kScanFormats)
    if (name == known.name)
      return known.format;
  throw BadArgument("format = " + text::quoted(name) +
                    ", but must be auto, pcd, ply, uos, uosr, kitti, xyz, las, "
                    "laz, ptx, pts, csv or txt");
}

bool
hasExtensionOf(const OtherScanFormat& format, const std::filesystem::path& path)
{
  return inLowerCase(path.extension().string()) == inLowerCase(format.extension);
}

} // namespace pcl6d
