// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>

#include <cstddef>
#include <vector>

namespace pcl6d::visibility {

/** \brief Things that stand alone among contradicted points. */
struct StandingThings {
  std::size_t things = 0;
  std::size_t patches = 0; ///< that are parts of them
};

/** \brief Finds them: contradicted points that hang together, no larger than things are, around
 * which fewer than half of the points that say something are confirmed. As those who look for what
 * moved do it (moving_objects): a surface that goes on where it is seen is no thing.
 * \param[in] patches contradicted ones, each with its points as places in the list of free ones
 * \param[in] reach [m] within which points hang together; > 0
 * \param[in] largest [m] diagonal of the box about a thing */
StandingThings
standingThings(const Points& free,
               const Points& confirmed,
               const std::vector<std::vector<std::size_t>>& patches,
               double reach,
               double largest);

} // namespace pcl6d::visibility
