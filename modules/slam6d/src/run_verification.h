// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "agreement.h"

#include <pcl6d/common/work_sharing.h>
#include <pcl6d/registration/icp_model.h>
#include <pcl6d/slam6d/slam6d_result.h>
#include <pcl6d/verification/verified_scan.h>

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace pcl6d::slam6d {

/** The verdict on the map of a run: its scans as rays and surfaces, kept from when their
 * measured points are there to when all poses are known. */
class RunVerification {
public:
  explicit RunVerification(unsigned int num_threads) : num_threads_(num_threads) {}

  /** \param[in] sharing of the work between processes; null: this one does all */
  void
  setSharing(WorkSharing* sharing)
  {
    sharing_ = sharing;
  }

  /** Takes in the scans that are new.
   * \param[in] reduced, measured of all scans; the former are kept by reference, the latter
   * are needed of those that this process owns
   * \param[in] normals how surfaces are made where reduced scans have no normals
   * \param[in] voxel [m] of the reduction */
  void
  prepare(const std::deque<IcpModel>& reduced,
          const std::deque<MeasuredScan>& measured,
          const IcpModel::Options& normals,
          double voxel);

  /** \return those that were taken in */
  const std::deque<VerifiedScan>&
  scans() const
  {
    return scans_;
  }

  /** \param[in] names of the scans
   * \param[in,out] result gets its verification, and the covariances of its scans */
  void
  verify(const std::vector<std::string>& names, Slam6DResult& result) const;

private:
  void
  explainDoubts(const std::vector<ScanResult>& scans, MapVerification& map) const;

  unsigned int num_threads_;
  WorkSharing* sharing_ = nullptr;
  std::deque<std::optional<IcpModel>> surfaces_; ///< where reduced ones have no normals
  std::deque<VerifiedScan> scans_;
};

} // namespace pcl6d::slam6d
