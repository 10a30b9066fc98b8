// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/agreement.h"
#include "matching/initial_guess.h"
#include "matching/metascan.h"

#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <functional>
#include <string>

namespace pcl6d::slam6d {

/** \brief Sequential matching (book 4.1.5, 5.1.1): matches each reduced scan with the union of the
 * scans before, and accepts or rejects the match. */
class ScanMatcher {
public:
  /** Additional test of an accepted match, with the found pose and correction. \return the reason
   * for rejection; empty: accepted */
  using Verify = std::function<Rejection(const ScanResult&)>;

  /** Both are kept by reference. */
  ScanMatcher(const Slam6DOptions& options, const Slam6DParameters& parameters);

  /** \return the model of a scan, with what the metric requires */
  IcpModel
  prepare(Points reduced) const;

  /** \brief Whether scans have measured initial poses, from which matches take the motions that
   * surfaces leave open (holdOpenDirections()). */
  void
  setHoldsOpenDirections(bool holds)
  {
    holds_open_directions_ = holds;
  }

  /** \brief Adds the first scan, with a fixed pose.
   * \param[in] points, measured kept by reference, like in match() */
  void
  fix(const IcpModel& points, const MeasuredScan& measured, ScanResult& scan);

  /** \brief Matches a scan from its predicted pose T_world_scan, and adds it to the map if the
   * match is accepted.
   * \param[in] points kept by reference: must outlive the matcher
   * \param[in] measured kept by reference until after the next scan
   * \param[in] odometry the initial pose relative to the previous scan's
   * \param[in] verify none: no additional test */
  void
  match(const IcpModel& points,
        const MeasuredScan& measured,
        const Eigen::Isometry3d& odometry,
        ScanResult& scan,
        const Verify& verify = {});

  /** \brief Matches a recovered scan from its recovered pose T_world_scan. A rejected match has the
   * effect of passOver().
   * \param[in] points, measured kept by reference, like in match() */
  void
  matchFound(const IcpModel& points, const MeasuredScan& measured, ScanResult& scan);

  /** \brief Sets the scan before the next scan, without adding it to the map.
   * \param[in] measured kept by reference, like in match() */
  void
  passOver(const MeasuredScan& measured, const Eigen::Isometry3d& T_world_scan);

  /** \return whether the correction by a match is small enough to be supported by odometry alone
   * \param[in] predicted T_world_scan */
  bool
  isSmallCorrection(const ScanResult& scan, const Eigen::Isometry3d& predicted) const;

  /** \return whether a match moved the scan by less than the pair distance, and hardly turned it
   * \param[in] predicted T_world_scan */
  bool
  isWithinPairDistance(const ScanResult& scan,
                       const Eigen::Isometry3d& predicted) const;

  /** \brief Adds an already registered scan, at the pose of its result.
   * \param[in] points, measured kept by reference, like in match() */
  void
  takeIn(const IcpModel& points, const MeasuredScan& measured, const ScanResult& scan);

  /** \return whether matches at rest are refined, see refineMatch() */
  bool
  refines() const;

  /** \return the options of models; normals: also for the metric without normals */
  IcpModel::Options
  modelOptions(bool normals) const;

  /** \return the options of ICP for a scan with this number of points */
  IcpOptions
  icpOptions(std::size_t num_points) const;

private:
  /** The previous scan, registered or not. */
  struct Before {
    const MeasuredScan* measured = nullptr;
    Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
  };

  struct Match {
    IcpResult found;
    bool is_fixed_by_noise = false; ///< the weakest motion, see measureWeakest()
  };

  /** \return the match of a scan from a pose, refined and balanced where needed */
  Match
  matchPoints(const IcpTarget& target,
              const IcpModel& points,
              const Eigen::Isometry3d& guess) const;
  void
  matchFrom(const StartingPose& start,
            const IcpModel& points,
            const MeasuredScan& measured,
            const Eigen::Isometry3d& odometry,
            const Verify& verify,
            ScanResult& scan);
  void
  place(const IcpModel& points, const Eigen::Isometry3d& T_world_scan);
  Rejection
  rejectionOf(const IcpResult& found,
              InitialGuess start,
              double correction,
              double odometry_step) const;

  /** \return the reason if fewer points have a partner in the target, or in the previous scan, than
   * at the start of the match; else empty. Poses are relative to origin. */
  Rejection
  lossOfAgreement(const IcpTarget& target,
                  const IcpModel& points,
                  const MeasuredScan& measured,
                  const Eigen::Isometry3d& from,
                  const Eigen::Isometry3d& to,
                  const Eigen::Vector3d& origin) const;

  const Slam6DOptions& options_;
  const Slam6DParameters& parameters_;
  Metascan metascan_;
  std::vector<RegisteredScan> placed_; ///< the first scan, and all accepted scans
  Before before_;
  Eigen::Vector3d first_ = Eigen::Vector3d::Zero(); ///< position of the first scan [m]
  bool holds_open_directions_ = false;
};

} // namespace pcl6d::slam6d
