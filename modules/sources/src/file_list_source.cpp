// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/text.h>
#include <pcl6d/sources/bag.h>
#include <pcl6d/sources/file_list_source.h>
#include <pcl6d/sources/open_source.h>

#include <algorithm>
#include <set>

namespace pcl6d {

namespace {
namespace fs = std::filesystem;

bool
isNoMotion(const std::optional<Eigen::Isometry3d>& pose)
{
  return !pose || pose->matrix() == Eigen::Matrix4d::Identity();
}
} // namespace

FileListSource::FileListSource(const std::vector<fs::path>& files,
                               const ScanReaderOptions& reading,
                               const BagOptions& bag)
: reading_(reading), bag_(bag)
{
  require(!files.empty(), "files", "none", "at least one");
  for (const auto& file : files)
    add(file);
  decidePoses();
  makeNamesUnique();
  if (!std::all_of(scans_.begin(), scans_.end(), [](const SourceScan& scan) {
        return scan.stamp.has_value();
      }))
    for (auto& scan : scans_)
      scan.stamp.reset();
}

/** Appends the scans of a file. */
void
FileListSource::add(const fs::path& file)
{
  std::error_code missing;
  const bool is_folder = fs::is_directory(file, missing);
  if (is_folder && !isBag(file))
    text::fail(file, "is a folder, but several inputs are given: each must be a file");
  if (!is_folder)
    text::open(file); // reports why the file cannot be read
  if (isSourceFile(file)) {
    const auto source = openSource(file, bag_);
    for (std::size_t i = 0; i < source->scans().size(); ++i) {
      places_.push_back({file, source, i, source->format()});
      scans_.push_back(source->scans()[i]);
    }
    return;
  }
  const ScanFormat format = reading_.format == ScanFormat::kAuto
                                ? scanFormatOfExtension(file)
                                : reading_.format;
  if (format == ScanFormat::kAuto)
    text::fail(file,
               "unknown format of scans " + text::quoted(file.extension().string()));
  SourceScan scan;
  scan.name = file.filename().string();
  scan.pose = findScanPose(file, format);
  places_.push_back({file, {}, 0, toString(format)});
  scans_.push_back(std::move(scan));
}

/** Keeps the poses if all scans have a pose. */
void
FileListSource::decidePoses()
{
  std::set<std::string> with_poses; // formats
  for (std::size_t i = 0; i < scans_.size(); ++i)
    if (!isNoMotion(scans_[i].pose))
      with_poses.insert(places_[i].format);
  const std::set<std::string> always = {"pcd", "ptx", "e57"}; // hold a pose in any case
  std::size_t first_without = scans_.size(), first_with = scans_.size();
  for (std::size_t i = scans_.size(); i-- > 0;) {
    auto& pose = scans_[i].pose;
    if (with_poses.count(places_[i].format) == 0)
      pose.reset();
    else if (!pose && always.count(places_[i].format) > 0)
      pose = Eigen::Isometry3d::Identity();
    (pose ? first_with : first_without) = i;
  }
  if (first_without == scans_.size())
    return;
  if (first_with < scans_.size())
    note_ = "poses of the files are not used: " + scans_[first_with].name +
            " has one, but " + scans_[first_without].name +
            " has no pose; --poses FILE gives a pose for each scan";
  for (auto& scan : scans_)
    scan.pose.reset();
}

void
FileListSource::makeNamesUnique()
{
  std::set<std::string> known;
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    std::string& name = scans_[i].name;
    while (!known.insert(name).second)
      name += " (" + std::to_string(i) + ")";
  }
}

const fs::path&
FileListSource::path() const
{
  return places_.front().file;
}

std::string
FileListSource::format() const
{
  std::string formats;
  std::set<std::string> known;
  for (const auto& place : places_)
    if (known.insert(place.format).second)
      formats += (formats.empty() ? "" : ", ") + place.format;
  return formats;
}

const fs::path&
FileListSource::fileOf(std::size_t i) const
{
  return places_.at(i).file;
}

std::string
FileListSource::titleOf(std::size_t i) const
{
  const Place& place = places_.at(i);
  return place.source ? place.source->titleOf(place.number) : place.file.string();
}

std::string
FileListSource::poseSource() const
{
  return "the files";
}

ScanCloud
FileListSource::read(std::size_t i) const
{
  require(i < places_.size(), "scan", i, "below " + std::to_string(places_.size()));
  const Place& place = places_[i];
  return place.source ? place.source->read(place.number)
                      : readScanCloud(place.file, reading_);
}

} // namespace pcl6d
