// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/bits.h"
#include "support/drift.h"

#include <pcl6d/slam6d/slam6d.h>

#include <gtest/gtest.h>

namespace pcl6d::test {

/** \return what Slam6D makes of a run */
inline Slam6DResult
registered(const DriftingRun& run, const Slam6DOptions& options = {})
{
  Slam6D slam(options);
  for (std::size_t i = 0; i < run.scans.size(); ++i)
    slam.addScan(run.scans[i], run.odometry[i]);
  EXPECT_TRUE(slam.optimize());
  return slam.result();
}

/** \return what tracking tells of a scan, without a submap */
inline DriveContext
measuredStep(bool is_measured)
{
  DriveContext drive;
  drive.is_step_measured = is_measured;
  return drive;
}

/** \brief Expects the same scans to the last bit. */
inline void
expectSameBits(const Slam6DResult& a, const Slam6DResult& b)
{
  ASSERT_EQ(a.scans.size(), b.scans.size());
  for (std::size_t i = 0; i < a.scans.size(); ++i) {
    EXPECT_TRUE(sameBits(a.scans[i].T_world_scan, b.scans[i].T_world_scan));
    EXPECT_EQ(a.scans[i].rms, b.scans[i].rms);
    EXPECT_EQ(a.scans[i].pairs, b.scans[i].pairs);
    EXPECT_EQ(a.scans[i].state, b.scans[i].state);
  }
}

} // namespace pcl6d::test
