// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sight_votes.h"
#include "tested_positions.h"

#include <cstddef>
#include <cstdint>
#include <vector>

/** \file Clusters of thin things, such as poles and the boards of a shelf. The rays of a scan that
 * met a thing prove its width only where no ray beside them passed it. */
namespace pcl6d::moving_objects {

/** Weight of a hit in misses: rays may pass beside thin objects, but never end in empty space. */
constexpr int kHitInMisses = 2;

/** Least misses minus twice the hits of a dynamic cluster: two scans saw through four places
 * each, the least number of points in a patch of sightEvidence(). Fewer may be chance. */
constexpr int kLeastMisses = 8;

/** \return whether enough places of a cluster are inside of a surface: of the rays of the own scan in
 * the cells around such a place, none ended behind the surface. At least four places, and one in
 * eight: of many places on glass, some are surrounded by chance */
bool
hasSolidPart(const TestedPositions& observed,
             const RayImage& own,
             const std::vector<std::size_t>& cluster);

/** \return whether rays of the own scan passed between the places of a cluster, at least as many as
 * met it: boards, branches, glass. A ray passed if it ended farther behind the nearest place of the
 * cluster than one surface explains */
bool
isPorous(const TestedPositions& observed, const std::vector<std::size_t>& cluster);

/** \return whether other scans hit a cluster, at as many places as a dynamic cluster needs misses.
 * Scans that missed more places than they hit do not count */
bool
isHitByOthers(const ObserverVotes& votes, const std::vector<std::size_t>& cluster);

/** \return the scans that cannot pass beside a thin thing, because their rays are at most as far
 * apart there as those of a scan that hit most of it, the own scan included; a bit for each observer.
 * The rays of a porous thing must also meet it at least as steeply: glass returns light to a scanner
 * right ahead, and lets flat rays pass or mirrors them away */
std::uint16_t
observersAsFine(const TestedPositions& observed,
                const ObserverVotes& votes,
                const std::vector<std::size_t>& cluster);

} // namespace pcl6d::moving_objects
