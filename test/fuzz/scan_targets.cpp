// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/fuzz_target.h"
#include "fuzz/targets.h"

#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/ptx_io.h>
#include <pcl6d/io/scan_reader.h>

#include <cmath>

namespace pcl6d::fuzz {

namespace {
/** Reads a scan in a format and looks whether what is promised of it holds. */
int
readScanOf(ScanFormat format, const std::uint8_t* data, std::size_t size)
{
  return readAsFile(extensionOf(format).c_str(), data, size, [&](const auto& file) {
    const Scan scan = readScan(file, format);
    const auto& cloud = scan.cloud;
    const std::size_t count = std::size_t(cloud.width) * cloud.height;
    expect(scan.points.size() == count, "as many points as the cloud has");
    expect(cloud.data.size() == count * cloud.point_step, "the cloud has its bytes");
    expect(scan.places.empty() || scan.places.size() == count, "a place per point");
    for (std::size_t i = 0; i < count; ++i)
      expect(scan.points[i].allFinite(), "points are finite");
    const NearScan near = readNearScan(file, format);
    expect(near.points.size() <= count, "no more points than were read");
    expect(near.description.empty() == near.offset.isZero(0), "a move is told");
    for (const auto& p : near.points)
      expect(p.allFinite(), "near points are finite");
  });
}
} // namespace

int
pcd(const std::uint8_t* data, std::size_t size)
{
  readAsFile(".pcd", data, size, [](const auto& file) {
    expect(readPcdViewpoint(file).matrix().allFinite(), "a viewpoint is finite");
  });
  return readScanOf(ScanFormat::kPcd, data, size);
}

int
ply_scan(const std::uint8_t* data, std::size_t size)
{
  return readScanOf(ScanFormat::kPly, data, size);
}

int
uos(const std::uint8_t* data, std::size_t size)
{
  return readScanOf(ScanFormat::kUos, data, size);
}

int
uosr(const std::uint8_t* data, std::size_t size)
{
  return readScanOf(ScanFormat::kUosr, data, size);
}

int
kitti(const std::uint8_t* data, std::size_t size)
{
  return readScanOf(ScanFormat::kKitti, data, size);
}

int
bin(const std::uint8_t* data, std::size_t size)
{
  // The first byte names the layout, so that each is met.
  if (size == 0)
    return 0;
  return readAsFile(".bin", data + 1, size - 1, [&](const auto& file) {
    ScanReaderOptions options;
    options.bin_layout = static_cast<BinLayout>(data[0] % 11);
    const ScanCloud scan = readScanCloud(file, options);
    expect(scan.cloud.data.size() ==
               std::size_t{scan.cloud.width} * scan.cloud.point_step,
           "the cloud has its bytes");
  });
}

int
csv(const std::uint8_t* data, std::size_t size)
{
  readAsFile(".csv", data, size, [](const auto& file) {
    ScanReaderOptions options;
    options.columns = {"z", "", "x", "y", "r", "g", "b", "time", "ring"};
    readScanCloud(file, options);
  });
  return readScanOf(ScanFormat::kCsv, data, size);
}

int
pts(const std::uint8_t* data, std::size_t size)
{
  return readScanOf(ScanFormat::kPts, data, size);
}

int
ptx(const std::uint8_t* data, std::size_t size)
{
  readAsFile(".ptx", data, size, [](const auto& file) {
    for (const auto& scan : listPtxScans(file)) {
      expect(scan.T_world_scan.matrix().allFinite(), "a pose is finite");
      const auto cloud = readPtxScan(file, scan).cloud;
      expect(cloud.data.size() ==
                 std::size_t{scan.columns} * scan.rows * cloud.point_step,
             "a point for each cell");
    }
  });
  return readScanOf(ScanFormat::kPtx, data, size);
}

int
las(const std::uint8_t* data, std::size_t size)
{
  return readScanOf(ScanFormat::kLas, data, size);
}

int
xyz(const std::uint8_t* data, std::size_t size)
{
  return readScanOf(ScanFormat::kXyz, data, size);
}

} // namespace pcl6d::fuzz
