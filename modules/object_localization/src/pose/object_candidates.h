// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/object_refinement.h"

/** \file Which of several poses are objects. Internal to the module. */
namespace pcl6d::object_localization {

/** \return the share of the facing surface that is seen, less for what contradicts */
double
scoreOf(const PoseCheck& check);

/** \return 1 if all that faces the scanner and was measured is seen, and nothing speaks
 * against a pose; 0 if all does */
double
trust(const PoseCheck& check);

/** \return how much of the scan a pose explains, less for what speaks against it; the
 * trust alone would prefer poses that show the scanner a small face */
double
explanation(const PoseCheck& check);

/** \brief Leaves out those that explain what a better one explains.
 * \param[in] max_shared of the weaker one's support \return best first */
std::vector<ObjectCandidate>
strongest(std::vector<ObjectCandidate> candidates, double max_shared);

} // namespace pcl6d::object_localization
