// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/other_scan_format.h>
#include <pcl6d/io/scan_reader.h>

#include <string_view>

/** \file The formats of scans; PCD is in <pcl6d/io/pcd_io.h>. The readers return the
 * points in our frame [m], invalid points included, and throw IoFailed naming file,
 * place, value and rule. */
namespace pcl6d::io {

/** \return the extensions of all formats, separated by blanks */
std::string
allExtensions();

/** \brief How coordinates of a text are read that are meant as float32. */
enum class Digits { kFloat, kDouble };

/** \return whether a text that was read as float32 is to be read again in double: its
 * points lie far from the origin (offsetOfFar()), and it can be read again */
bool
needsDouble(const std::filesystem::path& path, const pcl::PCLPointCloud2& cloud);

/** \brief Reads a scan as readScanCloud(), and moves its points (moveCloud()) before those
 * that are not finite are dropped. \param[in] other in place of `format`, unless null */
ScanCloud
readMovedCloud(const std::filesystem::path& path,
               ScanFormat format,
               const OtherScanFormat* other,
               const Eigen::Isometry3d& motion);

/** \return the vertices with all their scalar properties, named as PCL names them */
ScanCloud
readPly(const std::filesystem::path& path);

/** \return x y z of 3DTK's left-handed text, converted */
ScanCloud
readUos(const std::filesystem::path& path);

/** \return x y z intensity of the same text with a fourth column */
ScanCloud
readUosr(const std::filesystem::path& path);

/** \return x y z of text */
ScanCloud
readXyz(const std::filesystem::path& path);

/** \return x y z intensity */
ScanCloud
readKitti(const std::filesystem::path& path);

} // namespace pcl6d::io
