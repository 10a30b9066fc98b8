// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/other_scan_format.h>
#include <pcl6d/io/scan_reader.h>

#include <optional>
#include <string_view>

/** \file The formats of scans; PCD is in <pcl6d/io/pcd_io.h>. The readers return the
 * points in our frame [m], invalid points included, and throw IoFailed naming file,
 * position, value and rule. */
namespace pcl6d::io {

/** \return the extensions of all formats, separated by blanks */
std::string
allExtensions();

/** \brief Precision for coordinates of a text that should become float32. */
enum class Digits { kFloat, kDouble };

/** \return whether a text read in float32 must be read again in double: the points lie far from
 * the origin (offsetOfFar()), and the file can be read twice */
bool
needsDouble(const std::filesystem::path& path, const pcl::PCLPointCloud2& cloud);

/** \brief readScanCloud() with the points moved (moveCloud()) before non-finite points are
 * dropped. \param[in] other replaces the format, unless null */
ScanCloud
readMovedCloud(const std::filesystem::path& path,
               const ScanReaderOptions& options,
               const OtherScanFormat* other,
               const Eigen::Isometry3d& motion);

/** \brief Applies an optional motion to the points of a scan, and removes non-finite points.
 * \param[in] path for messages \throws IoFailed fields and data do not fit */
ScanCloud
finiteMoved(const std::filesystem::path& path,
            ScanCloud scan,
            const std::optional<Eigen::Isometry3d>& motion);

/** \return the vertices with all scalar properties, under PCL's names */
ScanCloud
readPly(const std::filesystem::path& path);

/** \return x y z of 3DTK's left-handed text, converted */
ScanCloud
readUos(const std::filesystem::path& path);

/** \return x y z intensity, from 3DTK's text with a fourth column */
ScanCloud
readUosr(const std::filesystem::path& path);

/** \return the points of a text, in rows of x y z, or of the columns in the heading
 * \param[in] columns replace the columns of the heading, or empty (tableColumns())
 * \param[in] is_pts the file is PTS: without a heading the number of columns determines their
 * meaning
 * \throws BadArgument the columns are invalid */
ScanCloud
readTable(const std::filesystem::path& path,
          const std::vector<std::string>& columns,
          bool is_pts);

/** \return the points of a .bin file with the fields of the layout
 * \throws IoFailed the size does not fit, or the layout is ambiguous */
ScanCloud
readKitti(const std::filesystem::path& path, BinLayout layout);

/** \return the points of a PTX file with a single scan \throws IoFailed the file holds several
 * scans */
ScanCloud
readPtx(const std::filesystem::path& path);

/** \return the points of LAS or LAZ with attributes; coordinates in double if far from the
 * origin */
ScanCloud
readLas(const std::filesystem::path& path);

} // namespace pcl6d::io
