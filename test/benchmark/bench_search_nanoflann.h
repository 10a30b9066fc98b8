// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "peer_ratio.h"

#include <cstddef>

namespace pcl6d::benchmarks {

/** \brief Adds the cases of PointTree against nanoflann, 1 thread; none if the build did
 * not find its header (Debian: libnanoflann-dev). */
void
addNanoflannCases(std::size_t count);

} // namespace pcl6d::benchmarks
