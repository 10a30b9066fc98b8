// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/agreement.h"

#include <pcl6d/common/progress.h>
#include <pcl6d/common/work_sharing.h>
#include <pcl6d/registration/icp_model.h>
#include <pcl6d/slam6d/slam6d_result.h>
#include <pcl6d/verification/map_verifier.h>
#include <pcl6d/verification/verified_scan.h>

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pcl6d::slam6d {

/** \return whether a map is kept, given for each scan whether it is connected */
using MapIsKept = std::function<bool(const std::vector<bool>& connected)>;

/** The verdict on the map of a run. Keeps the scans as rays and surfaces from the time their
 * measured points are available until all poses are known. */
class RunVerification {
public:
  explicit RunVerification(unsigned int num_threads) : num_threads_(num_threads) {}

  /** \param[in] sharing of the work between processes; null: a single process */
  void
  setSharing(WorkSharing* sharing)
  {
    sharing_ = sharing;
  }

  /** \param[in] frames DriveContext::frame of all scans */
  void
  setFrames(const std::vector<Eigen::Matrix<double, 6, 6>>& frames)
  {
    frames_ = frames;
  }

  /** \param[in] are_refined the matches are refined */
  void
  setRefined(bool are_refined)
  {
    are_refined_ = are_refined;
  }

  /** Adds the new scans. After an exception of the report, the next call continues.
   * \param[in] reduced, measured of all scans; reduced is kept by reference, measured is needed
   * only for scans owned by this process
   * \param[in] normals options of the normals, for reduced scans without normals
   * \param[in] voxel [m] of the reduction
   * \param[in] report of the scans added so far; called after one scan of each thread, with several
   * processes after a few scans of each process */
  void
  prepare(const std::deque<IcpModel>& reduced,
          const std::deque<MeasuredScan>& measured,
          const IcpModel::Options& normals,
          double voxel,
          const ProgressCallback& report);

  /** \return the scans added before */
  const std::deque<VerifiedScan>&
  scans() const
  {
    return scans_;
  }

  /** Verifies the map, unless the poses are unchanged since the previous verdict.
   * \param[in] names of the scans
   * \param[in,out] result gets its verification, and the covariances of its scans */
  void
  verify(const std::vector<std::string>& names, Slam6DResult& result);

  /** Verifies a map that is compared with another: briefly, if it is not kept.
   * \param[in] is_kept asked with the connected scans */
  void
  verifyTrial(const std::vector<std::string>& names,
              const MapIsKept& is_kept,
              Slam6DResult& result);

  /** The variance factor of the last verdict becomes the least factor of further verdicts, until
   * forgetVariance(): links agree with a map that was adjusted to them */
  void
  keepVariance()
  {
    least_factor_ = factor_;
  }

  void
  forgetVariance()
  {
    least_factor_ = 1;
  }

  /** \return the least variance factor, for linksOfMap() */
  double
  leastFactor() const
  {
    return least_factor_;
  }

private:
  /** Input of a verdict, for each scan. */
  struct Verified {
    Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
    bool is_unsure = false; ///< found without a prior: the pose may be ambiguous
  };

  void
  verify(const std::vector<std::string>& names,
         const MapIsKept& is_kept,
         Slam6DResult& result);
  MapVerification
  verdictOn(const std::vector<Verified>& map,
            const std::vector<std::string>& names,
            const MapIsKept& is_kept,
            const std::vector<ScanResult>& scans);

  void
  explainDoubts(const std::vector<ScanResult>& scans, MapVerification& map);

  unsigned int num_threads_;
  bool are_refined_ = false;
  double factor_ = 1, least_factor_ = 1; ///< variance factors, see boundPoses()
  WorkSharing* sharing_ = nullptr;
  std::vector<Eigen::Matrix<double, 6, 6>> frames_;
  std::deque<std::optional<IcpModel>> surfaces_; ///< for reduced scans without normals
  std::deque<VerifiedScan> scans_;
  std::vector<Verified> verified_;         ///< the last time
  LinkMemory links_;                       ///< of the last verdict
  std::vector<Eigen::Isometry3d> initial_; ///< poses last searched for a mistake
  std::string mistake_;                    ///< of these poses
};

} // namespace pcl6d::slam6d
