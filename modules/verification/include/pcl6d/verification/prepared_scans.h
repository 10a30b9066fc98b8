// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/verification/verified_scan.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Measured points prepared for verification, like in a run: range gate, reduction, normals,
 * rays. The reduced points of each scan are kept, the measured points are not.
 * \code
 * pcl6d::PreparedScans prepared(2, pcl6d::deriveScanParameters({}, {first, second}));
 * prepared.set(0, first, "first");
 * prepared.set(1, second, "second");
 * pcl6d::linkEvidence(prepared.scans()[0], prepared.scans()[1], T_first_second);
 * \endcode \ingroup verification */
class PreparedScans {
public:
  /** \param[in] num_threads of each set(); 0: one per core; never changes the result */
  PreparedScans(std::size_t count,
                const ScanParameters& parameters,
                unsigned int num_threads = 0);
  PreparedScans(const PreparedScans&) = delete; // scans refer to their surfaces
  PreparedScans(PreparedScans&&) = default;
  PreparedScans&
  operator=(const PreparedScans&) = delete;
  PreparedScans&
  operator=(PreparedScans&&) = default;

  /** \brief Prepares a scan; different scans may be prepared concurrently.
   * \param[in] place index of the scan
   * \param[in] measured [m] with the origin of the rays at 0
   * \param[in] name for messages
   * \throws ComputeFailed fewer than 3 points lie within the range gate, or the scan is too large
   * for the voxels */
  void
  set(std::size_t place, const Points& measured, const std::string& name);

  /** \return the scans, valid once each is set */
  const std::deque<VerifiedScan>&
  scans() const
  {
    return scans_;
  }

  const ScanParameters&
  parameters() const
  {
    return parameters_;
  }

  /** \return the index of the first scan with identical points; its own index if unique. Links
   * between identical scans are no evidence of their poses */
  std::size_t
  firstLike(std::size_t place) const;

private:
  ScanParameters parameters_;
  unsigned int num_threads_;
  std::deque<std::optional<IcpModel>> surfaces_;
  std::deque<VerifiedScan> scans_;
  std::vector<std::uint64_t> fingerprints_; ///< of the points within the gate
};

} // namespace pcl6d
