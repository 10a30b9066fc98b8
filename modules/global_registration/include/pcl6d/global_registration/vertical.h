// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/filters/point_normals.h>

#include <Eigen/Core>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Which way is up, from surfaces alone: floors and ceilings lie level, walls, poles
 * and trunks stand upright. */
struct VerticalEstimate {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ(); ///< unit vector, in the normals' frame
  double share = 0;     ///< of the normals that are level or upright by it, in [0, 1]
  bool is_sure = false; ///< the surfaces alone tell it from all other directions
  /** other directions, unit vectors, by which nearly as many are level or upright, as by the
   * three axes of a bare room; either end of each may be up. Best first */
  std::vector<Eigen::Vector3d> others;
};

/** \brief Finds the vertical of a scan.
 *
 * A direction is as good as the share of normals within 5 deg of it or of the plane across
 * it. Those of normals, of the cross products of two, and the expected one are tried; the best
 * are refined by least squares. Among directions that are as good, the one nearest to what is
 * expected is up.
 * \param[in] normals unit vectors; zero ones are skipped
 * \param[in] expected unit vector, the sensor's own: tells up from down, and decides where the
 * surfaces do not
 * \return without normals, or where no direction is better than chance: the expected one, not
 * sure
 * \throws BadArgument expected is no unit vector
 * \note Source: algorithms.md G.4 \ingroup global_registration */
VerticalEstimate
estimateVertical(const Normals& normals,
                 const Eigen::Vector3d& expected = Eigen::Vector3d::UnitZ());

/** \brief The same from measured points: their range gate and reduction follow from them
 * (deriveScanParameters()), and the normals are those of the reduced points.
 * \param[in] measured [m] in the frame of their scanner, from whose origin they were seen
 * \param[in] num_threads 0: one per core; never changes the result
 * \throws BadArgument expected is no unit vector */
VerticalEstimate
estimateVerticalOfScan(const Points& measured,
                       const Eigen::Vector3d& expected = Eigen::Vector3d::UnitZ(),
                       unsigned int num_threads = 0);

/** \return a rotation that turns `up` to z, by the shortest way
 * \throws BadArgument up is no unit vector */
Eigen::Matrix3d
uprightRotation(const Eigen::Vector3d& up);

} // namespace pcl6d
