// SPDX-License-Identifier: BSD-3-Clause
#include "ptx_source.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/natural_order.h>
#include <pcl6d/sources/bag_source.h>
#include <pcl6d/sources/e57_source.h>
#include <pcl6d/sources/file_list_source.h>
#include <pcl6d/sources/folder_source.h>
#include <pcl6d/sources/open_source.h>

#include <algorithm>
#include <cctype>

namespace pcl6d {

namespace {
namespace fs = std::filesystem;

std::string
lowerExtension(const fs::path& path)
{
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  });
  return extension;
}

bool
isFolder(const fs::path& path)
{
  std::error_code missing;
  return fs::is_directory(path, missing);
}

/** \return the multi-scan files of a folder without single-scan files, in natural order */
std::vector<fs::path>
sourceFilesOf(const fs::path& folder)
{
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path& file = entry->path();
    const ScanFormat format = scanFormatOfExtension(file);
    if (file.filename().string().front() == '.')
      continue;
    if (isSourceFile(file) && !isFolder(file))
      files.push_back(file);
    else if (format != ScanFormat::kAuto && format != ScanFormat::kTxt &&
             format != ScanFormat::kCsv)
      return {};
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return naturalLess(a.filename().string(), b.filename().string());
  });
  return files;
}

ScanReaderOptions
readingOf(const ScanFolderOptions& options)
{
  ScanReaderOptions reading;
  reading.format = options.format;
  reading.columns = options.columns;
  reading.bin_layout = options.bin_layout;
  return reading;
}

[[noreturn]] void
refuseFormat(const ScanFolderOptions& options, const std::string& reason)
{
  throw BadArgument(
      "format = " +
      (options.other_format ? options.other_format->name : toString(options.format)) +
      ", but " + reason);
}
} // namespace

bool
isSourceFile(const fs::path& path)
{
  const std::string extension = lowerExtension(path);
  return extension == ".e57" || extension == ".ptx" || isBag(path);
}

bool
holdsSourceScans(const fs::path& path)
{
  return isSourceFile(path) || (isFolder(path) && !sourceFilesOf(path).empty());
}

std::shared_ptr<const ScanSource>
openSource(const fs::path& path, const BagOptions& bag)
{
  if (isBag(path))
    return std::make_shared<BagSource>(path, bag);
  if (!isFolder(path) && lowerExtension(path) == ".e57")
    return std::make_shared<E57Source>(path);
  if (!isFolder(path) && isSourceFile(path))
    return std::make_shared<PtxSource>(path);
  if (const auto files = sourceFilesOf(path); !files.empty())
    return std::make_shared<FileListSource>(files, ScanReaderOptions(), bag);
  return std::make_shared<FolderSource>(path);
}

ScanFolder
openScanFolder(const fs::path& path, const ScanFolderOptions& options)
{
  const bool is_given = options.format != ScanFormat::kAuto || options.other_format;
  if (!holdsSourceScans(path) || (is_given && isFolder(path)))
    return ScanFolder(path, options);
  if (is_given)
    refuseFormat(options, path.string() + " is a file of several scans");
  return ScanFolder(openSource(path, options.bag), options);
}

ScanFolder
openScanFiles(const std::vector<fs::path>& paths, const ScanFolderOptions& options)
{
  if (paths.size() == 1)
    return openScanFolder(paths.front(), options);
  return openFileList(paths, options);
}

ScanFolder
openFileList(const std::vector<fs::path>& paths, const ScanFolderOptions& options)
{
  if (options.other_format)
    refuseFormat(options, "several files are read in the formats of the suite alone");
  return ScanFolder(
      std::make_shared<FileListSource>(paths, readingOf(options), options.bag),
      options);
}

} // namespace pcl6d
