// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/io/point_times.h>

#include <pcl/PCLPointCloud2.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief File formats of scans.
 *
 * kPcd: PCD, all encodings and fields. kPly: PLY points or mesh vertices. kUos: 3DTK's `.3d`
 * text, left-handed centimetres, converted to our frame (x forward, y left, z up, metres).
 * kUosr: kUos with a fourth column, the reflectance, our field `intensity`. kKitti: `.bin` of
 * float32 x y z intensity. kXyz: text, x y z in metres at the start of each line, or columns by
 * a heading. kPtx: PTX with a single scan (files with several: listPtxScans()). kPts: kXyz
 * after a count, with x y z, intensity and colour. kCsv, kTxt: text with columns by a heading,
 * else x y z. kLas: LAS 1.0 to 1.4, point formats 0 to 10. kLaz: compressed LAS, point formats
 * 0 to 3 and 6 to 8; LAS and LAZ are read under either name. kAuto: by file extension; `.3d` is
 * kUos. */
enum class ScanFormat {
  kAuto,
  kPcd,
  kPly,
  kUos,
  kUosr,
  kKitti,
  kXyz,
  kLas,
  kLaz,
  kPtx,
  kPts,
  kCsv,
  kTxt
};

/** \return the format called "auto", "pcd", "ply", "uos", "uosr", "kitti", "xyz", "las",
 * "laz", "ptx", "pts", "csv" or "txt"
 * \throws BadArgument unknown name */
ScanFormat
scanFormatFromName(const std::string& name);

/** \return the name of the format */
std::string
toString(ScanFormat format);

/** \return the format of the file extension, in any case; kAuto if unknown */
ScanFormat
scanFormatOfExtension(const std::filesystem::path& path);

/** \return the extension of the format's files with the dot; empty for kAuto */
std::string
extensionOf(ScanFormat format);

/** \return the coordinate system of a LAS or LAZ file as well-known text; empty: not given, or
 * only by keys of GeoTIFF \throws IoFailed the file cannot be read, or the header is broken */
std::string
coordinateSystemOfLas(const std::filesystem::path& path);

/** \brief The points of a file. */
struct ScanCloud {
  pcl::PCLPointCloud2
      cloud;               ///< all fields of the finite points, in the scan's frame [m]
  std::size_t dropped = 0; ///< points left out because x, y or z was not finite
  /** content of the file that was not read, such as the faces of a mesh */
  std::vector<std::string> left_out;
  /** points in a row of the file, including points left out; 0: an unorganized list of points */
  std::size_t row_length = 0;
  /** of each point in the rows of the file, counted row by row; empty if every point was kept,
   * or without rows */
  std::vector<std::uint32_t> places;
};

/** \brief A scan from a file. */
struct Scan : ScanCloud {
  Points points; ///< x, y, z of the cloud, in the same order
};

/** \brief Layout of a point in a .bin file (kKitti). kXyz: float32 x y z; kXyzi: with intensity
 * (KITTI); kXyzir: with intensity and ring (nuScenes); kXyzit: with intensity and time;
 * kXyzirt: with intensity, ring and time; kNclt: 8 bytes, x y z as uint16 in steps of 5 mm from
 * -100 m, intensity and ring as uint8, converted from NCLT's frame (x forward, y right, z
 * down). kHelipr...: packed records of HeLiPR's four sensors, float32 x y z followed for Avia
 * by intensity, tag and line as uint8, time as uint32 [ns]; for Aeva by reflectivity, velocity
 * [m/s], time as int32 [ns], line as uint8, and optionally intensity; for Ouster by intensity,
 * time as uint32 [ns], reflectivity, ring and ambient as uint16; for Velodyne by intensity,
 * ring as uint16, time as float32 [s]. kAuto: recognised by size and values, HeLiPR only by
 * folder names (layoutOfScans()). */
enum class BinLayout {
  kAuto,
  kXyz,
  kXyzi,
  kXyzir,
  kXyzit,
  kXyzirt,
  kNclt,
  kHeliprAvia,
  kHeliprAeva,
  kHeliprOuster,
  kHeliprVelodyne
};

/** \return the layout called "auto", "xyz", "xyzi", "xyzir", "xyzit", "xyzirt", "nclt",
 * "helipr-avia", "helipr-aeva", "helipr-ouster" or "helipr-velodyne"
 * \throws BadArgument another name */
BinLayout
binLayoutFromName(const std::string& name);

/** \return the name of the layout */
std::string
toString(BinLayout layout);

/** \brief How the points of a file are read. */
struct ScanReaderOptions {
  ScanFormat format = ScanFormat::kAuto; ///< auto: by the extension of the file
  /** of kXyz, kPts, kCsv and kTxt, instead of the heading: x, y, z, intensity (or i), r, g, b,
   * nx, ny, nz, ring, time; an empty word or "-" skips a column */
  std::vector<std::string> columns = {};
  BinLayout bin_layout = BinLayout::kAuto; ///< of kKitti
  PointTimes times = {};                   ///< of points in files without times
};

/** \return the words of a list, for example "x,y,z,,i" \throws BadArgument under the conditions
 * of readScanCloud() */
std::vector<std::string>
columnsFromText(const std::string& list);

/** \brief Reads a scan, right-handed and in metres for every format. Points with a non-finite x,
 * y or z are dropped and counted. The cloud has height 1 if points were dropped or the file was
 * not organized. \throws IoFailed naming file, position, value and rule: missing or unreadable
 * file, broken or truncated content, no x y z, text where a number belongs \ingroup io */
Scan
readScan(const std::filesystem::path& path, ScanFormat format = ScanFormat::kAuto);

/** \brief A scan moved near the origin, if the points were far away. */
struct NearScan : Scan {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero(); ///< subtracted, whole metres
  std::string description; ///< of the offset, a line for people; empty if zero
};

/** \brief readScan(), and subtracts offsetOfFar() in double. */
NearScan
readNearScan(const std::filesystem::path& path, ScanFormat format = ScanFormat::kAuto);

/** \brief readScan() without a second copy of x, y, z. */
ScanCloud
readScanCloud(const std::filesystem::path& path, ScanFormat format = ScanFormat::kAuto);

/** \brief readScanCloud() with options. \throws BadArgument the columns have an unknown or
 * repeated word, or lack x, y or z */
ScanCloud
readScanCloud(const std::filesystem::path& path, const ScanReaderOptions& options);

} // namespace pcl6d
