// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/pose_graph.h>

#include <vector>

/** \file Poses of a graph that has only links. */
namespace pcl6d::io {

/** \return poses along the links i -> i+1 from the identity if complete, else along a spanning
 * tree from the first pose of each component */
std::vector<Eigen::Isometry3d>
posesAlongLinks(std::size_t size, const std::vector<PoseLink>& links);

} // namespace pcl6d::io
