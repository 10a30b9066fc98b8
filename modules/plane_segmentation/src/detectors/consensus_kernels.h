// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "planes/plane_moments.h"

#include <pcl6d/plane_segmentation/consensus_points.h>

#include <cstddef>

namespace pcl6d::plane_segmentation {

/** \brief A plane normal . p = offset, relative to ConsensusPoints::origin(). */
struct LocalPlane {
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
  float offset = 0; ///< [m]
};

/** \brief Number of points in a run, small enough for the nearest cache. */
constexpr std::size_t kConsensusRun = 512;

/** \brief Computes the distances of points [begin, begin + size) to a plane, see
 * PlaneConsensusOptions::max_distance. \param[in] size <= kConsensusRun
 * \param[out] distances size values, >= 0 */
void
consensusDistances(const ConsensusPoints& points,
                   std::size_t begin,
                   std::size_t size,
                   const LocalPlane& plane,
                   float* distances);

/** \return how many are below a limit */
std::size_t
countBelow(const float* distances, std::size_t size, float limit);

/** \return sum of 1 - (d / limit)^2 over distances below the limit */
double
gainBelow(const float* distances, std::size_t size, float limit);

/** \brief Writes the indices of points [begin, begin + size) with distances below the
 * limit. \param[out] places room for size + 1 values \return the number of indices */
std::size_t
placesBelow(const ConsensusPoints& points,
            std::size_t begin,
            std::size_t size,
            const float* distances,
            float limit,
            std::uint32_t* places);

/** \return sums over points [begin, begin + size) with distances below the limit,
 * relative to ConsensusPoints::origin() */
PlaneMoments
momentsBelow(const ConsensusPoints& points,
             std::size_t begin,
             std::size_t size,
             const float* distances,
             float limit);

} // namespace pcl6d::plane_segmentation
