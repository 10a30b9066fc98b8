// SPDX-License-Identifier: BSD-3-Clause
#include "io_test.h"
#include "support/data_folder.h"

#include <pcl6d/io/scan_reader.h>

namespace fs = std::filesystem;
using namespace pcl6d;
using namespace pcl6d::test;

// Files by LASzip and laz-rs beside the same points as LAS.
TEST(LasData, CompressedTwinsHoldEqualPoints)
{
  PCL6D_DATA_OR_SKIP(folder, "formats");
  const std::pair<const char*, const char*> twins[] = {
      {"point10.las", "point10.laz"},
      {"point-time.las", "point-time.laz"},
      {"point-color.las", "point-color.laz"},
      {"basefile.las", "laszip-generated.laz"},
      {"1_4_w_evlr.las", "1_4_w_evlr.laz"}};
  for (const auto& [las, laz] : twins) {
    SCOPED_TRACE(laz);
    const Scan plain = readScan(folder / "las" / las);
    const Scan packed = readScan(folder / "las" / laz);
    EXPECT_GE(plain.points.size(), 1000U);
    EXPECT_EQ(plain.cloud.data, packed.cloud.data);
  }
}

TEST(LasData, FilesOfAllAgesAreReadOrRefusedInWords)
{
  PCL6D_DATA_OR_SKIP(data, "formats");
  const fs::path folder = data / "las";
  const std::pair<const char*, std::size_t> readable[] = {{"1.0_0.las", 1},
                                                          {"1.1_1.las", 1},
                                                          {"1.2_3.las", 1},
                                                          {"bad_vlr_count.las", 10},
                                                          {"gps-time-nan.las", 1}};
  for (const auto& [name, count] : readable)
    EXPECT_EQ(readScan(folder / name).points.size(), count) << name;
  expectIoFailed(folder / "garbage_nVariableLength.las",
                 "is truncated: it holds 718 of 719 points",
                 [&] { readScan(folder / "garbage_nVariableLength.las"); });
}
