// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/input/shared_reading.h"

#include <pcl6d/common/error.h>

#include <algorithm>
#include <future>
#include <utility>
#include <vector>

namespace pcl {

// For transfer to other processes; in the namespace of the types.

template <typename Archive>
void
packFields(Archive& archive, PCLPointField& field)
{
  archive(field.name, field.offset, field.datatype, field.count);
}

template <typename Archive>
void
packFields(Archive& archive, PCLPointCloud2& cloud)
{
  archive(cloud.header.seq, cloud.header.stamp, cloud.header.frame_id);
  archive(cloud.height, cloud.width, cloud.fields, cloud.is_bigendian);
  archive(cloud.point_step, cloud.row_step, cloud.data, cloud.is_dense);
}
} // namespace pcl

namespace pcl6d {

template <typename Archive>
void
packFields(Archive& archive, Scan& scan)
{
  archive(scan.cloud, scan.dropped, scan.points);
}
} // namespace pcl6d

namespace pcl6d::app {

namespace {
/** Number of scans read by each process before all continue with the next scans. */
constexpr std::size_t kReadAtATime = 4;
} // namespace

Scan
SharedReading::read(std::size_t i)
{
  Scan scan = scans_.read(i);
  if (scan.points.size() < 3)
    throw IoFailed(scans_.folder().title(i) + ": " +
                   std::to_string(scan.points.size()) +
                   " points with finite coordinates (" + std::to_string(scan.dropped) +
                   " without), but at least 3 are needed");
  return scan;
}

bool
SharedReading::readAll(const Take& take)
{
  return ranks_ ? readTogether(take) : readAhead(take);
}

/** Reads the next scan while the present scan is prepared; without threads, afterwards. */
bool
SharedReading::readAhead(const Take& take)
{
  const std::size_t size = scans_.folder().size();
  const auto start = [this](std::size_t i) {
    return std::async(std::launch::async | std::launch::deferred,
                      [this, i] { return read(i); });
  };
  std::future<Scan> next = start(0);
  for (std::size_t i = 0; i < size; ++i) {
    Scan scan = next.get();
    if (i + 1 < size)
      next = start(i + 1);
    if (!take(i, std::move(scan)))
      return false;
  }
  return true;
}

bool
SharedReading::readTogether(const Take& take)
{
  const std::size_t size = scans_.folder().size();
  const std::size_t at_a_time = kReadAtATime * ranks_->numRanks();
  for (std::size_t begin = 0; begin < size; begin += at_a_time) {
    std::vector<Scan> scans(std::min(at_a_time, size - begin));
    WorkSharing::Loop loop;
    loop.count = scans.size();
    loop.owner = [&](std::size_t k) { return ranks_->ownerOf(begin + k); };
    loop.compute = [&](std::size_t k) { scans[k] = read(begin + k); };
    loop.give = [&](std::size_t k, Packer& packer) { packer(scans[k]); };
    loop.take = [&](std::size_t k, Unpacker& unpacker) { unpacker(scans[k]); };
    loop.receivers = WorkSharing::Receivers::kFirst;
    ranks_->run(loop, 1);
    for (std::size_t k = 0; k < scans.size(); ++k)
      if (!take(begin + k, std::move(scans[k])))
        return false;
  }
  return true;
}

std::size_t
SharedReading::add(std::size_t i, const Scan& scan, Slam6D& slam) const
{
  const ScanFolder& folder = scans_.folder();
  if (i >= folder.numRegistered() && scans_.estimatesMotion()) {
    slam.addScan(
        scan.points, scans_.scanTimes(scan, i), folder.initialPose(i), folder.title(i));
    return scan.dropped;
  }
  if (i >= folder.numRegistered()) {
    slam.addScan(scan.points,
                 folder.initialPose(i),
                 folder.title(i),
                 scans_.takeDriveContext(i));
    return scan.dropped;
  }
  const ScanResult earlier = earlier_.resultOf(i); // files of runs are called alike
  slam.addRegistered(scan.points, earlier, folder.name(i), earlier_.scans[i].run);
  return earlier.dropped;
}

} // namespace pcl6d::app
