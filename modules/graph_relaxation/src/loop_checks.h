// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/require.h>
#include <pcl6d/graph_relaxation/error_diffusion.h>

/** \file
 * What error diffusion asks of loops and edges. */
namespace pcl6d {

inline void
requireLoop(std::size_t num_poses, std::size_t first, std::size_t last)
{
  const std::string rule = "less than the " + std::to_string(num_poses) + " poses";
  require(first < num_poses, "first", first, rule);
  require(last < num_poses, "last", last, rule);
  require(first != last, "last", last, "another scan than the first of the loop");
}

inline void
requireEnds(std::size_t num_poses, std::size_t a, std::size_t b)
{
  const std::string rule = "less than the " + std::to_string(num_poses) + " poses";
  require(a < num_poses, "end of an edge", a, rule);
  require(b < num_poses, "end of an edge", b, rule);
  require(a != b, "end of an edge", b, "another scan than the other end");
}

} // namespace pcl6d
