// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "registered_run.h"

namespace pcl6d::test {

/** \return the same run in another unit */
inline DriftingRun
scaled(const DriftingRun& run, double scale)
{
  DriftingRun other = run;
  for (auto& scan : other.scans)
    for (auto& p : scan)
      p *= static_cast<float>(scale);
  for (auto* poses : {&other.truth, &other.odometry})
    for (auto& pose : *poses)
      pose.translation() *= scale;
  return other;
}

/** \return the same lengths in another unit; the range gate, which is of the scanner and not of
 * the scene, is given */
inline Slam6DOptions
optionsAt(Slam6DOptions options, double scale)
{
  options.min_range = 0.2 * scale;
  if (options.max_range)
    *options.max_range *= scale;
  if (options.max_distance)
    *options.max_distance *= scale;
  if (options.voxel)
    *options.voxel *= scale;
  return options;
}

/** \brief Expects the same stages, states and, scaled back, poses.
 * \param[in] tolerance of the poses [m], [rad] */
inline void
expectSameDecisions(const Slam6DResult& a,
                    const Slam6DResult& b,
                    double scale,
                    double tolerance = 1e-6)
{
  ASSERT_EQ(a.stages.size(), b.stages.size());
  for (std::size_t k = 0; k < a.stages.size(); ++k) {
    EXPECT_EQ(a.stages[k].kind, b.stages[k].kind);
    EXPECT_EQ(a.stages[k].reverted, b.stages[k].reverted) << b.stages[k].rejection;
    EXPECT_NEAR(a.stages[k].agreement_after, b.stages[k].agreement_after, 1e-3);
  }
  for (std::size_t i = 0; i < a.scans.size(); ++i) {
    EXPECT_EQ(a.scans[i].state, b.scans[i].state) << i;
    const Eigen::Isometry3d &T = a.scans[i].T_world_scan, &U = b.scans[i].T_world_scan;
    EXPECT_LT((T.translation() - U.translation() / scale).norm(), tolerance) << i;
    EXPECT_LT((T.linear() - U.linear()).norm(), tolerance) << i;
  }
}

} // namespace pcl6d::test
