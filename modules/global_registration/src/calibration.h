// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file Constants that several files of the module share, and where each comes from. */
namespace pcl6d::global_registration {

/** Surfaces are level up to 37 deg: cosine (algorithms.md G.4). */
constexpr double kLevel = 0.8;

/** A contradicted share that counts e times as much against a place. Of starts, which lie up
 * to a cell off; of matched places; and of judged ones: there 0.001 to 0.004 of right ones is
 * contradicted, of wrong ones 0.02 to 0.13 (algorithms.md G.4). Which of several places is the
 * best changes little with them: bench_places finds 1 of 25 more with 0.05 than with 0.2. */
constexpr double kContradictedStart = 0.05, kContradictedMatch = 0.02,
                 kContradictedPlace = 0.01;

/** [voxels] Points of matched scans meet a surface within it, as those that matching pairs;
 * and the standard deviation of a matched place. */
constexpr double kMetVoxels = 1.7, kPlaceVoxels = 0.5;

/** Places are others from so many cells, or so large a turn [rad], on. */
constexpr double kOtherCells = 1.5, kOtherTurn = 0.15;

/** A place where fewer surfaces meet is no place: walls of any two rooms do so much by chance.
 * Of bench_places' pairs the right ones accepted have 0.1 and more. */
constexpr double kLeastOverlap = 0.1;

} // namespace pcl6d::global_registration
