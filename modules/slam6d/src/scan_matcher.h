// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "initial_guess.h"
#include "metascan.h"

#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <string>

namespace pcl6d {

/** \brief Sequential matching (book 4.1.5, 5.1.1): one reduced scan after the other
 * against the union of those before, and whether the match is to be believed. */
class ScanMatcher {
public:
  /** Both are kept by reference. */
  ScanMatcher(const Slam6DOptions& options, const Slam6DParameters& parameters);

  /** \return what a scan needs to be matched by these options */
  IcpModel
  prepare(Points reduced) const;

  /** \brief Takes in the first scan, which keeps its pose. */
  void
  fix(const IcpModel& points, ScanResult& scan);

  /** \brief Matches a scan from its predicted pose T_world_scan, and takes it in if the
   * match is believed.
   * \param[in] points kept by reference: must outlive the matcher
   * \param[in] odometry_step length of the odometry's motion from the scan before [m] */
  void
  match(const IcpModel& points, double odometry_step, ScanResult& scan);

private:
  void
  place(const IcpModel& points, const Eigen::Isometry3d& T_world_scan);
  IcpOptions
  icpOptions(std::size_t num_points) const;
  IcpModel::Options
  modelOptions() const;
  std::string
  doubt(const IcpResult& found, double correction, double odometry_step) const;

  /** \return that fewer points meet than at the start, if so */
  std::string
  lossOfAgreement(const IcpTarget& target,
                  const Points& points,
                  const Eigen::Isometry3d& before,
                  const Eigen::Isometry3d& after) const;

  const Slam6DOptions& options_;
  const Slam6DParameters& parameters_;
  Metascan metascan_;
  std::vector<BelievedScan> placed_; ///< first scan, and those whose match is believed
  Eigen::Vector3d first_ = Eigen::Vector3d::Zero(); ///< position of the first scan [m]
};

} // namespace pcl6d
