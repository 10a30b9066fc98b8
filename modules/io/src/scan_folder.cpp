// SPDX-License-Identifier: BSD-3-Clause
#include "formats.h"
#include "initial_poses.h"
#include "natural_order.h"
#include "text.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/io/scan_folder.h>

#include <algorithm>

namespace pcl6d {

namespace fs = std::filesystem;

namespace {

/** \brief The scans of a folder, all of one format. */
struct FoundScans {
  std::vector<fs::path> files; ///< in natural order
  ScanFormat format = ScanFormat::kAuto;
};

bool
isScan(const fs::directory_entry& entry)
{
  // The name decides. What then proves to be a folder or a link to nowhere is an error when
  // it is read: left out in silence it would shift all poses.
  return entry.path().filename().string().front() != '.' &&
         !isGroundtruth(entry.path()) &&
         scanFormatOfExtension(entry.path()) != ScanFormat::kAuto;
}

/** \return the files with the extension of any format, in natural order */
std::vector<fs::path>
scanFiles(const fs::path& folder)
{
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (status.type() == fs::file_type::not_found)
    text::fail(folder, "no such folder"); // or a part of its path is none
  if (!error && !fs::is_directory(status))
    text::fail(folder, "is a file, but must be a folder of scans");
  std::vector<fs::path> files;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    if (isScan(*entry))
      files.push_back(entry->path());
  if (error)
    text::fail(folder, error.message());
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return naturalLess(a.filename().string(), b.filename().string());
  });
  return files;
}

/** \return the one format of all files */
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
                     " (" + file.filename().string() + "); choose one with --format");
  }
  return first;
}

FoundScans
findScans(const fs::path& folder, ScanFormat format)
{
  FoundScans scans{scanFiles(folder), format};
  auto& files = scans.files;
  if (format != ScanFormat::kAuto)
    files.erase(std::remove_if(files.begin(),
                               files.end(),
                               [format](const fs::path& file) {
                                 return extensionOf(scanFormatOfExtension(file)) !=
                                        extensionOf(format);
                               }),
                files.end());
  if (files.empty())
    text::fail(
        folder,
        "no scans found (looked for " +
            (format == ScanFormat::kAuto ? allExtensions() : extensionOf(format)) +
            ")");
  if (format == ScanFormat::kAuto)
    scans.format = commonFormat(folder, files);
  return scans;
}

} // namespace

void
ScanFolderOptions::validate() const
{
  require(first >= 0, "first", first, ">= 0");
  require(!last || *last >= first,
          "last",
          last.value_or(0),
          ">= first = " + std::to_string(first));
  require(every >= 1, "every", every, ">= 1");
}

ScanFolder::ScanFolder(const fs::path& folder, const ScanFolderOptions& options)
{
  options.validate();
  const FoundScans scans = findScans(folder, options.format);
  const std::size_t count = scans.files.size();
  const auto first = static_cast<std::size_t>(options.first);
  if (first >= count)
    throw BadArgument("first = " + std::to_string(first) + ", but the folder holds " +
                      text::counted(count, "scan"));
  const std::size_t end =
      options.last ? std::min(count, static_cast<std::size_t>(*options.last) + 1)
                   : count;
  const InitialPoses poses =
      findInitialPoses(folder, scans.files, scans.format, options.poses_file);
  format_ = scans.format;
  pose_source_ = poses.source;
  for (std::size_t i = first; i < end; i += static_cast<std::size_t>(options.every)) {
    entries_.push_back(
        {scans.files[i], static_cast<int>(i), poses.trajectory.poses[i]});
    if (!poses.trajectory.stamps.empty())
      stamps_.push_back(poses.trajectory.stamps[i]);
  }
}

std::size_t
ScanFolder::size() const
{
  return entries_.size();
}

const fs::path&
ScanFolder::file(std::size_t i) const
{
  return entries_.at(i).file;
}

int
ScanFolder::index(std::size_t i) const
{
  return entries_.at(i).index;
}

const Eigen::Isometry3d&
ScanFolder::initialPose(std::size_t i) const
{
  return entries_.at(i).pose;
}

const std::vector<double>&
ScanFolder::stamps() const
{
  return stamps_;
}

const std::string&
ScanFolder::poseSource() const
{
  return pose_source_;
}

bool
ScanFolder::hasPoses() const
{
  return pose_source_ != kNoPoses;
}

Scan
ScanFolder::read(std::size_t i) const
{
  return readScan(file(i), format_);
}

ScanCloud
ScanFolder::readCloud(std::size_t i) const
{
  return readScanCloud(file(i), format_);
}

ScanFormat
ScanFolder::format() const
{
  return format_;
}

} // namespace pcl6d
