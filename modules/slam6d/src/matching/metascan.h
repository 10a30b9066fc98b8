// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/icp_model.h>

#include <map>
#include <utility>
#include <vector>

namespace pcl6d::slam6d {

/** \brief The union of registered scans against which a new scan is matched (book 4.1.5).
 *
 * Scan i is a leaf of a binary tree over the scans; the node k of level l stands for the scans
 * from k 2^l up to (k + 1) 2^l. Any run of scans is a union of few nodes. Each node is built once,
 * when first needed: adding a scan never builds the whole union anew, and a point takes part in
 * log2(number of scans) k-d trees. Leaves stay in their scan's frame; a node has an origin near
 * its first scan, to keep float coordinates small far from the world's origin. */
class PCL6D_EXPORTS Metascan { // exported for its test
public:
  /** \param[in] voxel [m] a node keeps one point per voxel
   * \param[in] max_scans number of latest scans to use; 0: all
   * \param[in] options of the nodes' models; the normals are taken from the scans */
  Metascan(double voxel, int max_scans, const IcpModel::Options& options);

  /** \param[in] scan kept by reference: must outlive the metascan */
  void
  add(const IcpModel& scan, const Eigen::Isometry3d& T_world_scan);

  /** \return the last scans as a target, with the world's axes and the given origin. The target
   * refers to the metascan's nodes until the next add() */
  IcpTarget
  around(const Eigen::Vector3d& origin);

private:
  struct Member {
    const IcpModel* scan;
    Eigen::Isometry3d T_world_scan;
  };
  struct Node {
    Eigen::Vector3d origin; ///< [m] in the world
    IcpModel model;
  };
  using Place = std::pair<int, std::size_t>; ///< level, k

  const Node&
  node(const Place& place);

  double voxel_;
  std::size_t max_scans_;
  IcpModel::Options options_;
  std::vector<Member> members_;
  std::map<Place, Node> nodes_; ///< of levels >= 1
};

} // namespace pcl6d::slam6d
