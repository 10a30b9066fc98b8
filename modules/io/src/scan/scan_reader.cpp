// SPDX-License-Identifier: BSD-3-Clause
#include "scan/point_field.h"
#include "scan/scan_formats.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/io/far_points.h>
#include <pcl6d/io/other_scan_format.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace pcl6d {

using namespace io;

namespace {

constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};

ScanCloud
pointsOfFile(const std::filesystem::path& path, const ScanReaderOptions& options)
{
  const ScanFormat format = options.format == ScanFormat::kAuto
                                ? scanFormatOfExtension(path)
                                : options.format;
  switch (format) {
  case ScanFormat::kPcd: {
    ScanCloud scan;
    scan.cloud = readPcd(path);
    return scan;
  }
  case ScanFormat::kPly:
    return readPly(path);
  case ScanFormat::kUos:
    return readUos(path);
  case ScanFormat::kUosr:
    return readUosr(path);
  case ScanFormat::kKitti:
    return readKitti(path, options.bin_layout);
  case ScanFormat::kXyz:
  case ScanFormat::kCsv:
  case ScanFormat::kTxt:
  case ScanFormat::kPts:
    return readTable(path, options.columns, format == ScanFormat::kPts);
  case ScanFormat::kPtx:
    return readPtx(path);
  case ScanFormat::kLas:
  case ScanFormat::kLaz: // the file header marks the compression
    return readLas(path);
  case ScanFormat::kAuto:
    break;
  }
  text::open(path); // a missing file has no format either
  text::fail(path,
             "unknown format of scans " + text::quoted(path.extension().string()) +
                 " (known: " + allExtensions() + ")");
}

/** \return all points of a file, with times by the rule of the options */
ScanCloud
readAllPoints(const std::filesystem::path& path, const ScanReaderOptions& options)
{
  ScanCloud scan = pointsOfFile(path, options);
  addPointTimes(options.times, scan.cloud);
  return scan;
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

/** \return for each point whether x, y and z are finite in float */
std::vector<bool>
finitePoints(const std::filesystem::path& path, const pcl::PCLPointCloud2& cloud)
{
  std::vector<bool> finite(std::size_t{cloud.width} * cloud.height, true);
  for (const char* const axis : kAxes) {
    const auto& field = coordinateField(path, cloud, axis);
    withTypeOf(field.datatype, [&](auto value) {
      const std::uint8_t* place = cloud.data.data() + field.offset;
      for (std::size_t i = 0; i < finite.size(); ++i, place += cloud.point_step) {
        std::memcpy(&value, place, sizeof value);
        if (!std::isfinite(static_cast<float>(value)))
          finite[i] = false;
      }
    });
  }
  return finite;
}

/** Keeps selected points, in order, in a single row. */
void
keepPoints(const std::vector<bool>& keep, ScanCloud& scan)
{
  pcl::PCLPointCloud2& cloud = scan.cloud;
  const std::size_t step = cloud.point_step;
  std::size_t kept = 0;
  const std::vector<std::uint32_t> before =
      std::move(scan.places); // of an earlier time
  scan.places.clear();
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i])
      continue;
    if (scan.row_length > 0)
      scan.places.push_back(before.empty() ? static_cast<std::uint32_t>(i) : before[i]);
    if (kept != i)
      std::memcpy(&cloud.data[kept * step], &cloud.data[i * step], step);
    ++kept;
  }
  scan.dropped += keep.size() - kept;
  cloud.data.resize(kept * step);
  cloud.width = static_cast<pcl::uindex_t>(kept);
  cloud.height = 1;
  cloud.row_step = cloud.width * cloud.point_step;
}

void
dropInvalid(const std::filesystem::path& path, ScanCloud& scan)
{
  const auto isFloat = [&](const char* axis) {
    return coordinateField(path, scan.cloud, axis).datatype ==
           pcl::PCLPointField::FLOAT32;
  };
  const bool floats = std::count_if(kAxes.begin(), kAxes.end(), isFloat) == 3;
  if (scan.cloud.data.empty())
    keepPoints({}, scan);
  else if (!floats || !scan.cloud.is_dense) { // else already checked by readPcd()
    const std::vector<bool> finite = finitePoints(path, scan.cloud);
    if (std::find(finite.begin(), finite.end(), false) != finite.end())
      keepPoints(finite, scan);
  }
  scan.cloud.is_dense = true;
}

/** \throws BadArgument fields and data of a cloud do not fit together */
void
requireFitting(const pcl::PCLPointCloud2& cloud)
{
  const std::size_t count = std::size_t{cloud.width} * cloud.height;
  const std::size_t step = std::max<std::size_t>(cloud.point_step, 1);
  require(cloud.data.size() % step == 0 && cloud.data.size() / step == count,
          "bytes of the cloud",
          cloud.data.size(),
          "those of " + text::counted(count, "point") + " of " +
              text::counted(cloud.point_step, "byte"));
  require(!cloud.is_bigendian, "is_bigendian", "true", "false");
  for (const auto& field : cloud.fields) {
    const std::size_t size =
        withTypeOf(field.datatype, [](auto value) { return sizeof value; });
    const std::size_t end =
        field.offset + size * std::max<pcl::uindex_t>(field.count, 1);
    require(end <= cloud.point_step,
            ("end of field " + field.name).c_str(),
            end,
            "within a point of " + std::to_string(cloud.point_step) + " bytes");
  }
}

pcl::PCLPointCloud2
readByOther(const std::filesystem::path& path, const OtherScanFormat& format)
{
  require(format.read != nullptr, "read", "none", "a function");
  try {
    return format.read(path);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    text::fail(path, "format " + format.name + ": " + e.what());
  }
}

/** The finite points of a reader's result, for readScanCloud(). */
ScanCloud
finitePart(const std::filesystem::path& path, ScanCloud scan)
{
  if (scan.cloud.height > 1)
    scan.row_length = scan.cloud.width;
  dropInvalid(path, scan);
  return scan;
}

} // namespace

bool
io::needsDouble(const std::filesystem::path& path, const pcl::PCLPointCloud2& cloud)
{
  const bool has_floats =
      std::any_of(cloud.fields.begin(), cloud.fields.end(), [](const auto& field) {
        return field.name == kAxes[0] && field.datatype == pcl::PCLPointField::FLOAT32;
      });
  std::error_code error;
  return has_floats && !offsetOfFar(cloud).isZero(0) &&
         std::filesystem::is_regular_file(path, error);
}

ScanCloud
readScanCloud(const std::filesystem::path& path, const ScanReaderOptions& options)
{
  return finitePart(path, readAllPoints(path, options));
}

ScanCloud
readScanCloud(const std::filesystem::path& path, ScanFormat format)
{
  ScanReaderOptions options;
  options.format = format;
  return readScanCloud(path, options);
}

ScanCloud
finiteScan(pcl::PCLPointCloud2 cloud, const std::filesystem::path& file)
{
  try {
    requireFitting(cloud);
  } catch (const BadArgument& e) {
    text::fail(file, e.what());
  }
  ScanCloud scan;
  scan.cloud = std::move(cloud);
  scan.cloud.is_dense = false; // not checked
  return finitePart(file, std::move(scan));
}

ScanCloud
readScanCloud(const std::filesystem::path& path, const OtherScanFormat& format)
{
  return finiteScan(readByOther(path, format), path);
}

ScanCloud
io::readMovedCloud(const std::filesystem::path& path,
                   const ScanReaderOptions& options,
                   const OtherScanFormat* other,
                   const Eigen::Isometry3d& motion)
{
  ScanCloud scan;
  if (other)
    scan.cloud = readByOther(path, *other);
  else
    scan = readAllPoints(path, options);
  return finiteMoved(path, std::move(scan), motion);
}

ScanCloud
io::finiteMoved(const std::filesystem::path& path,
                ScanCloud scan,
                const std::optional<Eigen::Isometry3d>& motion)
{
  try {
    requireFitting(scan.cloud);
    if (motion)
      moveCloud(*motion, scan.cloud);
  } catch (const BadArgument& e) {
    text::fail(path, e.what());
  }
  return finitePart(path, std::move(scan));
}

NearScan
readNearScan(const std::filesystem::path& path, ScanFormat format)
{
  NearScan scan;
  static_cast<ScanCloud&>(scan) = readScanCloud(path, format);
  const auto place = placeOf(scan.cloud);
  scan.offset = offsetOfFar(scan.cloud);
  if (!scan.offset.isZero(0)) {
    moveCloud(Eigen::Isometry3d(Eigen::Translation3d(-scan.offset)), scan.cloud);
    static_cast<ScanCloud&>(scan) = finitePart(path, std::move(scan));
    scan.description = describeFar(*place) + describeMove(scan.offset);
  }
  scan.points = coordinatesOf(scan.cloud);
  return scan;
}

Scan
readScan(const std::filesystem::path& path, ScanFormat format)
{
  Scan scan;
  static_cast<ScanCloud&>(scan) = readScanCloud(path, format);
  scan.points = coordinatesOf(scan.cloud);
  return scan;
}

} // namespace pcl6d
