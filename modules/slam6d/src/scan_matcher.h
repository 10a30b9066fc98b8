// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "agreement.h"
#include "initial_guess.h"
#include "metascan.h"

#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <functional>
#include <string>

namespace pcl6d::slam6d {

/** \brief Sequential matching (book 4.1.5, 5.1.1): one reduced scan after the other
 * against the union of those before, and whether the match is to be believed. */
class ScanMatcher {
public:
  /** Asked for its opinion on a match that is otherwise believed, with the pose and the
   * correction that was found. \return why it is not to be believed, or nothing */
  using Judge = std::function<std::string(const ScanResult&)>;

  /** Both are kept by reference. */
  ScanMatcher(const Slam6DOptions& options, const Slam6DParameters& parameters);

  /** \return what a scan needs to be matched by these options */
  IcpModel
  prepare(Points reduced) const;

  /** \brief Takes in the first scan, which keeps its pose.
   * \param[in] points, measured kept by reference, as by match() */
  void
  fix(const IcpModel& points, const MeasuredScan& measured, ScanResult& scan);

  /** \brief Matches a scan from its predicted pose T_world_scan, and takes it in if the
   * match is believed.
   * \param[in] points kept by reference: must outlive the matcher
   * \param[in] measured kept by reference until after the next scan
   * \param[in] odometry the initial pose seen from that of the scan before
   * \param[in] judge none: no one is asked */
  void
  match(const IcpModel& points,
        const MeasuredScan& measured,
        const Eigen::Isometry3d& odometry,
        ScanResult& scan,
        const Judge& judge = {});

  /** \brief Matches a scan that was found again, from where it was found: its T_world_scan. If
   * that is not believed, it is as after passOver().
   * \param[in] points, measured kept by reference, as by match() */
  void
  matchFound(const IcpModel& points, const MeasuredScan& measured, ScanResult& scan);

  /** \brief Notes that the next scan follows this one, which is not taken in.
   * \param[in] measured kept by reference, as by match() */
  void
  passOver(const MeasuredScan& measured, const Eigen::Isometry3d& T_world_scan);

  /** \return whether a match moved a scan so little that odometry alone speaks for it
   * \param[in] predicted T_world_scan */
  bool
  isSmallCorrection(const ScanResult& scan, const Eigen::Isometry3d& predicted) const;

  /** \brief Takes in a scan that is registered already, as it stands in its result.
   * \param[in] points, measured kept by reference, as by match() */
  void
  takeIn(const IcpModel& points, const MeasuredScan& measured, const ScanResult& scan);

  /** \return what models need; normals whatever the metric, if so */
  IcpModel::Options
  modelOptions(bool normals) const;

  /** \return how a scan with so many points is matched */
  IcpOptions
  icpOptions(std::size_t num_points) const;

private:
  /** The scan before, whatever became of it. */
  struct Before {
    const MeasuredScan* measured = nullptr;
    Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
  };

  void
  matchFrom(const StartingPose& start,
            const IcpModel& points,
            const MeasuredScan& measured,
            const Eigen::Isometry3d& odometry,
            const Judge& judge,
            ScanResult& scan);
  void
  place(const IcpModel& points, const Eigen::Isometry3d& T_world_scan);
  std::string
  doubt(const IcpResult& found,
        InitialGuess start,
        double correction,
        double odometry_step) const;

  /** \return that fewer points meet the target, or the scan before, than did where the
   * match started, if so. Poses are relative to origin. */
  std::string
  lossOfAgreement(const IcpTarget& target,
                  const IcpModel& points,
                  const MeasuredScan& measured,
                  const Eigen::Isometry3d& from,
                  const Eigen::Isometry3d& to,
                  const Eigen::Vector3d& origin) const;

  const Slam6DOptions& options_;
  const Slam6DParameters& parameters_;
  Metascan metascan_;
  std::vector<BelievedScan> placed_; ///< first scan, and those whose match is believed
  Before before_;
  Eigen::Vector3d first_ = Eigen::Vector3d::Zero(); ///< position of the first scan [m]
};

} // namespace pcl6d::slam6d
