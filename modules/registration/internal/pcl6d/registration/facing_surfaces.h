// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/registration/twist.h>

#include <cmath>
#include <cstddef>

/** \file Surfaces that fix a motion, however few they are. Sampled evenly, a floor that is 1 % of the
 * points is hidden by the errors of the normals of all other surfaces.
 * \note Source: S. Rusinkiewicz, M. Levoy, "Efficient variants of the ICP algorithm", 3DIM 2001,
 * normal-space sampling; N. Gelfand et al., "Geometrically stable sampling for the ICP algorithm",
 * 3DIM 2003 */
namespace pcl6d {

/** Cosine between a motion and a normal from which a surface fixes the motion: 45 degrees. Errors of
 * normals are a few degrees (T. Tuna, J. Nubert et al., "X-ICP: localizability-aware LiDAR
 * registration for robust localization in extreme environments", T-RO 2023: strong contributions). */
inline constexpr double kFacing = 0.7071;

/** Least motion of a place [m], for a motion of all pairs by 1 m (rms): nearer to the axis of a
 * turn a surface does not fix the turn. */
inline constexpr double kLeastLever = 0.3;

/** Least pairs and cubes of facing surfaces: two pairs for each direction, and as many cubes, whose
 * errors are independent, as directions. Errors of normals feign up to 6 pairs in 2 cubes in
 * simulated tunnels; links of rooms whose floors give 1 % of the pairs have 4 to 26 cubes. */
inline constexpr std::size_t kLeastFacing = 12, kLeastFacingCubes = 6;

/** Motions of a scan: each gets an equal share of the pairs. */
inline constexpr std::size_t kMotions = 6;

/** \brief A motion of the second scan, in the frame of the first. */
struct OpenMotion {
  Twist twist;
  Eigen::Vector3d centroid; ///< [m] of the turn

  /** \return whether a surface fixes the motion */
  bool
  isFixedBy(const Eigen::Vector3d& place, const Eigen::Vector3d& normal) const
  {
    const Eigen::Vector3d motion =
        twist.head<3>() + Eigen::Vector3d(twist.tail<3>()).cross(place - centroid);
    const double size = motion.norm();
    return size > kLeastLever && std::abs(normal.dot(motion)) > kFacing * size;
  }
};

/** \return how often each pair of facing surfaces counts, to give these pairs the share of a
 * motion */
inline std::size_t
copiesOfFacing(std::size_t facing, std::size_t evenly)
{
  return evenly > kMotions * facing ? evenly / (kMotions * facing) : 1;
}

} // namespace pcl6d
