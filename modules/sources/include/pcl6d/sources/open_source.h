// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/scan_source.h>

#include <filesystem>
#include <memory>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \return whether a file can hold several scans: the extension .e57 or .ptx, in upper or lower
 * case, or a robot's recording (isBag()). A file need not exist.
 * \ingroup sources */
bool
isSourceFile(const std::filesystem::path& path);

/** \return whether the path is a file in the sense of isSourceFile(), or a folder with such
 * files and no further scans \ingroup sources */
bool
holdsSourceScans(const std::filesystem::path& path);

/** \brief Opens a folder of scans, or a file in the sense of isSourceFile().
 * \param[in] bag options for robots' recordings
 * \throws IoFailed the path is missing, unreadable, broken, or holds no scan \ingroup sources */
std::shared_ptr<const ScanSource>
openSource(const std::filesystem::path& path, const BagOptions& bag = {});

/** \brief Opens a folder or a file of several scans, selects scans and finds the initial poses:
 * the input of a run.
 * \throws IoFailed under the conditions of openSource() and ScanFolder
 * \throws BadArgument an option is invalid, selects no scan, or names a single-scan format for
 * a file of several scans \ingroup sources */
ScanFolder
openScanFolder(const std::filesystem::path& path,
               const ScanFolderOptions& options = {});

/** \brief Opens several files as a run, with the scans in the given order (FileListSource). A
 * single path may be a folder, see openScanFolder().
 * \throws IoFailed under the conditions of openScanFolder() and FileListSource
 * \throws BadArgument under the conditions of openScanFolder(), or for an empty list
 * \ingroup sources */
ScanFolder
openScanFiles(const std::vector<std::filesystem::path>& paths,
              const ScanFolderOptions& options = {});

/** \brief openScanFiles() without folders; also accepts a single file with a single scan.
 * \throws IoFailed under the conditions of FileListSource \throws BadArgument under the
 * conditions of ScanFolder */
ScanFolder
openFileList(const std::vector<std::filesystem::path>& paths,
             const ScanFolderOptions& options = {});

} // namespace pcl6d
