// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/bits.h"
#include "support/poses.h"

#include <pcl6d/graph_relaxation/error_diffusion.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::test {

inline constexpr LoopClosing kMethods[] = {LoopClosing::kElch,
                                           LoopClosing::kUniform,
                                           LoopClosing::kPath};

/** A round of scans with a branch, and its last pose after the match. */
struct Round {
  explicit Round(std::size_t n = 12)
  {
    Random random(5);
    for (std::size_t i = 0; i < n; ++i) {
      const double turn = 2 * M_PI * i / n;
      poses.push_back(poseFromEuler(
          {6 * std::cos(turn) + random.uniform(), 6 * std::sin(turn), random.uniform()},
          {0.2 * random.uniform(), 0.3 * random.uniform(), turn + 1.5}));
      if (i > 0)
        addEdge(random, i - 1, i);
    }
    addEdge(random, 2, 7);
    poses.push_back(randomPose(random, 5, 1)); // a branch
    addEdge(random, 4, n);
    loop.last = n - 1;
    loop.corrected_last =
        poses[n - 1] * poseFromEuler({0.5, -0.3, 0.2}, {0.1, -0.05, 0.3});
  }

  void
  addEdge(Random& random, std::size_t a, std::size_t b)
  {
    edges.push_back({a, b, PerDimension::Zero()});
    for (double& cost : edges.back().cost)
      cost = random.uniform(0.5, 2);
  }

  ErrorDiffusionResult
  closed(LoopClosing method, bool per_axis = false) const
  {
    return closeLoop(poses, edges, loop, {method, per_axis});
  }

  std::vector<Eigen::Isometry3d> poses;
  std::vector<LoopEdge> edges;
  Loop loop;
};

inline double
largestDistance(const std::vector<Eigen::Isometry3d>& a,
                const std::vector<Eigen::Isometry3d>& b)
{
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const MotionSize error = distanceBetween(a[i], b[i]);
    largest = std::max({largest, error.translation, error.rotation});
  }
  return largest;
}

inline void
expectSameBits(const std::vector<Eigen::Isometry3d>& found,
               const std::vector<Eigen::Isometry3d>& expected)
{
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_TRUE(sameBits(found[i], expected[i])) << "pose " << i;
}

} // namespace pcl6d::test
