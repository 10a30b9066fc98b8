// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/object_refinement.h"

/** \file Selects the poses of objects from candidates. Internal to the module. */
namespace pcl6d::object_localization {

/** \return the visible fraction, times (1 - free-space violation) */
double
scoreOf(const PoseCheck& check);

/** \return 1 if every measured facing element is supported without contradiction; 0 if
 * no element is supported */
double
trust(const PoseCheck& check);

/** \return supporting elements times trust; trust alone would prefer poses with a small
 * side towards the scanner */
double
explanation(const PoseCheck& check);

/** \brief Drops candidates that explain the surface of a better one.
 * \param[in] max_shared share of the weaker candidate's support \return best first */
std::vector<ObjectCandidate>
strongest(std::vector<ObjectCandidate> candidates, double max_shared);

} // namespace pcl6d::object_localization
