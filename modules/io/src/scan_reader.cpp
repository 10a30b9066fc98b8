// SPDX-License-Identifier: BSD-3-Clause
#include "formats.h"
#include "point_field.h"
#include "text.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/pcd_io.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>

namespace pcl6d {

namespace {

/** What the formats are called, on the command line and as files. */
struct FormatName {
  ScanFormat format;
  std::string_view name;
  std::string_view extension;
};
constexpr std::array<FormatName, 5> kFormats = {{{ScanFormat::kPcd, "pcd", ".pcd"},
                                                 {ScanFormat::kPly, "ply", ".ply"},
                                                 {ScanFormat::kUos, "uos", ".3d"},
                                                 {ScanFormat::kKitti, "kitti", ".bin"},
                                                 {ScanFormat::kXyz, "xyz", ".xyz"}}};

pcl::PCLPointCloud2
readCloud(const std::filesystem::path& path, ScanFormat format)
{
  switch (format == ScanFormat::kAuto ? formatOfExtension(path) : format) {
  case ScanFormat::kPcd:
    return readPcd(path);
  case ScanFormat::kPly:
    return readPly(path);
  case ScanFormat::kUos:
    return readUos(path);
  case ScanFormat::kKitti:
    return readKitti(path);
  case ScanFormat::kXyz:
    return readXyz(path);
  case ScanFormat::kAuto:
    break;
  }
  text::fail(path,
             "unknown format of scans " + text::quoted(path.extension().string()) +
                 " (known: " + allExtensions() + ")");
}

const pcl::PCLPointField&
coordinateField(const std::filesystem::path& path,
                const pcl::PCLPointCloud2& cloud,
                const std::string& name)
{
  for (const auto& field : cloud.fields) {
    if (field.name != name)
      continue;
    if (field.datatype != pcl::PCLPointField::FLOAT32 &&
        field.datatype != pcl::PCLPointField::FLOAT64)
      text::fail(path, "field '" + name + "' is not float32 or float64");
    return field;
  }
  text::fail(path, "has no field '" + name + "'");
}

/** \return the x, y, z of all points, rounded to float */
Points
coordinates(const std::filesystem::path& path, const pcl::PCLPointCloud2& cloud)
{
  Points points(std::size_t{cloud.width} * cloud.height);
  for (int axis = 0; axis < 3; ++axis) {
    const auto& field =
        coordinateField(path, cloud, std::string(1, static_cast<char>('x' + axis)));
    withTypeOf(field.datatype, [&](auto value) {
      for (std::size_t i = 0; i < points.size(); ++i) {
        std::memcpy(
            &value, &cloud.data[i * cloud.point_step + field.offset], sizeof value);
        points[i][axis] = static_cast<float>(value);
      }
    });
  }
  return points;
}

/** Leaves the finite points in their order. */
void
dropInvalid(Scan& scan)
{
  const std::size_t step = scan.cloud.point_step;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if (!scan.points[i].allFinite())
      continue;
    if (kept != i) {
      scan.points[kept] = scan.points[i];
      std::memcpy(&scan.cloud.data[kept * step], &scan.cloud.data[i * step], step);
    }
    ++kept;
  }
  scan.dropped = scan.points.size() - kept;
  scan.points.resize(kept);
  scan.cloud.data.resize(kept * step);
  if (scan.dropped > 0 || kept == 0) {
    scan.cloud.width = static_cast<pcl::uindex_t>(kept);
    scan.cloud.height = 1;
    scan.cloud.row_step = scan.cloud.width * scan.cloud.point_step;
  }
  scan.cloud.is_dense = true;
}

} // namespace

ScanFormat
formatOfExtension(const std::filesystem::path& path)
{
  std::string extension = path.extension().string();
  for (char& c : extension)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const auto& known : kFormats)
    if (extension == known.extension)
      return known.format;
  return ScanFormat::kAuto;
}

std::string_view
extensionOf(ScanFormat format)
{
  for (const auto& known : kFormats)
    if (known.format == format)
      return known.extension;
  return {};
}

std::string
allExtensions()
{
  std::string extensions;
  for (const auto& known : kFormats)
    extensions += (extensions.empty() ? "" : " ") + std::string(known.extension);
  return extensions;
}

ScanFormat
scanFormatFromName(const std::string& name)
{
  if (name == "auto")
    return ScanFormat::kAuto;
  for (const auto& known : kFormats)
    if (name == known.name)
      return known.format;
  throw BadArgument("format = " + text::quoted(name) +
                    ", but must be auto, pcd, ply, uos, kitti or xyz");
}

Scan
readScan(const std::filesystem::path& path, ScanFormat format)
{
  Scan scan;
  scan.cloud = readCloud(path, format);
  scan.points = coordinates(path, scan.cloud);
  dropInvalid(scan);
  return scan;
}

} // namespace pcl6d
