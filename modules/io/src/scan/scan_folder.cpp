// SPDX-License-Identifier: BSD-3-Clause
#include "scan/found_scans.h"
#include "scan/initial_poses.h"
#include "scan/scan_formats.h"
#include "scan/table/table_columns.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/median.h>
#include <pcl6d/common/require.h>
#include <pcl6d/io/far_points.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/text.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

using namespace io;

namespace fs = std::filesystem;

void
ScanFolderOptions::validate() const
{
  require(first >= 0, "first", first, ">= 0");
  require(!last || *last >= first,
          "last",
          last.value_or(0),
          ">= first = " + std::to_string(first));
  require(every >= 1, "every", every, ">= 1");
  if (!columns.empty())
    tableColumns(columns);
}

ScanFolder::ScanFolder(const fs::path& folder, const ScanFolderOptions& options)
: other_format_(options.other_format)
{
  options.validate();
  reading_.columns = options.columns;
  reading_.bin_layout = options.bin_layout;
  FoundScans scans = findScans(folder, options);
  InitialPoses poses = findInitialPoses(scans, options.poses_file);
  takeLayout(scans, options, poses.trajectory.stamps);
  if (!poses.note.empty())
    note_ += (note_.empty() ? "" : "; ") + poses.note;
  pose_source_ = poses.source;
  std::vector<Entry> all(scans.files.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].file = scans.files[i];
    all[i].name = scans.files[i].filename().string();
    all[i].format = scans.format;
  }
  select(std::move(all), std::move(poses.trajectory), options);
}

/** \param[in] stamps [s] of all scans, or empty */
void
ScanFolder::takeLayout(const FoundScans& scans,
                       const ScanFolderOptions& options,
                       const std::vector<double>& stamps)
{
  if (!scans.entered.empty())
    note_ = "scans are those in " + scans.folders.front().string();
  layout_ = scans.layout;
  if (!layout_)
    return;
  note_ += (note_.empty() ? "" : "; ") + describe(*layout_);
  if (layout_->names_are_stamps && stamps.empty())
    note_ += "; the stamps in the names do not increase and are ignored";
  if (options.bin_layout == BinLayout::kAuto)
    reading_.bin_layout = layout_->bin_layout;
  std::vector<double> steps;
  for (std::size_t i = 1; i < stamps.size(); ++i)
    steps.push_back(stamps[i] - stamps[i - 1]);
  if (!steps.empty())
    reading_.times = {layout_->times, upperMedian(std::move(steps))};
}

ScanFolder::ScanFolder(const std::shared_ptr<const ScanSource>& source,
                       const ScanFolderOptions& options)
{
  options.validate();
  require(source != nullptr, "source", "none", "a source of scans");
  InitialPoses poses = initialPosesOf(*source, options.poses_file);
  pose_source_ = poses.source;
  if (options.poses_file.empty())
    note_ = source->note();
  std::vector<Entry> all(source->scans().size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].file = source->fileOf(i);
    all[i].name = source->scans()[i].name;
    all[i].source = source;
    all[i].number = i;
  }
  select(std::move(all), std::move(poses.trajectory), options);
}

/** Selects scans by the options. \param[in] trajectory of all scans */
void
ScanFolder::select(std::vector<Entry> all,
                   Trajectory trajectory,
                   const ScanFolderOptions& options)
{
  const std::size_t count = all.size();
  const auto first = static_cast<std::size_t>(options.first);
  if (first >= count)
    throw BadArgument("first = " + std::to_string(first) + ", but the folder holds " +
                      text::counted(count, "scan"));
  const std::size_t end =
      options.last ? std::min(count, static_cast<std::size_t>(*options.last) + 1)
                   : count;
  for (std::size_t i = first; i < end; i += static_cast<std::size_t>(options.every)) {
    all[i].index = static_cast<int>(i);
    all[i].given = all[i].pose = trajectory.poses[i];
    entries_.push_back(std::move(all[i]));
    if (!trajectory.stamps.empty())
      stamps_.push_back(trajectory.stamps[i]);
  }
  odometry_ = std::move(trajectory);
  if (!options.keep_coordinates)
    lookAtFirst();
}

void
ScanFolder::lookAtFirst()
{
  try {
    first_ = std::make_shared<ScanCloud>(readEntry(entries_.front()));
  } catch (const IoFailed&) {
    return; // reported on reading
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
  double poses = 0, points = 0; // spread [m]
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
    coordinates_ += "; the position of the scanner is not known: ranges and rays begin "
                    "in the middle of the points";
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

std::string
ScanFolder::title(std::size_t i) const
{
  const Entry& entry = entries_.at(i);
  return entry.source ? entry.source->titleOf(entry.number) : entry.file.string();
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

bool
ScanFolder::posesDiffer() const
{
  constexpr std::size_t kFew = 3; // two scans may be taken from one position
  if (!hasPoses() || are_estimated_ || entries_.size() < kFew)
    return hasPoses();
  return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.given.matrix() != entries_.front().given.matrix();
  });
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
  if (entry.source)
    return finiteMoved(entry.file,
                       entry.source->read(entry.number),
                       entry.is_far ? moved_->toNear(entry.given)
                                    : std::optional<Eigen::Isometry3d>());
  const OtherScanFormat* const other =
      entry.format == ScanFormat::kAuto ? other_format_.get() : nullptr;
  ScanReaderOptions reading = reading_;
  reading.format = entry.format;
  if (entry.is_far)
    return readMovedCloud(entry.file, reading, other, moved_->toNear(entry.given));
  return other ? readScanCloud(entry.file, *other) : readScanCloud(entry.file, reading);
}

ScanFormat
ScanFolder::format() const
{
  return entries_.front().format;
}

std::string
ScanFolder::formatName() const
{
  const Entry& first = entries_.front();
  if (first.source)
    return first.source->format();
  return first.format == ScanFormat::kAuto && other_format_ ? other_format_->name
                                                            : toString(first.format);
}

} // namespace pcl6d
