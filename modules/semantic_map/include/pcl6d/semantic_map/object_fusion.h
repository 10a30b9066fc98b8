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
  double max_distance = 0.3; ///< [m] of objects whose box is not known; > 0
  double gate = 22.458; ///< squared Mahalanobis distance of an outlier: 99.9 % of chi^2
                        ///< with 6 degrees of freedom; > 0
  double position_error = 0.05; ///< [m] standard deviation where it is not known; > 0
  double angle_error = 0.1;     ///< [rad] the same of rotations; > 0
  double min_position_error = 0.002; ///< [m] nothing is more exact; > 0
  double min_angle_error = 0.002;    ///< [rad] > 0
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief An object that several scans saw. */
struct FusedObject {
  MapObject object;
  std::vector<std::size_t> observations; ///< places of those it was made of, ascending
  std::vector<std::size_t>
      outliers; ///< those of them whose poses do not count, ascending
};

/** \brief Makes one object of all observations of it.
 *
 * Observations of one class whose boxes overlap are the same object, those of the same
 * scan never are: two chairs side by side stay two. Pairs are joined by falling overlap,
 * groups as long as their mean overlap is large enough. The pose is the
 * mean on SE(3), weighted by information: with
 * e_i = (t_i - t, log(R_i R^T)) minimise sum_i e_i^T C_i^-1 e_i over the observations within
 * the gate, started at the observation that most agree with; covariance (sum C_i^-1)^-1.
 * Observations of an object with a symmetry are first turned to the equivalent heading
 * nearest to that observation's. With symmetry 0 the heading is that of the start, and its
 * variance that of any angle.
 * \param[in] observations each with the scans that it was found in
 * \return by the first observation; score: the best, scans and points: all, box and class:
 * of the start; covariance none if the pitch is a right angle
 * \throws BadArgument an option breaks its rule; an observation without class, with a pose
 * that is not rigid, a covariance that is none (informationFault()), or a negative
 * symmetry \ingroup semantic_map */
std::vector<FusedObject>
fuseObjects(const std::vector<MapObject>& observations,
            const FusionOptions& options = {});

} // namespace pcl6d
