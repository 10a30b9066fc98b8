// SPDX-License-Identifier: BSD-3-Clause
#include "scan_samples.h"

#include <array>
#include <thread>

using pcl6d::readScanCloud;
using pcl6d::writeScan;
using pcl6d::test::kWays;
using pcl6d::test::randomCloud;
using pcl6d::test::TempFolder;
using pcl6d::test::valueOf;
using pcl6d::test::Way;

namespace {
/** Writes and reads back; the name has blanks and umlauts. */
pcl6d::ScanCloud
throughFile(const TempFolder& folder, const pcl::PCLPointCloud2& cloud, const Way& way)
{
  const auto path = folder / "Flur Süd äß 1.scan";
  writeScan(path, cloud, Eigen::Isometry3d::Identity(), {way.format, way.encoding});
  return readScanCloud(path, way.format);
}

/** Expects the finite points of `cloud`, the same to the last bit. */
void
expectFinitePoints(const pcl::PCLPointCloud2& cloud,
                   const pcl::PCLPointCloud2& read,
                   bool with_intensity)
{
  const auto bits = [](const pcl::PCLPointCloud2& c, std::size_t i, const char* name) {
    return valueOf<std::uint32_t>(c, i, name);
  };
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cloud.width; ++i) {
    if (!std::isfinite(valueOf<float>(cloud, i, "x")) ||
        !std::isfinite(valueOf<float>(cloud, i, "y")) ||
        !std::isfinite(valueOf<float>(cloud, i, "z")))
      continue;
    ASSERT_LT(kept, read.width);
    for (const char* const name : {"x", "y", "z"})
      ASSERT_EQ(bits(cloud, i, name), bits(read, kept, name)) << name << " of " << i;
    if (with_intensity) {
      ASSERT_EQ(bits(cloud, i, "intensity"), bits(read, kept, "intensity")) << i;
    }
    ++kept;
  }
  EXPECT_EQ(kept, read.width);
}
} // namespace

TEST(ScanRoundTrip, EveryPairOfFormatsKeepsEveryBit)
{
  const TempFolder folder;
  for (const std::size_t count : {0, 1, 2, 5000})
    for (const bool with_nan : {false, true}) {
      const auto cloud = randomCloud(count, with_nan);
      for (const Way& first : kWays) {
        const auto read = throughFile(folder, cloud, first);
        const auto nans = static_cast<std::size_t>(with_nan ? (count + 3) / 7 : 0);
        EXPECT_EQ(read.dropped, nans) << first.name;
        EXPECT_TRUE(read.left_out.empty()) << first.name;
        for (const Way& second : kWays) {
          SCOPED_TRACE(first.name + " to " + second.name + ", " +
                       std::to_string(count) + " points");
          const auto again = throughFile(folder, read.cloud, second);
          EXPECT_EQ(again.dropped, 0u);
          expectFinitePoints(
              cloud, again.cloud, first.has_intensity && second.has_intensity);
        }
      }
    }
}

TEST(ScanRoundTrip, PipesAreReadLikeFiles)
{
  const TempFolder folder;
  const auto cloud = randomCloud(30000, false); // more than a pipe holds at once
  const auto file = folder / "file";
  for (const Way& way : kWays) {
    SCOPED_TRACE(way.name);
    writeScan(file, cloud, Eigen::Isometry3d::Identity(), {way.format, way.encoding});
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe(ends.data()), 0);
    std::thread writer([&] {
      const std::string content = pcl6d::test::readText(file);
      for (std::size_t done = 0; done < content.size();) {
        const auto count =
            ::write(ends[1], content.data() + done, content.size() - done);
        if (count <= 0)
          break;
        done += static_cast<std::size_t>(count);
      }
      ::close(ends[1]);
    });
    // As a shell hands over `<(...)`.
    const auto read = readScanCloud("/dev/fd/" + std::to_string(ends[0]), way.format);
    ::close(ends[0]);
    writer.join();
    EXPECT_EQ(read.cloud.data, readScanCloud(file, way.format).cloud.data);
    EXPECT_EQ(read.cloud.width, cloud.width);
  }
}
