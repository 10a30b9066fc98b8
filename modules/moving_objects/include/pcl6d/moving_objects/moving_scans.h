// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/moving_objects/moving_points.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief MovingPoints for whoever has nothing but points and poses: makes of each scan the
 * image of its rays and its reduced surface, keeps these, and not the points.
 *
 * Range gate and voxel are derived from each scan (deriveScanParameters()): missing echoes that
 * were written as the largest range, and the scanner's own housing, are no rays. About 1 MB a
 * scan. Copies share what was made. \code
 * pcl6d::MovingScans scans;
 * for (std::size_t i = 0; i < clouds.size(); ++i)
 *   scans.add(clouds[i], T_world_scan[i]);
 * const auto motion = scans.motion(3, clouds[3]); // one per point
 * \endcode \ingroup moving_objects */
class MovingScans {
public:
  /** \throws BadArgument an option breaks its rule */
  explicit MovingScans(const MovingPointsOptions& options = {});

  /** \brief The edge of the voxels that reduce surfaces, for scans that are added from now on.
   * Points farther away than 2^18 voxels are beyond the range gate.
   * \param[in] voxel [m] none: derived from each of them
   * \throws BadArgument it is not finite and > 0 */
  void
  setVoxel(const std::optional<double>& voxel);

  /** \brief How many threads may run; never changes the result. \param[in] num_threads 0: one
   * per core */
  void
  setNumberOfThreads(unsigned int num_threads);

  /** \brief Takes in a scan; scans count in the order of time.
   * \param[in] measured all its points [m], not reduced; NaN are left out. Without points it
   * judges nobody
   * \param[in] sigma of the pose, relative to those of its neighbours
   * \param[in] origin [m] where the scanner stood, in the scan's frame
   * \return its number, from 0
   * \throws BadArgument the pose is not a rigid motion, a sigma is negative or not finite, or the
   * origin is not finite; the scan is not taken in then */
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

  /** \return [m] the voxel of a scan's surface \throws BadArgument there is no such scan */
  double
  voxel(std::size_t scan) const;

  /** \brief What the other scans say of points of one scan.
   * \param[in] measured all of them [m] in its frame, as clusters need the points around them;
   * reduced ones will do
   * \return one per point: unknown, too, for those beyond the range gate
   * \throws BadArgument there is no such scan */
  std::vector<PointMotion>
  motion(std::size_t scan, const Points& measured);

  /** \return whether rays contradict scans too much to tell what moved: all is unknown then */
  bool
  isBlind();

  /** \return of the scans added so far; its scans are as seen from where the scanner stood */
  const MovingPoints&
  judges();

private:
  struct Kept;
  const Kept&
  kept(std::size_t scan) const;

  MovingPointsOptions options_;
  std::optional<double> voxel_;
  std::vector<std::shared_ptr<const Kept>> scans_;
  std::shared_ptr<const MovingPoints> judges_; ///< null: not made since the last scan
};

} // namespace pcl6d
