// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>

#include <cstddef>
#include <vector>

namespace pcl6d::visibility {

/** \brief Numbers of isolated objects among contradicted points. */
struct StandingThings {
  std::size_t things = 0;
  std::size_t patches = 0; ///< of isolated objects
};

/** \brief Finds isolated objects: connected contradicted points, no larger than the given size,
 * with fewer than half of the conclusive points around confirmed. The rules are those of the
 * search for dynamic objects (moving_objects): a surface that continues in seen space is no
 * isolated object.
 * \param[in] patches contradicted patches, each with the indices of its points in `free`
 * \param[in] reach [m] largest distance of connected points; > 0
 * \param[in] largest [m] diagonal of an object's bounding box */
StandingThings
standingThings(const Points& free,
               const Points& confirmed,
               const std::vector<std::vector<std::size_t>>& patches,
               double reach,
               double largest);

} // namespace pcl6d::visibility
