// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/pairs.h"

#include <pcl6d/graph_relaxation/graph_slam.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace pcl6d::test {

using Poses = std::vector<Eigen::Isometry3d>;
using Edges = std::vector<std::pair<std::size_t, std::size_t>>;

/** \brief How a graph of scans is made. */
struct GraphRecipe {
  std::size_t scans = 10;
  Edges edges;                ///< empty: chain, loop and two chords
  std::size_t pairs = 60;     ///< per link
  double noise = 0.05;        ///< [m] per component of a pair's point
  double start_shift = 0.3;   ///< [m] standard deviation per component of the start
  double start_turn = 0.1;    ///< [rad] the same
  double headings = 2 * M_PI; ///< [rad] that the scans cover
  double pitch = 0;           ///< [rad] of all scans
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< of the ring, in the world
  std::uint64_t seed = 1;
};

/** \brief Scans on a ring of 8 m with pairs of matched points in a cube of 10 m. */
struct GraphCase {
  Poses truth;
  Poses start; ///< of which the first is true
  std::vector<LinkPairs> links;
};

inline Edges
ringEdges(std::size_t scans)
{
  Edges edges;
  for (std::size_t i = 0; i < scans; ++i)
    edges.emplace_back(i, (i + 1) % scans);
  edges.emplace_back(0, scans / 2);
  edges.emplace_back(scans / 4, 3 * scans / 4);
  return edges;
}

inline Edges
chainEdges(std::size_t scans)
{
  Edges edges;
  for (std::size_t i = 0; i + 1 < scans; ++i)
    edges.emplace_back(i, i + 1);
  return edges;
}

/** \return pairs of points about the middle between two scans, with noise on both */
inline LinkPairs
makePairs(Random& random,
          const Poses& truth,
          std::size_t from,
          std::size_t to,
          std::size_t count,
          double noise)
{
  LinkPairs link;
  link.from = from;
  link.to = to;
  const Eigen::Vector3d middle =
      0.5 * (truth[from].translation() + truth[to].translation());
  const Eigen::Isometry3d to_from = truth[from].inverse(), to_to = truth[to].inverse();
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Vector3d p = middle + randomVector(random, 5);
    const Eigen::Vector3d at_from = normalVector(random, noise);
    const Eigen::Vector3d at_to = normalVector(random, noise);
    link.points_from.push_back((to_from * (p + at_from)).cast<float>());
    link.points_to.push_back((to_to * (p + at_to)).cast<float>());
  }
  return link;
}

inline Poses
ringPoses(const GraphRecipe& recipe)
{
  Poses poses;
  for (std::size_t i = 0; i < recipe.scans; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(recipe.scans);
    const double place = 2 * M_PI * share;
    const double height = 0.3 * std::sin(3 * place);
    poses.push_back(poseFromEuler(
        recipe.origin +
            Eigen::Vector3d(8 * std::cos(place), 8 * std::sin(place), height),
        {0.1 * std::sin(place), recipe.pitch, recipe.headings * share + 0.2}));
  }
  return poses;
}

inline GraphCase
makeGraph(const GraphRecipe& recipe)
{
  Random random(recipe.seed);
  GraphCase graph;
  graph.truth = ringPoses(recipe);
  graph.start = graph.truth;
  for (std::size_t i = 1; i < recipe.scans; ++i) {
    const Eigen::Vector3d shift = normalVector(random, recipe.start_shift);
    const Eigen::Vector3d turn = normalVector(random, recipe.start_turn);
    graph.start[i].translation() += shift;
    graph.start[i].linear() = rotationFromVector(turn) * graph.start[i].linear();
  }
  const Edges edges = recipe.edges.empty() ? ringEdges(recipe.scans) : recipe.edges;
  for (const auto& [a, b] : edges)
    graph.links.push_back(
        makePairs(random, graph.truth, a, b, recipe.pairs, recipe.noise));
  return graph;
}

/** \return the longest distance between the positions of two sets of poses [m] */
inline double
largestDistance(const Poses& a, const Poses& b)
{
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, distanceBetween(a[i], b[i]).translation);
  return largest;
}

/** \return the largest angle between the rotations of two sets of poses [rad] */
inline double
largestTurn(const Poses& a, const Poses& b)
{
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, distanceBetween(a[i], b[i]).rotation);
  return largest;
}

/** \return options that iterate fixed pairs to the last digits */
inline GraphSlamOptions
exactOptions(Relaxation relaxation, LinkWeights weights = LinkWeights::kPairs)
{
  GraphSlamOptions options;
  options.relaxation = relaxation;
  options.weights = weights;
  options.translation_epsilon = 1e-10;
  options.rotation_epsilon = 1e-10;
  options.error_epsilon = 0;
  options.max_iterations = 100;
  options.num_threads = 1;
  return options;
}

} // namespace pcl6d::test
