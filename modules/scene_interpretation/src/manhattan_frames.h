// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

/** \file Frames of exact directions (book 7.1.3). Internal to the module
 * scene_interpretation. */
namespace pcl6d::scene_interpretation {

/** \brief A plane and the sums of its points. */
struct FittedPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();    ///< about the centroid [m^2]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero(); ///< of the normal [rad^2]
  /// Information matrix [1 / rad^2], pseudo-inverse of the covariance: n^T information
  /// n is the cost of a normal n. Without errors of poses, the scatter over the
  /// variance of the noise
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  double area = 0;   ///< [m^2]
  double points = 0; ///< number of them
};

/** \brief The exact normal required of a plane. */
struct ExactDirection {
  enum class Kind { kFree, kUp, kAlong, kAcross };
  Kind kind = Kind::kFree;
  std::size_t frame = 0; ///< of kAlong and kAcross
};

/** \brief A vertical and headings orthogonal to it. */
struct DirectionFrames {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  std::vector<Eigen::Vector3d> headings;

  /** \return the direction; kind must not be kFree */
  Eigen::Vector3d
  normal(const ExactDirection& direction) const;
};

/** \brief Groups upright planes into frames of parallel and orthogonal planes, in
 * turns: the frame with the most area within `significance` standard deviations of one
 * plane.
 * \param[in,out] directions planes of kind kAlong are grouped; planes in `alone` get a
 * frame of their own */
DirectionFrames
gatherFrames(const std::vector<FittedPlane>& planes,
             const Eigen::Vector3d& up,
             double significance,
             const std::vector<bool>& alone,
             std::vector<ExactDirection>& directions);

/** \brief Turns frames to the minimum of the sum of n^T information n over the planes.
 * \param[in] keep_up only the headings change */
void
optimiseFrames(const std::vector<FittedPlane>& planes,
               const std::vector<ExactDirection>& directions,
               bool keep_up,
               DirectionFrames& frames);

} // namespace pcl6d::scene_interpretation
