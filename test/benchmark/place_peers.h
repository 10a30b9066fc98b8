// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "verification_links.h"

#include <Eigen/Geometry>

#include <memory>
#include <string>
#include <vector>

namespace pcl6d::bench {

/** \brief What a method says of a pair of scans. */
struct PeerPlace {
  bool accepted = false; ///< by the method's own statement
  Eigen::Isometry3d T_first_second = Eigen::Isometry3d::Identity();
  double seconds = 0; ///< of the processor for the pair; what is made once a scan apart
};

/** \return [s] that this process has had of the processor: what others do does not count */
double
secondsOfProcessor();

/** \brief Other ways to place a scan on another without a guess, each with settings that
 * follow from the voxel of the set:
 * - "prerejective": pcl::SampleConsensusPrerejective on FPFH, as in PCL's tutorial
 * - "fpcs": pcl::registration::FPCSInitialAlignment, at most 5 s a pair
 * - "kfpcs": pcl::registration::KFPCSInitialAlignment on Harris' key points, the same
 * - "features": alignByFeatures(), all of it for each pair
 *
 * FPCS and KFPCS draw by the clock, so their figures differ from run to run by a few pairs. */
class PlacePeers {
public:
  /** \param[in] set kept by reference, with what was measured */
  explicit PlacePeers(const LinkSet& set);
  ~PlacePeers();

  static const std::vector<std::string>&
  names();

  PeerPlace
  place(const std::string& name, std::size_t first, std::size_t second);

  /** \return [s] a scan that PCL's normals, features and key points took */
  double
  secondsOfScan() const;

private:
  struct Scan;
  const Scan&
  scan(std::size_t i);

  const LinkSet& set_;
  std::vector<std::unique_ptr<Scan>> scans_; ///< made when they are needed
};

} // namespace pcl6d::bench
