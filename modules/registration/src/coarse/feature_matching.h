// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "coarse/fpfh.h"

#include <vector>

namespace pcl6d::registration {

/** \brief A point of the source and one of the target that look alike. */
struct FeatureMatch {
  int source = -1;
  int target = -1;
};

/** \brief The points that are each other's most similar one, by exact search.
 * \param[in] max_matches keep those that are most distinctive: the second most similar
 * point is much less so (Lowe's ratio)
 * \return most distinctive first, ties by source */
std::vector<FeatureMatch>
matchFeatures(const std::vector<Fpfh>& target,
              const std::vector<Fpfh>& source,
              std::size_t max_matches,
              unsigned int num_threads);

} // namespace pcl6d::registration
