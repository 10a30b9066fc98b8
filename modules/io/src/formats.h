// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/scan_reader.h>

#include <string_view>

/** \file The formats of scans; PCD is in <pcl6d/io/pcd_io.h>. The readers return the
 * points in our frame [m], invalid points included, and throw IoFailed naming file,
 * place, value and rule. Internal to the module io. */
namespace pcl6d {

/** \return the format of files with this extension, whatever the case; kAuto if none */
ScanFormat
formatOfExtension(const std::filesystem::path& path);

/** \return the extension of the format's files, with its dot */
std::string_view
extensionOf(ScanFormat format);

/** \return the extensions of all formats, separated by blanks */
std::string
allExtensions();

/** \return the vertices with all their scalar properties, named as PCL names them */
pcl::PCLPointCloud2
readPly(const std::filesystem::path& path);

/** \return x y z of 3DTK's left-handed text, converted */
pcl::PCLPointCloud2
readUos(const std::filesystem::path& path);

/** \return x y z of text */
pcl::PCLPointCloud2
readXyz(const std::filesystem::path& path);

/** \return x y z intensity */
pcl::PCLPointCloud2
readKitti(const std::filesystem::path& path);

/** \return an unorganized cloud of float32 fields \param[in] values point by point
 * \param[in] names of the fields */
pcl::PCLPointCloud2
floatCloud(const std::vector<float>& values, const std::vector<std::string>& names);

} // namespace pcl6d
