// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/registration/reduced_scans.h>

/** \file Constants shared by several files of the module, with the source of each. */
namespace pcl6d::global_registration {

/** Surfaces are level up to 37 deg: cosine (share/doc/place_recognition.md). */
constexpr double kLevel = 0.8;

/** Violated shares that divide the score of a pose by e: of starting poses, up to a cell off;
 * of matched poses; and of tested poses. There right poses have shares of 0.001 to 0.004,
 * wrong poses 0.02 to 0.13 (medians of recorded and simulated sets). The best of several poses
 * hardly depends on them: bench_places finds 1 of 25 more with 0.05 than with 0.2. */
constexpr double kContradictedStart = 0.05, kContradictedMatch = 0.02,
                 kContradictedPlace = 0.01;

/** [voxels] Points of matched scans meet a surface within the distance of the pairs of
 * matching; and the standard deviation of a matched pose. */
constexpr double kMetVoxels = kPlanePairVoxels, kPlaceVoxels = 0.5;

/** Two poses are different from this number of cells, or turn [rad], on. */
constexpr double kOtherCells = 1.5, kOtherTurn = 0.15;

/** Least overlap of a pose: walls of any two rooms reach nearly as much by chance. The right
 * pairs accepted in bench_places have 0.1 and more. */
constexpr double kLeastOverlap = 0.1;

} // namespace pcl6d::global_registration
