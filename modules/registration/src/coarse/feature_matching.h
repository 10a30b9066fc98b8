// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "coarse/fpfh.h"

#include <vector>

namespace pcl6d::registration {

/** \brief A point of the source and a point of the target with similar features. */
struct FeatureMatch {
  int source = -1;
  int target = -1;
};

/** \brief The pairs of mutually most similar points, by exact search.
 * \param[in] max_matches keep the most distinctive: with the second most similar point
 * much less similar (Lowe's ratio)
 * \return most distinctive first, ties by source */
std::vector<FeatureMatch>
matchFeatures(const std::vector<Fpfh>& target,
              const std::vector<Fpfh>& source,
              std::size_t max_matches,
              unsigned int num_threads);

} // namespace pcl6d::registration
