// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/moving_objects/moving_points.h>
#include <pcl6d/registration/icp_model.h>
#include <pcl6d/slam6d/slam6d_result.h>
#include <pcl6d/verification/verified_scan.h>

#include <deque>
#include <optional>
#include <vector>

namespace pcl6d::slam6d {

/** \brief Finds the dynamic points of a registered map, and gives the scans without them. */
class MovingStage {
public:
  explicit MovingStage(unsigned int num_threads) : num_threads_(num_threads) {}

  /** \brief Tests the reduced points of all scans at the poses of a result. Unmatched scans and
   * scans without usable rays are neither tested nor observers.
   * \param[in] scans of the result; kept by reference
   * \param[in,out] result gets the summary \return false if nothing was done: the poses differ
   * from the previously tested poses by less than rays can detect */
  bool
  classify(const std::deque<VerifiedScan>& scans, Slam6DResult& result);

  /** \brief Makes the next call test again, also at unchanged poses. */
  void
  forget()
  {
    poses_.clear();
  }

  /** \return whether the dynamic, matched points of a scan may shift its pose significantly more
   * than the noise of its points. \param[in] result for links and parameters */
  bool
  isNoticeable(const Slam6DResult& result) const;

  /** \brief The scans without dynamic points. \param[in] model options of the models
   * \return one per scan; none without dynamic points, or if too few points would remain */
  std::deque<std::optional<IcpModel>>
  still(const IcpModel::Options& model) const;

  /** \brief Tests points of a scan, reduced or not. If few points of the scan are dynamic, only the
   * surroundings of dynamic points are tested; the rest counts as static.
   * \return one per point \throws BadArgument no scan has this index */
  std::vector<PointMotion>
  motionOf(std::size_t scan, const Points& points) const;

private:
  double
  sumOfPairs(std::size_t scan, std::size_t other, double max_distance) const;
  bool
  isJudged(const std::deque<VerifiedScan>& scans,
           const std::vector<ScanResult>& results) const;
  void
  empanel(const std::deque<VerifiedScan>& scans,
          const std::vector<ScanResult>& results);
  double
  shareOf(std::size_t scan) const;

  unsigned int num_threads_;
  std::vector<const VerifiedScan*> scans_; ///< the tested scans
  std::vector<bool> is_judge_;             ///< observer, and tested
  std::vector<Eigen::Isometry3d> poses_;   ///< when tested
  std::optional<MovingPoints> moving_points_;
  std::vector<std::vector<PointMotion>> motion_; ///< of each scan's reduced points
  std::vector<Points> moving_;                   ///< dynamic points of each scan
  std::vector<PointTree> near_;                  ///< of the dynamic points
  double reach_ = 0; ///< [m] around dynamic points that is tested
};

} // namespace pcl6d::slam6d
