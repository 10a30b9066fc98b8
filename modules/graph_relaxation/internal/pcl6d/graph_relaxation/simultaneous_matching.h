// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/progress.h>
#include <pcl6d/registration/icp_model.h>

#include <memory>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of simultaneous matching. */
struct SimultaneousMatchingOptions {
  IcpOptions icp;                ///< of each match; max_distance
                                 ///< also defines neighbours
  std::size_t master = 0;        ///< the fixed scan
  std::size_t min_pairs = 250;   ///< neighbours have more closest pairs
  double min_translation = 0.05; ///< [m] a scan that moved farther ...
  double min_rotation = 0.1 * 3.14159265358979324 /
                        180;      ///< [rad] ... or turned more wakes its neighbours;
                                  ///< both >= 0
  std::size_t pops_per_scan = 50; ///< limit of the matches, times scans; > 0
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Result of simultaneous matching. */
struct SimultaneousMatchingResult {
  /** kOk: converged, no scan moves its neighbours any more. kMaxIterations: the limit was
   * reached. kTooFewPairs: no scan had a neighbour, no match was made */
  Status status = Status::kTooFewPairs;
  std::vector<Eigen::Isometry3d> poses; ///< T_world_scan
  std::size_t pops = 0;                 ///< scans taken from the queue
  std::size_t failed = 0;               ///< failed matches; their scans stay
};

/** \brief Relaxes the poses of a closed loop scan by scan: a scan from a queue is matched with
 * the union of its neighbours; if the scan moved, its neighbours join the queue (book 5.1.3).
 *
 * Local and simple: a reference for the relaxations that move every scan at once, which need
 * far fewer matches. Convergence is not guaranteed, so the number of matches is limited.
 * Bit-identical for any number of threads, and independent of the world origin: each match runs
 * in the frame of its scan.
 * \code
 * std::vector<std::shared_ptr<const pcl6d::IcpModel>> scans = ...;
 * const auto relaxed = pcl6d::SimultaneousMatching().align(scans, poses, {closing_scan});
 * \endcode
 * \note Source: K. Pulli, "Multiview registration for large data sets", 3DIM 1999; in six
 * degrees of freedom A. Nüchter et al., "6D SLAM - 3D mapping outdoor environments", JFR 2007.
 * \ingroup graph_relaxation */
class SimultaneousMatching {
public:
  using Scans = std::vector<std::shared_ptr<const IcpModel>>;

  /** \throws BadArgument an invalid option */
  explicit SimultaneousMatching(const SimultaneousMatchingOptions& options = {});

  /** \brief Called after each match with the number of matches and the limit. */
  void
  setProgress(ProgressCallback progress);

  /** \param[in] scans in their own frames, with normals if the metric needs normals
   * \param[in] poses T_world_scan, near enough for ICP; the master's pose stays fixed
   * \param[in] start scans of the first queue, such as the first scan of the closed loop;
   * empty: every scan except the master. A master in the queue wakes its neighbours
   * \throws BadArgument poses are not rigid or not one per scan, a scan is null, an index in
   * start or master is out of range, or the metric lacks normals */
  SimultaneousMatchingResult
  align(const Scans& scans,
        const std::vector<Eigen::Isometry3d>& poses,
        const std::vector<std::size_t>& start = {}) const;

private:
  SimultaneousMatchingOptions options_;
  ProgressCallback progress_;
};

} // namespace pcl6d
