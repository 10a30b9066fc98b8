// SPDX-License-Identifier: BSD-3-Clause
// Time stamps in the names of scan files, and as dates in a file.
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/trajectory_io.h>

#include <gtest/gtest.h>

using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

TEST(NameStamps, AreReadOfAllKindsOrNotAtAll)
{
  using pcl6d::stampsOfNames;
  EXPECT_EQ(stampsOfNames({"a_1500000000_5.pcd", "a_1500000000_500000000.pcd"}),
            (std::vector<double>{1500000000 + 5e-9, 1500000000.5}));
  EXPECT_EQ(stampsOfNames({"1500000000.25.pcd", "1500000000.5.pcd"}),
            (std::vector<double>{1500000000.25, 1500000000.5}));
  EXPECT_EQ(stampsOfNames({"x_1500000000500000.ply"}),
            (std::vector<double>{1500000000.5}));
  EXPECT_EQ(stampsOfNames({"1500000000250000000.bin", "1500000000500000000.bin"}),
            (std::vector<double>{1500000000.25, 1500000000.5}));
  EXPECT_TRUE(stampsOfNames({"1500000000500000.bin", "scan001.bin"}).empty());
  EXPECT_TRUE(stampsOfNames({"1500000000500000.bin", "1500000000500000.bin"}).empty());
  for (const char* const name : {"scan001.pcd",
                                 "0000000001.bin",
                                 "0500000000500000.bin",
                                 "1500000000.pcd",
                                 "1500000000_.pcd",
                                 "1500000000_1234567890.pcd",
                                 "150000000_5.pcd",
                                 "20240312_101500.pcd",
                                 ".pcd"})
    EXPECT_TRUE(stampsOfNames({name}).empty()) << name;
}

TEST(DateStamps, AreSecondsSince1970)
{
  const TempFolder folder;
  const auto read = [&](const std::string& text) {
    writeText(folder / "timestamps.txt", text);
    return pcl6d::readStamps(folder / "timestamps.txt");
  };
  // date -u -d "..." +%s
  EXPECT_EQ(read("1970-01-01 00:00:00\n2000-02-29 23:59:59.25\n2000-03-01 00:00:00\n"),
            (std::vector<double>{0, 951868799.25, 951868800}));
  EXPECT_EQ(read("2013-05-28 08:46:02.900000000\r\n"),
            (std::vector<double>{1369730762.9}));
  for (const char* const line : {"2011-02-29 00:00:00",
                                 "2011-13-01 00:00:00",
                                 "2011-09-26 24:00:00",
                                 "2011-09-26 13:02",
                                 "2011-09-26",
                                 "2011-09-26 13:02:25.9e3",
                                 "2011-09-26 13:02:25 7"})
    EXPECT_THROW(read(line), pcl6d::IoFailed) << line;
}
