// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d on recorded scans: the figures that the suite promises.
#include "support/data_folder.h"
#include "support/run_program.h"

#include <pcl6d/benchmarking/trajectory_error.h>
#include <pcl6d/io/trajectory_io.h>

#include <gtest/gtest.h>

namespace {
namespace fs = std::filesystem;
using pcl6d::test::TempFolder;
} // namespace

TEST(PclSlam6dData, KeepsTheCampusLoopWithinAFewCentimetres)
{
  PCL6D_DATA_OR_SKIP(data, "hku1");
  const TempFolder folder;
  const fs::path out = folder / "out";
  const auto outcome = pcl6d::test::runProgram(
      "pcl_slam6d",
      {data.string(), "-o", out.string(), "--metascan", "all", "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto estimate = pcl6d::readTrajectory(out / "trajectory.kitti");
  const auto reference = pcl6d::readTrajectory(data / "groundtruth.txt");
  ASSERT_EQ(estimate.poses.size(), reference.poses.size());
  double sum = 0;
  for (std::size_t i = 0; i < estimate.poses.size(); ++i)
    sum += (estimate.poses[i].translation() - reference.poses[i].translation())
               .squaredNorm();
  const double rms = std::sqrt(sum / static_cast<double>(estimate.poses.size()));
  // Measured 0.032; the reference itself is good to a few centimetres.
  EXPECT_LT(rms, 0.06);
}

TEST(PclSlam6dData, AlignsTheCorridorOfKurt3dWithDefaults)
{
  PCL6D_DATA_OR_SKIP(data, "kurt3d");
  const fs::path tool = data.parent_path().parent_path() / "tools/kurt3d_agreement.py";
  if (!fs::exists(tool) || !fs::exists("/usr/bin/python3"))
    GTEST_SKIP() << tool << " or python3 not found";
  if (boost::process::system("/usr/bin/python3 -c 'import numpy, scipy'",
                             boost::process::std_err > boost::process::null) != 0)
    GTEST_SKIP() << "python3 has no numpy or scipy";
  const TempFolder folder;
  const fs::path out = folder / "out";
  const auto outcome = pcl6d::test::runProgram(
      "pcl_slam6d", {data.string(), "-o", out.string(), "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  // Shares of points within 3 cm; measured 0.567 and 0.534, the odometry has 0.51 and 0.47.
  const int verdict = boost::process::system(
      "/usr/bin/python3",
      boost::process::args = {tool.string(),
                              data.string(),
                              (out / "trajectory.kitti").string(),
                              "0.54",
                              "0.51"});
  EXPECT_EQ(verdict, 0);
}
