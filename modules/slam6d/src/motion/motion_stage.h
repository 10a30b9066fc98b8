// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/kept_scans.h"

#include <pcl6d/deskew/motion_options.h>
#include <pcl6d/deskew/motion_relaxation.h>
#include <pcl6d/deskew/motion_tracker.h>
#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace pcl6d::slam6d {

using deskew::MotionTracker;
using deskew::MovingScan;
using deskew::TrackedScan;

/** \brief Deskews scans, in two steps. As scans are added, each is deskewed with the scans before,
 * and later stages work on scans without motion. When all scans are registered, their motions are
 * estimated together. */
class MotionStage {
public:
  /** A deskewed scan for the next stages. */
  struct Ready {
    Points points;
    Eigen::Isometry3d pose; ///< T_world_scan to start with
    std::string name;
  };

  /** The options are kept by reference. */
  explicit MotionStage(const Slam6DOptions& options) : options_(options) {}

  /** \brief Adds a registered or untimed scan unchanged; the scans that follow are matched with
   * it. */
  void
  addStill(const Points& points, const Eigen::Isometry3d& pose);

  /** \brief Adds the next scan. Its motion is known once the scan after it is added.
   * \param[in] place index in the result */
  void
  add(std::size_t place,
      const Points& points,
      const ScanTimes& times,
      const Eigen::Isometry3d& pose,
      const std::string& name);

  /** \return the scans with known motion, in order
   * \param[in] all no further scans are expected */
  std::vector<Ready>
  take(bool all);

  /** \return the number of added scans not yet taken */
  std::size_t
  numWaiting() const
  {
    return waiting_.size();
  }

  /** \brief Estimates the motions of all registered scans together. Poses, points and motions are
   * updated unless the scans agree less afterwards.
   * \param[in,out] scans get their points, deskewed anew */
  void
  relax(const ScanMatcher& matcher, KeptScans& scans, Slam6DResult& result);

  /** \return whether any scan was deskewed */
  bool
  anyMoved() const;

  /** \brief Writes the motion of each scan to its result. */
  void
  describe(std::vector<ScanResult>& scans) const;

private:
  static constexpr double kSureDeviations =
      5; ///< large, because many scans are tested, see StageAgreement

  /** An added scan. */
  struct Added {
    std::size_t place = 0;
    MovingScan moving; ///< within the range gate
    Points points;     ///< without range gate
    ScanTimes times;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    std::string name;
  };
  /** The kept data of a scan. */
  struct Known {
    std::size_t place = 0;
    TrackedScan tracked;
    double begin = 0, end = 0; ///< [s] of all points
  };

  /** Poses of a scan: given, taken for registration, and tracked. */
  struct Before {
    Eigen::Isometry3d given, taken, tracked;
    bool is_as_given = true;
  };

  void
  begin(const Points& points);
  void
  trackNext();
  void
  decide();
  Ready
  readyOf(const Added& added, const TrackedScan& tracked);
  Eigen::Isometry3d
  placeOf(const Added& added, const TrackedScan& tracked);
  MotionWithinScan
  motionOf(const Known& known) const;
  std::vector<std::size_t>
  placedScans(const Slam6DResult& result) const;
  MotionRelaxationOptions
  relaxationOptions() const;
  StageAgreement
  agreementOf(const std::vector<std::vector<double>>& before,
              const std::vector<std::vector<double>>& after,
              const std::vector<TimedPoints>& test_halves) const;
  Rejection
  whyNot(const MotionRelaxationResult& relaxed,
         const StageAgreement& agreement,
         const std::vector<std::size_t>& members) const;
  void
  takeOver(const std::vector<std::size_t>& members,
           const std::vector<MotionScan>& moving,
           const ScanMatcher& matcher,
           KeptScans& scans,
           Slam6DResult& result);

  const Slam6DOptions& options_;
  std::optional<MotionTracker> tracker_;
  /** Second tracker, with the assumption of no stops between scans; used until either tracker
   * agrees clearly better. */
  std::optional<MotionTracker> rival_;
  double min_range_ = 0, max_range_ = 0, voxel_ = 0; ///< [m]
  std::deque<Added> waiting_; ///< the first num_tracked_ are tracked
  std::size_t num_tracked_ = 0;
  std::vector<Known> known_;
  std::optional<double> end_;    ///< [s] of the latest added scan
  std::optional<Before> before_; ///< of the latest taken scan
};

} // namespace pcl6d::slam6d
