// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

/** \file The constants of verification, and where each comes from. "Fitted" ones were chosen
 * from what `bench_verification` (test/benchmark) prints of eight recorded and simulated
 * sets; share/doc/trust.md has the table, with sets that were not looked at before. */
namespace pcl6d::verification {

/** A scan whose rays contradict a larger share of its own points abstains. Scans with one
 * origin have 0 to 0.005, keyframes merged over half a metre up to 0.008. */
constexpr double kAbstainingShare = 0.05;

/** Patches are cubes of so many voxels: a few reduced points of one surface; and at least
 * as wide as so large a part of how far the surfaces are spread, so that a door that was
 * opened, or a car, makes few of them. */
constexpr double kPatchVoxels = 6, kPatchSpread = 0.15;

/** Things that may have walked on between two scans are no larger [m], by the diagonal of the box
 * about them, nor than the surfaces are spread: a person of 1.9 m with a stride and arms of 1 m, in
 * any direction of the axes. Cars are left out, as parked ones tell places apart. */
constexpr double kLargestThing = 2.5;

/** Surfaces of a right link are no farther apart, in voxels: wrong ones, which matching has
 * pulled together, must not hide what contradicts them. Pairs reach to 1.7 voxels. */
constexpr double kMostMisfit = 0.5;

/** So many points of a scan are looked at: enough for hundreds of patches. */
constexpr std::size_t kLookedAt = 4000;

/** So many points of each scan are paired, and so many steps let surfaces settle, within a
 * fifth of kResolution. A wrong place slides far to a better one, such as along a gallery, in
 * many small steps. */
constexpr std::size_t kPairedPoints = 1500;
constexpr int kSteps = 4, kMostSteps = 40;
constexpr double kSettled = 0.02; // [voxels]

/** At other places fewer do: an error is noticed or not, its size does not matter. */
constexpr std::size_t kProbedPoints = 400;
constexpr int kProbedSteps = 2;

/** Contradicted patches of a right link, as share: what things that move, glass and edges
 * give. Its mean is learned from the links of a run themselves, starting from this one with
 * the weight of a link. Fitted: means of the sets are 0.000 to 0.025. */
constexpr double kBackground = 0.006, kLeastBackground = 0.002;

/** Rays that contradict more of the surface even where scans fit best say nothing: a scanner of
 * 2002 in a corridor with glass (kurt3d) has 0.1. The better half of wrong links contradicts
 * still more, 0.28 on average, and no background is to be learned from them. */
constexpr double kMostBackground = 0.05, kNoBackground = 0.12;

/** How evenly links share the background: the sum of both parameters of a beta
 * distribution. Fitted: 40 to 200; small is careful with right links. */
constexpr double kBackgroundPrecision = 40;

/** Contradicted patches of a wrong link: parameters of a beta distribution of their share.
 * Fitted to other minima, folds and scans apart: mean 0.42, standard deviation 0.18. */
constexpr double kWrongFree = 2.75, kWrongConfirmed = 3.8;

/** Wrong places along even surfaces, such as a corridor's, contradict little: so large a share
 * of wrong links does, with a share of contradicted patches of a beta distribution of mean
 * 0.05. Fitted to 222 runs of eleven simulated
 * scenes, 56 of them with jumps and swapped scans, whose wrong cuts contradict 0.02 to 0.08
 * of the patches; the share decides how many right cuts are doubted (2 %). */
constexpr double kEvenShare = 0.015, kEvenFree = 1, kEvenConfirmed = 19;

/** How evenly right cuts share the background of the rest, as kBackgroundPrecision. */
constexpr double kCutPrecision = 80;

/** Surfaces of wrong links ask for twice as many standard deviations as those of right ones;
 * of links across a cut that adds up to so large a part, and a single one to no more than
 * three deviations do. Fitted with kEvenShare. */
constexpr double kCutSurfaces = 0.6, kMostCutSigmas = 3;

/** Parts of so many scans that follow each other are looked at, and all up to a scan. */
constexpr std::size_t kLongestPart = 40;
/** With fewer links nothing tells what right ones contradict here: a right pair of a lab
 * (rooms) has 3 %. */
constexpr std::size_t kLeastLinks = 4;

/** Odds of a wrong link before anything is looked at: one in ten. */
constexpr double kPriorOdds = 0.1;

/** Fewer patches say too little to tie scans: by chance the few of a wrong link are all
 * confirmed. So does a smaller share of confirmed points. Right links have 195 and more
 * patches and a share of 0.23 and more. */
constexpr std::size_t kLeastPatches = 30;
constexpr double kLeastConfirmation = 0.1;

/** A scan with fewer patches of its own cannot be verified. */
constexpr std::size_t kLeastOwnPatches = 12;

/** A link ties its scans if it is wrong with a smaller probability ... */
constexpr double kGoodBelow = 0.01;
/** ... and contradicts the map if it is wrong with a larger one. */
constexpr double kWrongAbove = 0.9;

/** Links are not told apart from right ones nearer than this share of a voxel, about a
 * third of what the reduction moves points by. */
constexpr double kResolution = 0.1;

/** Surfaces that would move a link by so many standard deviations say as much for it as
 * against it: up to 2.5 it is good, from 4.5 on wrong. Fitted: of 1130 right links of 14 sets
 * 0.5 % ask for 2 and more, and of shifts by 3 and more none for less than 2.6. */
constexpr double kLeavingSigmas = 3.3;

/** Of the error that all pairs of a link may share (SurfaceFitOptions::shared_error), poses that
 * many links hold have so much: less than the judgement of a single link must allow for. The
 * smallest of 0, 1/4, 1/2 and 1 that kept 95 % of the scans of each run within their bounds:
 * chosen on corridor (vlp16 and ouster, too), rooms and hku1; mine, multilevel and parking kept
 * them with 0 already. hku1 alone asks for it, with 92 % at 0. */
constexpr double kSharedByPoses = 0.25;

} // namespace pcl6d::verification
