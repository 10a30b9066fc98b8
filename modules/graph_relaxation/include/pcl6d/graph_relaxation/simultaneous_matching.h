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
  IcpOptions icp;                ///< of each match; max_distance also tells neighbours
  std::size_t master = 0;        ///< the scan that stays
  std::size_t min_pairs = 250;   ///< neighbours have more closest pairs than that
  double min_translation = 0.05; ///< [m] a scan that moved farther ...
  double min_rotation = 0.1 * 3.14159265358979324 /
                        180;      ///< [rad] ... or turned more wakes its neighbours;
                                  ///< both >= 0
  std::size_t pops_per_scan = 50; ///< limit of the matches, times scans; > 0
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief What simultaneous matching came to. */
struct SimultaneousMatchingResult {
  /** kOk: no scan moves its neighbours any more. kMaxIterations: the limit was reached.
   * kTooFewPairs: no scan had a neighbour, nothing was matched */
  Status status = Status::kTooFewPairs;
  std::vector<Eigen::Isometry3d> poses; ///< T_world_scan
  std::size_t pops = 0;                 ///< scans that were taken from the queue
  std::size_t failed =
      0; ///< of these, matches that failed: the scan stayed where it was
};

/** \brief Relaxes the poses of a closed loop scan by scan: a scan from a queue is matched
 * with the union of its neighbours; if it moved, they join the queue (book 5.1.3).
 *
 * Local and simple: a reference for the relaxations that move all scans at once, which
 * need far fewer matches. It need not come to an end, so that the matches are limited.
 * The same bits for any number of threads, wherever the origin of the world is: each match
 * runs in the frame of its scan.
 * \code
 * std::vector<std::shared_ptr<const pcl6d::IcpModel>> scans = ...;
 * const auto relaxed = pcl6d::SimultaneousMatching().align(scans, poses, {closing_scan});
 * \endcode
 * \note Source: K. Pulli, "Multiview registration for large data sets", 3DIM 1999; in six
 * degrees of freedom A. Nüchter et al., "6D SLAM - 3D mapping outdoor environments", JFR
 * 2007. \ingroup graph_relaxation */
class SimultaneousMatching {
public:
  using Scans = std::vector<std::shared_ptr<const IcpModel>>;

  /** \throws BadArgument an option breaks its rule */
  explicit SimultaneousMatching(const SimultaneousMatchingOptions& options = {});

  /** \brief Called after each match: how many, of the limit. */
  void
  setProgress(ProgressCallback progress);

  /** \param[in] scans in their own frames, with normals if the metric needs them
   * \param[in] poses T_world_scan, near enough for ICP; the master's stays
   * \param[in] start scans to begin with, such as the first of the closed loop; none: all
   * but the master. The master among them wakes its neighbours
   * \throws BadArgument poses are not rigid or not one per scan, a scan is null, start or
   * master are no scans, or the metric lacks normals */
  SimultaneousMatchingResult
  align(const Scans& scans,
        const std::vector<Eigen::Isometry3d>& poses,
        const std::vector<std::size_t>& start = {}) const;

private:
  SimultaneousMatchingOptions options_;
  ProgressCallback progress_;
};

} // namespace pcl6d
