// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/filters/point_normals.h>

#include <Eigen/Core>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Up direction of a scan from its surfaces alone: floors and ceilings are level; walls,
 * poles and trunks upright. */
struct VerticalEstimate {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ(); ///< unit vector, in the normals' frame
  double share = 0;     ///< share of normals that are level or upright, in [0, 1]
  bool is_sure = false; ///< the surfaces alone exclude every other direction
  /** alternative directions, unit vectors, with nearly as many level or upright normals, as the
   * three axes of a bare room; either end of each may be up. Best first */
  std::vector<Eigen::Vector3d> others;
};

/** \brief Finds the vertical of a scan.
 *
 * The score of a direction is the share of normals within 5 deg of the direction or of the
 * plane across. Candidates are the normals, the cross products of two normals, and the expected
 * direction; the best are refined by least squares. Among directions of equal score, the
 * nearest to the expected direction is up.
 * \param[in] normals unit vectors; zero normals are skipped
 * \param[in] expected unit vector, the sensor's own up: tells up from down, and decides where
 * the surfaces do not
 * \return the expected direction, not sure, without normals or where no direction is better
 * than chance
 * \throws BadArgument expected is no unit vector
 * \note Source: share/doc/place_recognition.md, Vertical
 * \ingroup global_registration */
VerticalEstimate
estimateVertical(const Normals& normals,
                 const Eigen::Vector3d& expected = Eigen::Vector3d::UnitZ());

/** \brief estimateVertical() from measured points: their range gate and reduction follow from
 * the points (deriveScanParameters()), and the normals from the reduced points.
 * \param[in] measured [m] in the frame of their scanner, which stands at the origin
 * \param[in] num_threads 0: a thread per core; never changes the result
 * \throws BadArgument expected is no unit vector */
VerticalEstimate
estimateVerticalOfScan(const Points& measured,
                       const Eigen::Vector3d& expected = Eigen::Vector3d::UnitZ(),
                       unsigned int num_threads = 0);

/** \return the shortest rotation that turns `up` to z
 * \throws BadArgument up is no unit vector */
Eigen::Matrix3d
uprightRotation(const Eigen::Vector3d& up);

} // namespace pcl6d
