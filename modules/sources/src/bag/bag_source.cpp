// SPDX-License-Identifier: BSD-3-Clause
#include "bag/bag_drive.h"

#include <pcl6d/common/require.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/sources/bag_source.h>

namespace pcl6d {

using namespace sources;

struct BagSource::Content {
  std::shared_ptr<const Bag> bag;
  BagDrive drive;
  std::vector<SourceScan> scans;
  std::string note;
};

namespace {
constexpr double kNanosecondsPerSecond = 1e9;

std::vector<SourceScan>
scansOf(const BagDrive& drive)
{
  std::vector<SourceScan> scans;
  for (std::size_t i = 0; i < drive.clouds.size(); ++i) {
    const BagCloud& cloud = drive.clouds[i];
    SourceScan scan;
    scan.name = scanName(static_cast<int>(i));
    scan.pose = cloud.pose;
    if (drive.has_stamps)
      scan.stamp = static_cast<double>(cloud.time) / kNanosecondsPerSecond;
    scan.fields = cloud.head.fields;
    scan.num_points = cloud.head.num_points;
    scans.push_back(std::move(scan));
  }
  return scans;
}
} // namespace

BagSource::BagSource(const std::filesystem::path& path, const BagOptions& options)
{
  auto content = std::make_unique<Content>();
  content->bag = openBag(path);
  content->drive = readBagDrive(*content->bag, options);
  content->scans = scansOf(content->drive);
  content->note = topicTitle(content->bag->topics()[content->drive.topic]);
  for (const std::string& note : content->drive.notes)
    content->note += "; " + note;
  content_ = std::move(content);
}

BagSource::~BagSource() = default;

const std::filesystem::path&
BagSource::path() const
{
  return content_->bag->path();
}

std::string
BagSource::format() const
{
  return content_->bag->format();
}

const std::vector<SourceScan>&
BagSource::scans() const
{
  return content_->scans;
}

std::string
BagSource::titleOf(std::size_t i) const
{
  return path().string() + ": " + content_->scans.at(i).name + " (" +
         topicTitle(content_->bag->topics()[content_->drive.topic]) + ")";
}

std::string
BagSource::poseSource() const
{
  return content_->drive.pose_source;
}

std::string
BagSource::note() const
{
  return content_->note;
}

ScanCloud
BagSource::read(std::size_t i) const
{
  require(i < content_->scans.size(),
          "scan",
          i,
          "below " + std::to_string(content_->scans.size()));
  const BagTopic& topic = content_->bag->topics()[content_->drive.topic];
  const auto bytes = content_->bag->read(content_->drive.clouds[i].message);
  const std::string what = topicTitle(topic) + ": " + content_->scans[i].name;
  MessageReader reader(path(), what, topic.encoding, {bytes.data(), bytes.size()});
  return readCloudMessage(topic.type, reader);
}

} // namespace pcl6d
