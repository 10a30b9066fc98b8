// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/bits.h"
#include "support/constants.h"
#include "support/points.h"
#include "support/room.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/registration/icp.h>
#include <pcl6d/registration/icp_model.h>
#include <pcl6d/registration/icp_options.h>
#include <pcl6d/search/point_list.h>

#include <gtest/gtest.h>

#include <vector>

namespace pcl6d::test {

/** \brief Points with the normals of the surfaces that they were drawn from. */
struct Surface {
  Points points;
  Normals normals;

  void
  add(const Eigen::Vector3d& point, const Eigen::Vector3d& normal)
  {
    points.push_back(point.cast<float>());
    normals.push_back(normal.cast<float>());
  }
  void
  add(const Surface& other)
  {
    points.insert(points.end(), other.points.begin(), other.points.end());
    normals.insert(normals.end(), other.normals.begin(), other.normals.end());
  }
  Surface
  moved(const Eigen::Isometry3d& T) const
  {
    Surface result{transformed(points, T), {}};
    for (const auto& n : normals)
      result.normals.push_back((T.linear() * n.cast<double>()).cast<float>());
    return result;
  }
  IcpModel
  model(SearchMethod search = SearchMethod::kRemembered) const
  {
    IcpModel::Options options;
    options.search = search;
    return {points, normals, options};
  }
};

/** \return points of a rectangle between two corners, at the height of the low one along
 * one axis, with noise across it */
inline Surface
rectangle(Random& random,
          std::size_t count,
          int across,
          const Eigen::Vector3d& low,
          const Eigen::Vector3d& high,
          double sigma = 0)
{
  Surface surface;
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3d p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = random.uniform(low[axis], high[axis]);
    p[across] = low[across] + sigma * random.normal();
    surface.add(p, Eigen::Vector3d::Unit(across));
  }
  return surface;
}

/** \return three squares that meet in the origin; with exact normals */
inline Surface
corner(Random& random, std::size_t count, double side, double sigma = 0)
{
  Surface surface;
  for (int axis = 0; axis < 3; ++axis)
    surface.add(rectangle(random,
                          count / 3,
                          axis,
                          Eigen::Vector3d::Zero(),
                          Eigen::Vector3d::Constant(side),
                          sigma));
  return surface;
}

/** The nearest points by the definition. */
inline std::vector<IcpPair>
pairsByForce(const Points& target,
             const Points& source,
             const Eigen::Isometry3d& T,
             float limit)
{
  const PointList list(target);
  std::vector<IcpPair> pairs;
  const Points moved = transformed(source, T);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const Neighbour found = list.nearest(moved[i], limit * limit);
    if (found.index >= 0)
      pairs.push_back({static_cast<int>(i), found.index, found.distance_sq});
  }
  return pairs;
}

/** What an observer saw. */
struct Trace {
  std::vector<IcpIteration> seen;
  IcpResult result;
};

inline Trace
traceOf(const IcpTarget& target,
        const IcpSource& source,
        const IcpOptions& options,
        const Eigen::Isometry3d& guess = Eigen::Isometry3d::Identity())
{
  Trace trace;
  IcpHooks hooks;
  hooks.observer = [&](const IcpIteration& i) {
    trace.seen.push_back(i);
    return true;
  };
  trace.result = icp(target, source, guess, options, hooks);
  return trace;
}

/** Expects the same poses, pairs and errors, bit by bit, in every iteration. */
inline void
expectSameTrace(const Trace& found, const Trace& expected)
{
  EXPECT_EQ(found.result.status, expected.result.status);
  ASSERT_EQ(found.seen.size(), expected.seen.size());
  for (std::size_t i = 0; i < found.seen.size(); ++i) {
    ASSERT_EQ(found.seen[i].pairs, expected.seen[i].pairs) << "iteration " << i + 1;
    ASSERT_EQ(found.seen[i].rms, expected.seen[i].rms) << "iteration " << i + 1;
    ASSERT_TRUE(
        sameBits(found.seen[i].T_target_source, expected.seen[i].T_target_source))
        << "iteration " << i + 1;
  }
  EXPECT_TRUE(sameBits(found.result.T_target_source, expected.result.T_target_source));
  EXPECT_EQ(found.result.pairs, expected.result.pairs);
  EXPECT_EQ(found.result.rms, expected.result.rms);
  EXPECT_EQ(found.result.residual, expected.result.residual);
}

constexpr Metric kAllMetrics[] = {Metric::kPoint, Metric::kPlane, Metric::kGicp};
constexpr Metric kPlaneMetrics[] = {Metric::kPlane, Metric::kGicp};

inline const Eigen::Isometry3d kTruth =
    poseFromEuler({0.08, -0.06, 0.05}, {0.02, -0.01, 0.03});

inline const Eigen::Isometry3d kNudge =
    poseFromEuler({0.02, 0.01, -0.03}, {0.01, 0.01, -0.01});

inline IcpOptions
optionsOf(Metric metric)
{
  IcpOptions options;
  options.metric = metric;
  return options;
}

inline IcpResult
run(const Surface& target,
    const Surface& source,
    const IcpOptions& options,
    const Eigen::Isometry3d& guess = kIdentity)
{
  const IcpModel model = target.model(), data = source.model();
  return icp({model.part()}, data.source(), guess, options);
}

constexpr SearchMethod kExactSearches[] = {SearchMethod::kKdTree,
                                           SearchMethod::kCachedTree,
                                           SearchMethod::kOctree,
                                           SearchMethod::kBruteForce,
                                           SearchMethod::kFlann};

} // namespace pcl6d::test
