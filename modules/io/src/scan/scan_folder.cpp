// SPDX-License-Identifier: BSD-3-Clause
#include "scan/initial_poses.h"
#include "scan/scan_formats.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/io/natural_order.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/text.h>
#include <pcl6d/io/trajectory_io.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

namespace pcl6d {

using namespace io;

namespace fs = std::filesystem;

namespace {

/** \return whether the stamps [s] of scans that a run has, too, are their numbers: as those of
 * one scan a second, which stampsOfRun() takes for none */
bool
areNumbers(const std::map<std::string, double>& stamps, const RunResult& summary)
{
  std::size_t count = 0;
  for (const auto& scan : summary.scans)
    if (const auto found = stamps.find(scan.file); found != stamps.end()) {
      if (found->second != scan.index)
        return false;
      ++count;
    }
  return count > 0;
}

/** \brief The scans of a folder, all of one format. */
struct FoundScans {
  std::vector<fs::path> files; ///< in natural order
  ScanFormat format = ScanFormat::kAuto;
};

using IsOfFormat = std::function<bool(const fs::path&)>;

/** \return what tells the files of a format by their names */
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
    return extensionOf(scanFormatOfExtension(file)) == extension;
  };
}

bool
isScan(const fs::directory_entry& entry, const IsOfFormat& is_of_format)
{
  // The name decides. What then proves to be a folder or a link to nowhere is an error when
  // it is read: left out in silence it would shift all poses.
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
    text::fail(folder, "no such folder"); // or a part of its path is none
  if (!error && !fs::is_directory(status))
    text::fail(folder, "is a file, but must be a folder of scans");
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
                     " (" + file.filename().string() + "); choose one of them");
  }
  return first;
}

FoundScans
findScans(const fs::path& folder, const ScanFolderOptions& options)
{
  FoundScans scans{scanFiles(folder, isOfFormat(options)), options.format};
  const bool is_auto = options.format == ScanFormat::kAuto;
  if (scans.files.empty())
    text::fail(folder,
               "no scans found (looked for " +
                   (options.other_format ? options.other_format->extension
                    : is_auto            ? allExtensions()
                                         : extensionOf(options.format)) +
                   ")");
  if (options.other_format)
    scans.format = ScanFormat::kAuto;
  else if (is_auto)
    scans.format = commonFormat(folder, scans.files);
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
: other_format_(options.other_format)
{
  options.validate();
  const FoundScans scans = findScans(folder, options);
  const std::size_t count = scans.files.size();
  const auto first = static_cast<std::size_t>(options.first);
  if (first >= count)
    throw BadArgument("first = " + std::to_string(first) + ", but the folder holds " +
                      text::counted(count, "scan"));
  const std::size_t end =
      options.last ? std::min(count, static_cast<std::size_t>(*options.last) + 1)
                   : count;
  InitialPoses poses =
      findInitialPoses(folder, scans.files, scans.format, options.poses_file);
  pose_source_ = poses.source;
  for (std::size_t i = first; i < end; i += static_cast<std::size_t>(options.every)) {
    entries_.push_back({scans.files[i],
                        scans.files[i].filename().string(),
                        static_cast<int>(i),
                        poses.trajectory.poses[i],
                        scans.format,
                        false,
                        poses.trajectory.poses[i]});
    if (!poses.trajectory.stamps.empty())
      stamps_.push_back(poses.trajectory.stamps[i]);
  }
  odometry_ = std::move(poses.trajectory);
  if (!options.keep_coordinates)
    lookAtFirst();
}

void
ScanFolder::lookAtFirst()
{
  try {
    first_ = std::make_shared<ScanCloud>(readEntry(entries_.front()));
  } catch (const IoFailed&) {
    return; // is told when it is read
  }
  const auto place = placeOf(first_->cloud);
  if (!place || !place->isFarFrom(Eigen::Vector3d::Zero()))
    return;
  first_.reset();
  bringNear(*place);
}

PoseReading
ScanFolder::readingOf(const PointsPlace& place, const Eigen::Vector3d& offset) const
{
  const Eigen::Isometry3d& first = entries_.front().given;
  double poses = 0, points = 0; // how far they spread
  for (const Entry& entry : entries_) {
    poses += (entry.given.translation() - first.translation()).norm();
    points += (entry.given * offset - first * offset).norm();
  }
  constexpr double kRounding = 1e-6; // [m] a scan, of products of 1e9 m in double
  const double rounding = kRounding * static_cast<double>(entries_.size());
  if (!place.isFarFrom(first.translation()) && poses <= points + rounding)
    return PoseReading::kStation;
  return poses < points - rounding ? PoseReading::kScanner : PoseReading::kFile;
}

void
ScanFolder::bringNear(const PointsPlace& place)
{
  const Eigen::Vector3d offset = place.middle.array().round();
  moved_ = {readingOf(place, offset), offset};
  coordinates_ = describeFar(place);
  if (moved_->reading == PoseReading::kStation) {
    moved_->offset.setZero();
    coordinates_ += ", in the world of their poses (" + pose_source_ +
                    "): taken back into the frames of the scanner";
  }
  else {
    coordinates_ += describeMove(offset);
    if (moved_->reading == PoseReading::kScanner)
      coordinates_ += ", which the poses (" + pose_source_ + ") do not hold";
    coordinates_ +=
        "; where the scanner stood among them is not known: ranges and rays "
        "begin in their middle";
  }
  for (Entry& entry : entries_)
    entry.is_far = true;
  placeNear();
  for (Eigen::Isometry3d& pose : odometry_.poses)
    pose = moved_->ofNear(pose);
}

void
ScanFolder::placeNear()
{
  for (Entry& entry : entries_)
    if (entry.is_far)
      entry.pose = moved_->ofNear(entry.given);
}

void
ScanFolder::continueRun(const fs::path& run, const RunResult& summary)
{
  std::vector<Entry> entries;
  std::set<std::string> known;
  int next = 0;
  for (const auto& scan : summary.scans) {
    const fs::path file = run / "scans" / (scanName(scan.index) + ".pcd");
    if (!fs::exists(file))
      text::fail(file,
                 "is missing, though " + (run / "summary.json").string() +
                     " tells of it");
    entries.push_back({file,
                       scan.file,
                       scan.index,
                       scan.initial_pose,
                       ScanFormat::kPcd,
                       false,
                       scan.initial_pose});
    known.insert(scan.file);
    next = std::max(next, scan.index + 1);
  }
  std::vector<double> stamps = stampsOfRun(run, summary);
  if (stamps.empty()) {
    std::map<std::string, double> found;
    for (std::size_t i = 0; i < stamps_.size(); ++i)
      found[entries_[i].name] = stamps_[i];
    if (areNumbers(found, summary))
      for (const auto& scan : summary.scans)
        stamps.push_back(scan.index);
  }
  for (std::size_t i = 0; i < entries_.size(); ++i)
    if (known.count(entries_[i].name) == 0) {
      entries.push_back(entries_[i]);
      entries.back().index = next++;
      if (!stamps.empty() && !stamps_.empty())
        stamps.push_back(stamps_[i]);
    }
  num_registered_ = summary.scans.size();
  if (entries.size() == num_registered_)
    text::fail(run,
               "holds all " + text::counted(entries_.size(), "scan") +
                   " of the folder already (scans are told apart by their file names)");
  if (stamps_.empty())
    stamps.clear();
  stamps_ = std::move(stamps);
  entries_ = std::move(entries);
  first_.reset();
  if (moved_ && summary.moved) { // the same trajectory goes on
    moved_ = summary.moved;
    placeNear();
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

const std::string&
ScanFolder::name(std::size_t i) const
{
  return entries_.at(i).name;
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

Eigen::Isometry3d
ScanFolder::poseOfFile(std::size_t i) const
{
  const Entry& entry = entries_.at(i);
  return entry.is_far ? entry.pose * moved_->toNear(entry.given) : entry.pose;
}

const std::vector<double>&
ScanFolder::stamps() const
{
  return stamps_;
}

const Trajectory&
ScanFolder::odometry() const
{
  return odometry_;
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
  Scan scan;
  static_cast<ScanCloud&>(scan) = readCloud(i);
  scan.points = coordinatesOf(scan.cloud);
  return scan;
}

ScanCloud
ScanFolder::readCloud(std::size_t i) const
{
  if (i == 0)
    if (const auto first = std::atomic_exchange(&first_, {}))
      return first.use_count() == 1 ? std::move(*first) : *first; // a copy may share it
  return readEntry(entries_.at(i));
}

ScanCloud
ScanFolder::readEntry(const Entry& entry) const
{
  const OtherScanFormat* const other =
      entry.format == ScanFormat::kAuto ? other_format_.get() : nullptr;
  if (entry.is_far)
    return readMovedCloud(entry.file, entry.format, other, moved_->toNear(entry.given));
  return other ? readScanCloud(entry.file, *other)
               : readScanCloud(entry.file, entry.format);
}

ScanFormat
ScanFolder::format() const
{
  return entries_.front().format;
}

} // namespace pcl6d
