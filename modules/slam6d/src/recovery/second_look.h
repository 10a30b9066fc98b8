// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/slam6d/slam6d_result.h>

#include <cstddef>
#include <vector>

/** \file Handling of a map with disconnected components. */
namespace pcl6d::slam6d {

/** \return whether consistent links fail to connect all matched scans, although consistent links
 * exist: a map of two components, with a wrong match between them */
bool
hasDisconnected(const Slam6DResult& result);

/** \return whether more scans would be disconnected from the map than remain: recovering them costs
 * about as much as the run did \param[in] keeps number of first scans left unchanged */
PCL6D_EXPORTS bool // exported for its test
isMostlyDisconnected(std::size_t keeps, const Slam6DResult& result);

/** \brief Marks the scans disconnected from the first scan as lost.
 * \param[in] keeps number of first scans left unchanged: scans of an earlier run */
void
disconnect(std::size_t keeps, Slam6DResult& result);

/** \brief Marks the scans of pieces beside the map as lost: their place is that of the odometry, and
 * further scans must not be matched with them. */
void
disconnectPieces(Slam6DResult& result);

/** \return the number of registered scans connected by the verification */
std::size_t
countConnected(const Slam6DResult& result);

/** \return whether more scans are connected than before
 * \param[in] connected for each scan; before the verification whether it is registered, as no other
 * can be connected */
bool
isBetterConnected(const std::vector<bool>& connected, std::size_t before);

/** \return whether a search found the scan after matching had failed, and the verification neither
 * connects it nor has a consistent link of it */
bool
isUnconfirmed(const Slam6DResult& result, std::size_t scan);

/** \brief Returns unconfirmed scans, and lost scans directly behind them, to where the given poses
 * lead from the scan before; their links are refused. One wrong place would take the lost scans
 * along. \param[in] keeps number of first scans left unchanged
 * \return whether a scan has moved; never without given poses or verification */
PCL6D_EXPORTS bool // exported for its test
returnUnconfirmed(std::size_t keeps, Slam6DResult& result);

/** \brief Takes the pose of a scan over into the graph and into the last poses of each stage. */
void
takeFinalPose(std::size_t scan, Slam6DResult& result);

/** \brief Restores the matched poses of scans that were never lost. */
void
keepMatchedPoses(const Slam6DResult& before, Slam6DResult& now);

} // namespace pcl6d::slam6d
