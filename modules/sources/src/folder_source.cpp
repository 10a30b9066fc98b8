// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/sources/folder_source.h>

namespace pcl6d {

namespace {
ScanFolderOptions
allAsTheyAre()
{
  ScanFolderOptions options;
  options.keep_coordinates = true;
  return options;
}
} // namespace

FolderSource::FolderSource(const std::filesystem::path& path)
: path_(path), folder_(path, allAsTheyAre())
{
  for (std::size_t i = 0; i < folder_.size(); ++i) {
    SourceScan scan;
    scan.name = folder_.name(i);
    if (folder_.hasPoses())
      scan.pose = folder_.initialPose(i);
    if (!folder_.stamps().empty())
      scan.stamp = folder_.stamps()[i];
    scans_.push_back(std::move(scan));
  }
}

std::string
FolderSource::format() const
{
  return folder_.formatName();
}

ScanCloud
FolderSource::read(std::size_t i) const
{
  require(i < scans_.size(), "scan", i, "below " + std::to_string(scans_.size()));
  return folder_.readCloud(i);
}

} // namespace pcl6d
