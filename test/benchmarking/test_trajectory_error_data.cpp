// SPDX-License-Identifier: BSD-3-Clause
#include "support/data_folder.h"

#include <pcl6d/benchmarking/trajectory_error.h>
#include <pcl6d/io/trajectory_io.h>

TEST(EvaluateTrajectory, GivesTheKnownErrorOfTheHku1Odometry)
{
  PCL6D_DATA_OR_SKIP(folder, "hku1");
  const auto evaluation =
      pcl6d::evaluateTrajectory(pcl6d::readTrajectory(folder / "odometry.txt"),
                                pcl6d::readTrajectory(folder / "groundtruth.txt"));
  EXPECT_EQ(evaluation.without_alignment.position.count, 62u);
  // The data's README: 2.54 m over a loop of 64 m; half a unit of the last digit.
  EXPECT_NEAR(evaluation.without_alignment.position.rms, 2.54, 0.005);
  // The chords between the scans are shorter than the path of 64 m that was walked.
  EXPECT_LT(evaluation.path_length, 64);
  EXPECT_GT(evaluation.path_length, 0.9 * 64);
  EXPECT_EQ(evaluation.alignment.status, pcl6d::Status::kOk);
  EXPECT_LT(evaluation.with_alignment.position.rms, 2.54);
}
