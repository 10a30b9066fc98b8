// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/poses.h"

#include <pcl6d/common/pose_graph.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::test {

/** \return an information matrix with all entries filled, condition below 100 */
inline Eigen::Matrix<double, 6, 6>
randomInformation(Random& random)
{
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  const Matrix6 A = Matrix6::NullaryExpr([&] { return random.uniform(-1, 1); });
  const Matrix6 B = A * A.transpose() + Matrix6::Identity();
  return 50 * (B + B.transpose());
}

/** \return pose turned and shifted by normal noise [rad], [m] */
inline Eigen::Isometry3d
disturbed(const Eigen::Isometry3d& pose, Random& random, double noise)
{
  const auto draw = [&] { return noise * random.normal(); };
  Eigen::Isometry3d error = Eigen::Isometry3d::Identity();
  error.linear() = rotationFromVector(Eigen::Vector3d::NullaryExpr(draw));
  error.translation() = Eigen::Vector3d::NullaryExpr(draw);
  return pose * error;
}

/** \return poses on a ring of 10 m radius with any headings, a chain of links, one that
 * closes it and chords; the measurements have the noise [m], [rad] */
inline PoseGraph
ringGraph(std::size_t size, double noise, std::uint64_t seed)
{
  Random random(seed);
  PoseGraph graph;
  for (std::size_t i = 0; i < size; ++i) {
    const double angle = 2 * M_PI * static_cast<double>(i) / static_cast<double>(size);
    graph.poses.push_back(randomPose(random, 1, random.uniform(0, 3)));
    graph.poses.back().translation() +=
        Eigen::Vector3d(10 * std::cos(angle), 10 * std::sin(angle), 0);
  }
  const auto link = [&](std::size_t a, std::size_t b) {
    graph.links.push_back(
        {a,
         b,
         disturbed(graph.poses[a].inverse() * graph.poses[b], random, noise),
         randomInformation(random)});
  };
  for (std::size_t i = 0; i + 1 < size; ++i)
    link(i, i + 1);
  link(size - 1, 0);
  for (std::size_t i = 0; i + size / 2 < size; i += 2)
    link(i + size / 2, i);
  return graph;
}

/** Two rings and a pose alone; the second ring starts at pose 10. */
inline PoseGraph
twoRings(double noise)
{
  PoseGraph graph = ringGraph(10, noise, 1);
  const PoseGraph second = ringGraph(12, noise, 2);
  graph.poses.insert(graph.poses.end(), second.poses.begin(), second.poses.end());
  for (auto link : second.links) {
    link.from += 10;
    link.to += 10;
    graph.links.push_back(link);
  }
  graph.poses.push_back(second.poses[3]);
  return graph;
}

/** The poses as odometry gives them: along the links i -> i + 1. */
inline void
startFromChain(PoseGraph& graph)
{
  for (const auto& link : graph.links)
    if (link.to == link.from + 1)
      graph.poses[link.to] = graph.poses[link.from] * link.T_from_to;
}

/** \return the largest distance [m] + angle [rad] between the poses of two graphs */
inline double
largestDifference(const std::vector<Eigen::Isometry3d>& a,
                  const std::vector<Eigen::Isometry3d>& b)
{
  double largest = a.size() == b.size() ? 0 : INFINITY;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const MotionSize d = distanceBetween(a[i], b[i]);
    const double difference = d.translation + d.rotation;
    largest = difference <= largest ? largest : difference; // NaN shows
  }
  return largest;
}

} // namespace pcl6d::test
