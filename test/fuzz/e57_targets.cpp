// SPDX-License-Identifier: BSD-3-Clause
#include "e57/crc32c.h"
#include "fuzz/fuzz_target.h"
#include "fuzz/targets.h"

#include <pcl6d/io/scan_folder.h>
#include <pcl6d/sources/e57_poses.h>
#include <pcl6d/sources/e57_source.h>

#include <algorithm>
#include <memory>
#include <set>
#include <vector>

namespace pcl6d::fuzz {

namespace {
constexpr std::size_t kPage = 1024, kContent = 1020; // bytes

/** \return the bytes as whole pages with right checksums and the right length in the header:
 * what is wrong with them is wrong behind these gates */
std::vector<std::uint8_t>
sealed(const std::uint8_t* data, std::size_t size)
{
  std::vector<std::uint8_t> bytes(data, data + size);
  bytes.resize(std::max<std::size_t>((size + kPage - 1) / kPage, 1) * kPage);
  for (std::size_t i = 0; i < 8; ++i)
    bytes[16 + i] = static_cast<std::uint8_t>(bytes.size() >> (8 * i));
  for (std::size_t page = 0; page < bytes.size(); page += kPage) {
    const std::uint32_t crc = sources::crc32c(&bytes[page], kContent);
    for (std::size_t i = 0; i < 4; ++i)
      bytes[page + kContent + i] = static_cast<std::uint8_t>(crc >> (24 - 8 * i));
  }
  return bytes;
}

void
readWhole(const std::filesystem::path& file)
{
  const auto source = std::make_shared<E57Source>(file);
  std::set<std::string> names;
  for (const auto& scan : source->scans()) {
    expect(names.insert(scan.name).second, "names are distinct");
    expect(!scan.pose || scan.pose->matrix().allFinite(), "a pose is finite");
  }
  writeE57Poses(file,
                file.string() + ".out",
                std::vector<std::optional<Eigen::Isometry3d>>(
                    names.size(), Eigen::Isometry3d::Identity()));
  const E57Source moved(file.string() + ".out");
  std::filesystem::remove(file.string() + ".out");
  expect(moved.scans().size() == names.size(), "as many scans as before");
  for (const auto& scan : moved.scans())
    expect(scan.pose->matrix() == Eigen::Matrix4d::Identity(), "poses are as written");
  const ScanFolder folder(source);
  for (std::size_t i = 0; i < folder.size(); ++i) {
    const Scan scan = folder.read(i);
    const std::size_t count = std::size_t{scan.cloud.width} * scan.cloud.height;
    expect(scan.points.size() == count, "as many points as the cloud has");
    expect(scan.cloud.data.size() == count * scan.cloud.point_step, "it has its bytes");
    for (const auto& p : scan.points)
      expect(p.allFinite(), "points are finite");
  }
}
} // namespace

int
e57(const std::uint8_t* data, std::size_t size)
{
  const std::vector<std::uint8_t> bytes = sealed(data, size);
  readAsFile(".e57", data, size, readWhole); // mostly refused for its checksums
  return readAsFile(".e57", bytes.data(), bytes.size(), readWhole);
}

} // namespace pcl6d::fuzz
