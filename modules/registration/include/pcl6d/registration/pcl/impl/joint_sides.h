// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/icp.h>

#include <cstddef>
#include <memory>
#include <vector>

/** \file
 * The parts of JointICP6D that are free of point types. */
namespace PCL6D_EXPORTS pcl6d {
namespace registration {

/** \brief Several targets as one list of points, each with a tree of its own. */
struct JointTarget {
  std::vector<Points> parts; ///< relative to the origin
  std::vector<std::shared_ptr<const PointTree>> trees;
  std::vector<std::size_t> begin;                   ///< start of each part in `points`
  Points points;                                    ///< of the targets, in turn
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< [m]

  void
  make(std::vector<Points> targets, unsigned int num_threads);

  /** \return the nearest points within a point's own target
   * \param[in] point one of `points` */
  std::vector<Neighbour>
  nearestOfItsTarget(const Eigen::Vector3f& point, std::size_t k) const;
};

using FindPairs = decltype(IcpHooks::find);

/** \return the finder of pairs of one source and target; keeps both by reference */
FindPairs
pairFinder(const Points& source,
           const PointTree& tree,
           const Points& target,
           bool is_reciprocal,
           unsigned int num_threads);

/** \return the finder of the pairs of every source, with indices into the joined
 * points; keeps the target by reference \param[in] source_begin start of each source
 * in the joined source points */
FindPairs
jointFinder(std::vector<FindPairs> finders,
            std::vector<std::size_t> source_begin,
            const JointTarget& target);

} // namespace registration
} // namespace pcl6d
