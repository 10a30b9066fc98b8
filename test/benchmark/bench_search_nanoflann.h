// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "room_cloud.h"

#include <cstddef>

namespace pcl6d::benchmarks {

// Cases of PointTree against nanoflann, 1 and 2 threads; none if the build did not find
// its header (Debian: libnanoflann-dev).

/** \brief Build and nearest point. */
void
addNanoflannCases(std::size_t count,
                  Order order,
                  const std::vector<unsigned int>& thread_counts);

/** \brief Two nearest; 10 and 20 nearest of each point of the cloud itself, as normals
 * and covariances need them. */
void
addMoreNanoflannCases(std::size_t count);

} // namespace pcl6d::benchmarks
