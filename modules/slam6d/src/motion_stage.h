// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kept_scans.h"
#include "motion_tracker.h"

#include <pcl6d/graph_relaxation/motion_relaxation.h>
#include <pcl6d/slam6d/motion_options.h>
#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace pcl6d::slam6d {

/** \brief The motion within scans: found as they come, by those before, so that all that
 * follows works on scans as if they were taken at one time; then of all at once, when they are
 * registered. */
class MotionStage {
public:
  /** A scan as others take it. */
  struct Ready {
    Points points;
    Eigen::Isometry3d pose; ///< where it is taken to be
    std::string name;
  };

  /** The options are kept by reference. */
  explicit MotionStage(const Slam6DOptions& options) : options_(options) {}

  /** \brief Registered scans, or ones without times, stand as they are, and those that follow
   * are compared with them. */
  void
  addStill(const Points& points, const Eigen::Isometry3d& pose);

  /** \brief The next scan. It is told how it moved when the one after it is known.
   * \param[in] place in the result */
  void
  add(std::size_t place,
      const Points& points,
      const ScanTimes& times,
      const Eigen::Isometry3d& pose,
      const std::string& name);

  /** \return the scans of which is known how they moved, in their order
   * \param[in] all no more scans are to be waited for */
  std::vector<Ready>
  take(bool all);

  /** \return the number of scans that were added and not taken */
  std::size_t
  numWaiting() const
  {
    return waiting_.size();
  }

  /** \brief The motion of all scans at once, when they are registered: poses, points and
   * motions change unless the scans agree less then.
   * \param[in,out] scans get their points as they are undone now */
  void
  relax(const ScanMatcher& matcher, KeptScans& scans, Slam6DResult& result);

  /** \return whether the motion of a scan counts */
  bool
  anyMoved() const;

  /** \brief Says of each scan how it moved. */
  void
  describe(std::vector<ScanResult>& scans) const;

private:
  static constexpr double kSureDeviations =
      5; ///< as many scans are asked, see StageAgreement

  /** A scan that was added. */
  struct Added {
    std::size_t place = 0;
    MovingScan moving; ///< within the range gate
    Points points;     ///< all
    ScanTimes times;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    std::string name;
  };
  /** What is kept of a scan. */
  struct Known {
    std::size_t place = 0;
    TrackedScan tracked;
    double begin = 0, end = 0; ///< [s] of all of its points
  };

  /** Where a scan was taken to be, and where else it might be. */
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
              const std::vector<TimedPoints>& judges) const;
  std::string
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
  /** Where there may be stops between scans: the same as if there were none, until one of them
   * agrees clearly better. */
  std::optional<MotionTracker> rival_;
  double min_range_ = 0, max_range_ = 0, voxel_ = 0; ///< [m]
  std::deque<Added> waiting_; ///< the first num_tracked_ are tracked
  std::size_t num_tracked_ = 0;
  std::vector<Known> known_;
  std::optional<double> end_;    ///< [s] of the last scan that was added
  std::optional<Before> before_; ///< the last one taken
};

} // namespace pcl6d::slam6d
