// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/moving_objects/moving_points.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief MovingPoints from points and poses alone: computes the ray image and the reduced
 * surface of each scan, and stores only the two, not the points.
 *
 * Range gate and voxel are derived from each scan (deriveScanParameters()): missing echoes
 * recorded as the largest range, and the scanner's own housing, are no rays. About 1 MB a scan.
 * Copies share the computed data.
 * \code
 * pcl6d::MovingScans scans;
 * for (std::size_t i = 0; i < clouds.size(); ++i)
 *   scans.add(clouds[i], T_world_scan[i]);
 * const auto motion = scans.motion(3, clouds[3]); // one per point
 * \endcode
 * \ingroup moving_objects */
class MovingScans {
public:
  /** \throws BadArgument an invalid option */
  explicit MovingScans(const MovingPointsOptions& options = {});

  /** \brief Sets the voxel edge of surfaces, for scans added from now on. Points farther away
   * than 2^18 voxels are beyond the range gate.
   * \param[in] voxel [m] empty: derived from each scan
   * \throws BadArgument unless finite and > 0 */
  void
  setVoxel(const std::optional<double>& voxel);

  /** \brief Sets the largest number of threads; never changes the result.
   * \param[in] num_threads 0: a thread per core */
  void
  setNumberOfThreads(unsigned int num_threads);

  /** \brief Adds a scan, in the order of time.
   * \param[in] measured every point [m], not reduced; NaN are skipped. A scan without points is
   * no observer
   * \param[in] sigma of the pose, relative to the poses of its neighbours
   * \param[in] origin [m] position of the scanner, in the scan's frame
   * \return its index, from 0
   * \throws BadArgument the pose is not a rigid motion, a sigma is negative or not finite, or
   * the origin is not finite; the scan is not added then */
  std::size_t
  add(const Points& measured,
      const Eigen::Isometry3d& T_world_scan,
      const PoseSigma& sigma = {},
      const Eigen::Vector3f& origin = Eigen::Vector3f::Zero());

  std::size_t
  size() const
  {
    return scans_.size();
  }

  /** \return [m] the voxel of a scan's surface
   * \throws BadArgument an index out of range */
  double
  voxel(std::size_t scan) const;

  /** \brief Classifies the points of one scan by the other scans.
   * \param[in] measured every point [m] of the scan in its frame, as clusters need the points
   * around; reduced points will do
   * \return one per point: unknown, too, beyond the range gate
   * \throws BadArgument an index out of range */
  std::vector<PointMotion>
  motion(std::size_t scan, const Points& measured);

  /** \return whether rays contradict scans too much to classify points: every point is then
   * unknown */
  bool
  isBlind();

  /** \return MovingPoints of the scans added so far, with scan frames at the scanner positions */
  const MovingPoints&
  observers();

private:
  struct Kept;
  const Kept&
  kept(std::size_t scan) const;

  MovingPointsOptions options_;
  std::optional<double> voxel_;
  std::vector<std::shared_ptr<const Kept>> scans_;
  std::shared_ptr<const MovingPoints>
      observers_; ///< null: not made since the last scan
};

} // namespace pcl6d
