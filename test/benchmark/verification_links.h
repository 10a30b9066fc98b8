// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/registration/icp.h>
#include <pcl6d/verification/verified_scan.h>

#include <Eigen/Geometry>

#include <deque>
#include <filesystem>
#include <string>
#include <vector>

namespace pcl6d::bench {

/** \brief A recorded or simulated folder with a reference: scans made ready, and poses. */
struct LinkSet {
  std::string name;
  std::deque<IcpModel> models;
  std::deque<VerifiedScan> scans;
  std::vector<Points> measured;                ///< [m] within the range gate
  std::vector<Eigen::Isometry3d> T_world_scan; ///< of the reference
  IcpOptions icp;
  double voxel = 0;                    ///< [m]
  double min_range = 0, max_range = 0; ///< [m] the gate
};

/** \brief Reads at most so many scans of a folder; the reference is `groundtruth.txt`, or
 * the poses of the scans where there is none. \param[in] every takes each n-th scan */
LinkSet
readLinkSet(const std::filesystem::path& folder, int every, std::size_t most);

/** \brief A relative pose to be evaluated, and how far it is from the reference. */
struct TestedLink {
  std::string kind; ///< "right", "truth", "minimum", "fold", "apart" or "shift ..."
  std::size_t first = 0, second = 0;
  Eigen::Isometry3d T_first_second = Eigen::Isometry3d::Identity();
  double off = 0;  ///< [m]
  double turn = 0; ///< [rad]
};

/** \brief Right and wrong links of a set: the reference polished by ICP, what ICP finds
 * from random starts and from starts turned by half a turn, pairs that see nothing in
 * common, and known shifts. \param[in] gap largest difference of the places of a pair */
std::vector<TestedLink>
makeLinks(const LinkSet& set, std::size_t gap, std::size_t most_pairs, unsigned seed);

} // namespace pcl6d::bench
