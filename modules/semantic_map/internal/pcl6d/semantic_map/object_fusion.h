// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/semantic_map/semantic_map.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of fuseObjects(). */
struct FusionOptions {
  double min_overlap = 0.25; ///< intersection over union of two boxes; in (0, 1]
  double max_distance = 0.3; ///< [m] of objects without a box; > 0
  double gate = 22.458; ///< squared Mahalanobis distance of an outlier: 99.9 % of chi^2
                        ///< with 6 degrees of freedom; > 0
  double position_error = 0.05; ///< [m] standard deviation where it is unknown; > 0
  double angle_error = 0.1;     ///< [rad] standard deviation of rotations where it is
                                ///< unknown; > 0
  double min_position_error = 0.002; ///< [m] lower limit of the standard deviation; > 0
  double min_angle_error = 0.002;    ///< [rad] > 0
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief An object fused from observations of several scans. */
struct FusedObject {
  MapObject object;
  std::vector<std::size_t> observations; ///< indices of its observations, ascending
  std::vector<std::size_t>
      outliers; ///< indices of its observations with ignored poses, ascending
};

/** \brief Fuses the observations of each object.
 *
 * Observations of one class whose boxes overlap belong to one object, unless they are
 * from one scan: two chairs side by side stay two. Pairs are joined by falling overlap,
 * groups while their mean overlap is large enough. The pose is the mean on SE(3),
 * weighted by information: with e_i = (t_i - t, log(R_i R^T)) minimise sum_i e_i^T
 * C_i^-1 e_i over the observations within the gate, started at the observation in best
 * agreement with the others; covariance (sum C_i^-1)^-1. Observations of an object with
 * a symmetry are first turned to the equivalent heading nearest to the start. With
 * symmetry 0 the heading is that of the start, with the variance of an arbitrary angle.
 * \param[in] observations with the scans that they were found in
 * \return in the order of the first observation; best score, united scans and points,
 * box and class of the start; no covariance if the pitch is a right angle
 * \throws BadArgument an option is invalid; an observation without class, with a pose
 * that is not rigid, an invalid covariance (informationFault()), or a negative symmetry
 * \ingroup semantic_map */
std::vector<FusedObject>
fuseObjects(const std::vector<MapObject>& observations,
            const FusionOptions& options = {});

} // namespace pcl6d
