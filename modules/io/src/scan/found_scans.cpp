// SPDX-License-Identifier: BSD-3-Clause
#include "scan/found_scans.h"
#include "scan/initial_poses.h"
#include "scan/scan_formats.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/natural_order.h>
#include <pcl6d/io/text.h>

#include <algorithm>
#include <functional>

namespace pcl6d::io {

namespace fs = std::filesystem;

namespace {

using IsOfFormat = std::function<bool(const fs::path&)>;

/** \return a predicate for file names of a format */
IsOfFormat
isOfFormat(const ScanFolderOptions& options)
{
  if (options.other_format)
    return [&](const fs::path& file) {
      return hasExtensionOf(*options.other_format, file);
    };
  if (options.format == ScanFormat::kAuto)
    return [](const fs::path& file) {
      return scanFormatOfExtension(file) != ScanFormat::kAuto;
    };
  return [extension = extensionOf(options.format)](const fs::path& file) {
    return extensionOf(scanFormatOfExtension(file)) == extension && !isPosesFile(file);
  };
}

/** For a folder without a given format: tables beside scans are ignored, and .txt files
 * altogether, because poses, times and notes have the extension. */
void
leaveOutTables(std::vector<fs::path>& files)
{
  const auto is = [](ScanFormat format) {
    return [format](const fs::path& file) {
      return scanFormatOfExtension(file) == format;
    };
  };
  files.erase(std::remove_if(files.begin(), files.end(), is(ScanFormat::kTxt)),
              files.end());
  if (!std::all_of(files.begin(), files.end(), is(ScanFormat::kCsv)))
    files.erase(std::remove_if(files.begin(), files.end(), is(ScanFormat::kCsv)),
                files.end());
}

bool
isScan(const fs::directory_entry& entry, const IsOfFormat& is_of_format)
{
  // The name decides. A match that is a folder or a broken link fails on reading: skipping
  // would shift all poses.
  return entry.path().filename().string().front() != '.' &&
         !isGroundtruth(entry.path()) && is_of_format(entry.path());
}

/** \return the scans of a format, in natural order */
std::vector<fs::path>
scanFiles(const fs::path& folder, const IsOfFormat& is_of_format)
{
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (status.type() == fs::file_type::not_found)
    text::fail(folder, "no such folder"); // or a part of the path is missing
  if (!error && !fs::is_directory(status))
    text::fail(folder, "is a file, but must be a folder of scans: give its folder");
  std::vector<fs::path> files;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    if (isScan(*entry, is_of_format))
      files.push_back(entry->path());
  if (error)
    text::fail(folder, error.message());
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return naturalLess(a.filename().string(), b.filename().string());
  });
  return files;
}

/** \return the common format of all files */
ScanFormat
commonFormat(const fs::path& folder, const std::vector<fs::path>& files)
{
  const ScanFormat first = scanFormatOfExtension(files.front());
  for (const auto& file : files) {
    const ScanFormat other = scanFormatOfExtension(file);
    if (other != first)
      text::fail(folder,
                 "holds scans of several formats, " + extensionOf(first) + " (" +
                     files.front().filename().string() + ") and " + extensionOf(other) +
                     " (" + file.filename().string() + "); choose one of them");
  }
  return first;
}

/** \return the scans of a folder itself, in natural order */
std::vector<fs::path>
scansIn(const fs::path& folder, const ScanFolderOptions& options)
{
  std::vector<fs::path> files = scanFiles(folder, isOfFormat(options));
  if (options.format == ScanFormat::kAuto && !options.other_format)
    leaveOutTables(files);
  return files;
}

/** Enters a folder of a usual name where the folder itself holds no scans. */
void
enterFolder(const fs::path& folder, const ScanFolderOptions& options, FoundScans& scans)
{
  for (const char* const name :
       {"velodyne", "velodyne_points/data", "lidar", "scans"}) {
    std::error_code missing;
    if (!fs::is_directory(folder / name, missing))
      continue;
    auto files = scansIn(folder / name, options);
    if (!files.empty() && !scans.files.empty())
      text::fail(folder,
                 "holds scans in " + scans.entered + " and in " + name +
                     "; choose one of them");
    if (files.empty())
      continue;
    scans.files = std::move(files);
    scans.entered = name;
  }
}

/** Takes the scans of the only sequence below a folder, which is a data set or a folder on the
 * path to the scans. */
void
enterDataset(const fs::path& folder,
             const ScanFolderOptions& options,
             FoundScans& scans)
{
  auto layout = findDataset(folder);
  if (!layout)
    return;
  auto files = scansIn(layout->scans, options);
  if (files.empty())
    return;
  scans.files = std::move(files);
  scans.entered = layout->scans.lexically_relative(folder).string();
}

/** Depth of the folders searched for a hint, and their largest number: a home folder has many. */
constexpr int kHintDepth = 2;
constexpr std::size_t kMostHintFolders = 200;

/** \return the folders below, the upper ones first, in alphabetical order */
std::vector<fs::path>
foldersBelow(const fs::path& folder)
{
  std::vector<fs::path> above = {folder}, all;
  for (int depth = 0; depth < kHintDepth; ++depth) {
    std::vector<fs::path> below;
    for (const fs::path& one : above) {
      std::error_code error;
      fs::directory_iterator entry(one, error);
      for (; !error && entry != fs::directory_iterator(); entry.increment(error))
        if (std::error_code broken_link; entry->is_directory(broken_link) &&
                                         below.size() + all.size() < kMostHintFolders)
          below.push_back(entry->path());
    }
    std::sort(below.begin(), below.end());
    all.insert(all.end(), below.begin(), below.end());
    above = std::move(below);
  }
  return all;
}

/** \return where scans lie below a folder without scans, for its message; empty if nowhere */
std::string
hintOfScansBelow(const fs::path& folder, const ScanFolderOptions& options)
{
  for (const fs::path& below : foldersBelow(folder))
    try {
      if (!scansIn(below, options).empty())
        return "; scans lie in " + below.string() + ": give this folder";
    } catch (const IoFailed&) { // an unreadable folder gives no hint
    }
  return "";
}

bool
areTables(const std::vector<fs::path>& files)
{
  return std::all_of(files.begin(), files.end(), [](const fs::path& file) {
    return scanFormatOfExtension(file) == ScanFormat::kCsv;
  });
}

/** \return whether to read the scans by the rules of the layout */
bool
isOfLayout(const DatasetLayout& layout, const FoundScans& scans)
{
  return std::all_of(scans.files.begin(), scans.files.end(), [&](const fs::path& file) {
    return scanFormatOfExtension(file) == layout.format;
  });
}

/** Recognises the data set by the folder of the scans. */
void
takeLayout(const fs::path& folder, const ScanFolderOptions& options, FoundScans& scans)
{
  const fs::path of_scans = scans.entered.empty() ? folder : folder / scans.entered;
  scans.folders = {of_scans};
  if (!scans.entered.empty())
    scans.folders.push_back(folder);
  if (options.other_format)
    return;
  auto layout = layoutOfScans(of_scans);
  if (!layout || !isOfLayout(*layout, scans))
    return;
  std::error_code error;
  if (scans.entered.empty() || !fs::equivalent(folder, layout->sequence, error))
    scans.folders.push_back(layout->sequence);
  scans.layout = std::move(layout);
}
} // namespace

FoundScans
findScans(const fs::path& folder, const ScanFolderOptions& options)
{
  FoundScans scans;
  scans.files = scansIn(folder, options);
  scans.format = options.format;
  const bool is_auto = options.format == ScanFormat::kAuto;
  if (scans.files.empty())
    enterFolder(folder, options, scans);
  // Beside the folder of the scans lie tables of poses (MulRan).
  if (!options.other_format &&
      (scans.files.empty() || (is_auto && areTables(scans.files))))
    enterDataset(folder, options, scans);
  if (scans.files.empty())
    text::fail(folder,
               "no scans found (looked for " +
                   (options.other_format ? options.other_format->extension
                    : is_auto            ? allExtensions()
                                         : extensionOf(options.format)) +
                   ")" + hintOfScansBelow(folder, options));
  if (options.other_format)
    scans.format = ScanFormat::kAuto;
  else if (is_auto)
    scans.format = commonFormat(folder, scans.files);
  takeLayout(folder, options, scans);
  return scans;
}

} // namespace pcl6d::io
