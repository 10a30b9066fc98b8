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

/** \brief What moved while scans were taken, by the scans of a registered map, and the scans without
 * it. */
class MovingStage {
public:
  explicit MovingStage(unsigned int num_threads) : num_threads_(num_threads) {}

  /** \brief Judges the reduced points of all scans at the poses of a result. Scans that could not
   * be matched, or whose rays say nothing, neither judge nor are judged.
   * \param[in] scans of the result; they are kept by reference
   * \param[in,out] result gets what was found \return whether the poses differ from those judged
   * last by as much as rays can tell, so that anything was done */
  bool
  judge(const std::deque<VerifiedScan>& scans, Slam6DResult& result);

  /** \brief judge() does its work again, also at the same poses. */
  void
  forget()
  {
    poses_.clear();
  }

  /** \return whether so much of a scan moved, and was matched, that it may pull the pose significantly
   * farther than the noise of its points does. \param[in] result its links and parameters */
  bool
  isNoticeable(const Slam6DResult& result) const;

  /** \brief The scans without what moved. \param[in] model how they are made ready for matching
   * \return one per scan; none where nothing moved, or too little would be left */
  std::deque<std::optional<IcpModel>>
  still(const IcpModel::Options& model) const;

  /** \brief Points of a scan, those reduced or others: which of them moved. Where little moved, only
   * what is near it is looked at; all else is taken to stand.
   * \return one per point \throws BadArgument there is no such scan */
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
  std::vector<const VerifiedScan*> scans_; ///< as judged
  std::vector<bool> is_judge_;             ///< which of these judge, and are judged
  std::vector<Eigen::Isometry3d> poses_;   ///< of these
  std::optional<MovingPoints> judges_;
  std::vector<std::vector<PointMotion>> motion_; ///< of each scan, its reduced points
  std::vector<Points> moving_;                   ///< of each scan, those that moved
  std::vector<PointTree> near_;                  ///< over these
  double reach_ = 0;                             ///< [m] around them that is looked at
};

} // namespace pcl6d::slam6d
