// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_evaluate icp on recorded scans.
#include "apps/evaluate/csv_rows.h"
#include "support/data_folder.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

using pcl6d::test::CsvRow;
using pcl6d::test::readCsv;
using pcl6d::test::TempFolder;
using pcl6d::test::without;

TEST(EvaluateIcpData, MeasuresTheRecordedCorridor)
{
  PCL6D_DATA_OR_SKIP(data, "kurt3d");
  const TempFolder folder;
  const auto outcome = pcl6d::test::runProgram("pcl_slam6d_evaluate",
                                               {"icp",
                                                data / "scan000.3d",
                                                data / "scan001.3d",
                                                "--steps-xy=3",
                                                "--steps-yaw=1",
                                                "--offset-xy=0.2",
                                                "--voxel=0.1",
                                                "--search=remembered",
                                                "--search=kdtree",
                                                "-o",
                                                folder / "out"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("scan poses (*.pose)"), std::string::npos) << outcome.out;
  const auto rows = readCsv(folder / "out/icp.csv");
  ASSERT_EQ(rows.size(), 9u);
  for (const CsvRow& row : rows)
    EXPECT_GT(std::stod(row.at("success")), 0.99)
        << row.at("metric") << ' ' << row.at("minimiser");
  EXPECT_EQ(without({rows[0], rows[1]}, {"search", "seconds"}).size(), 1u);
}

TEST(EvaluateIcpData, DoubtsWhatPointsFindWithoutPoses)
{
  PCL6D_DATA_OR_SKIP(data, "rooms");
  const auto outcome = pcl6d::test::runProgram("pcl_slam6d_evaluate",
                                               {"icp",
                                                data / "room_scan1.pcd",
                                                data / "room_scan2.pcd",
                                                "--quiet",
                                                "--voxel=0.2",
                                                "--steps-xy=1",
                                                "--steps-yaw=1"});
  // The identity is 2 m off: points come to rest 1.4 m from where planes do, in a pose
  // that ICP leaves when it starts there with the wide search of its first iterations.
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  for (const char* const word : {"metric point: ",
                                 "ICP started in the pose found leaves it by",
                                 "no poses were found"})
    EXPECT_NE(outcome.err.find(word), std::string::npos) << word << outcome.err;
  EXPECT_EQ(outcome.out.find("\npoint "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\nplane "), std::string::npos) << outcome.out;
}
