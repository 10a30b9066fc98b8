// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_evaluate icp on recorded scans.
#include "csv_rows.h"
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
                                                "--quiet",
                                                "--steps-xy=3",
                                                "--steps-yaw=1",
                                                "--offset-xy=0.2",
                                                "--voxel=0.1",
                                                "--search=cached",
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
