// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

/** \file The constants of verification, with their sources. "Fitted" constants were chosen by the
 * results of `bench_verification` (test/benchmark) on eight recorded and simulated sets; the table
 * in share/doc/trust.md also has sets not used for fitting. */
namespace pcl6d::verification {

/** Largest share of a scan's own points that its rays may contradict; above, the rays are unusable.
 * Scans with one origin have 0 to 0.005, keyframes merged over half a metre up to 0.008. */
constexpr double kAbstainingShare = 0.05;

/** Edge of a patch [voxels]: a few reduced points of a surface; and its smallest share of the
 * surfaces' spread, which limits the number of patches of an opened door or a car. */
constexpr double kPatchVoxels = 6, kPatchSpread = 0.15;

/** Largest diagonal [m] of the bounding box of an object that may have walked on between two scans,
 * also limited by the surfaces' spread: a person of 1.9 m with a stride and arms of 1 m, in any
 * direction of the axes. Cars are excluded, because parked cars distinguish places. */
constexpr double kLargestThing = 2.5;

/** Largest surface residual of a right link [voxels]. A larger tolerance would hide the
 * contradictions of wrong links, whose surfaces were pulled together by matching. Pairs reach to
 * kPlanePairVoxels. */
constexpr double kMostMisfit = 0.5;

/** Number of tested points of a scan: enough for hundreds of patches. */
constexpr std::size_t kLookedAt = 4000;

/** Number of paired points of each scan, and number of steps until surfaces settle, within a fifth
 * of kResolution. From a wrong pose, surfaces slide far to a better pose, e.g. along a gallery, in
 * many small steps. */
constexpr std::size_t kPairedPoints = 1500;
constexpr int kSteps = 4, kMostSteps = 40;
constexpr double kSettled = 0.02; // [voxels]

/** Smaller numbers for displaced poses: an error is detected or not, its size is irrelevant. */
constexpr std::size_t kProbedPoints = 400;
constexpr int kProbedSteps = 2;

/** Share of contradicted patches in a right link, caused by dynamic objects, glass and edges. The
 * mean is estimated from the links of a run, starting from kBackground with the weight of a link.
 * Fitted: means of the sets were 0.000 to 0.025, 0.006 in the middle, with rays along a surface;
 * without these right links have half to two thirds (0.65 to 0.33 %, 1.2 to 0.45 %; rooms, a pair of
 * a lab, 3.0 to 2.3 %). Of sixteen simulated scanners 14 have at most 0.001, pandar and tof 0.004
 * and 0.007: the links of the run decide. */
constexpr double kBackground = 0.004, kLeastBackground = 0.002;

/** Background above which ray tests are inconclusive: a scanner of 2002 in a corridor with glass
 * (kurt3d) has 0.056, matched by worse means 0.08 to 0.1. The better half of wrong links has still
 * more, 0.25 on average, and is unusable for estimating the background. */
constexpr double kMostBackground = 0.05, kNoBackground = 0.12;

/** How evenly links share the background: the sum of both parameters of a beta
 * distribution. Fitted: 40 to 200; small is careful with right links. */
constexpr double kBackgroundPrecision = 40;

/** Contradicted patches of a wrong link: parameters of a beta distribution of their share. Fitted
 * to other minima, folds and disjoint scans: mean 0.42, standard deviation 0.18. Fitted to fifteen of
 * sixteen simulated scanners: beta(1.4 to 1.6, 2.4 to 2.7), with which one of five wrong poses more is
 * found, and 16 of 862 good right links become weak: not taken. */
constexpr double kWrongFree = 2.75, kWrongConfirmed = 3.8;

/** Wrong poses along even surfaces, e.g. in a corridor, have few contradictions: share of these
 * poses among wrong links, and a beta distribution of their contradicted patches with mean 0.05.
 * Fitted to 222 runs of eleven simulated scenes, 56 of them with jumps and swapped scans, whose
 * wrong cuts contradict 0.02 to 0.08 of the patches; the share determines how many right cuts are
 * doubted (2 %). */
constexpr double kEvenShare = 0.015, kEvenFree = 1, kEvenConfirmed = 19;

/** Precision of the background in right cuts, like kBackgroundPrecision, and the least background:
 * cuts count the contradictions of many links together, where rays that graze a surface no longer
 * count. Fitted to 170 maps (eleven scenes, fourteen damages; sixteen sensors): of the cuts at wrong
 * places 19 are found, with 0.002 it was 8, and one more right map is cut, whose scans hardly
 * overlap. All constants of cuts, fitted to all sensors except one and tested with that sensor (363
 * runs, seventeen sensors, share/doc/trust.md), miss 5 of 25 wrong places and cut 11 right maps; the
 * constants in use miss 4 and cut 4, with refined parts 3 and 4: kept. */
constexpr double kCutPrecision = 80, kLeastCutBackground = 0.0005;

/** Weight [patches] of the rest of the map in the background of a link across a cut, beside the
 * other links of its two scans: a small link. From 12 to 200 the same maps are cut. */
constexpr double kRestPatches = 100;

/** Weight of the surface evidence of links across a cut, and the largest shift that counts for a
 * link, in standard deviations. Surfaces of wrong links require twice as many standard deviations
 * as surfaces of right links. Fitted with kEvenShare; 0.4 to 0.8 cut the same number of maps. */
constexpr double kCutSurfaces = 0.6, kMostCutSigmas = 3;

/** Longest tested part of consecutive scans; parts from the first scan on have any length. */
constexpr std::size_t kLongestPart = 40;
/** With fewer links, the background of right links is unknown: a right pair of a lab (rooms) has 3
 * %. */
constexpr std::size_t kLeastLinks = 4;

/** Prior odds of a wrong link: one in ten. */
constexpr double kPriorOdds = 0.1;

/** Fewer patches are insufficient to connect scans: by chance, all patches of a wrong link may be
 * confirmed. A smaller share of confirmed points is insufficient, too. Right links have 195 and
 * more patches and a share of 0.23 and more. */
constexpr std::size_t kLeastPatches = 30;
constexpr double kLeastConfirmation = 0.1;

/** A second pose is as good with this share of the confirmed surface, or more. */
constexpr double kTwinShare = 0.5;

/** Least number of a scan's own patches for verification. */
constexpr std::size_t kLeastOwnPatches = 12;

/** A link connects its scans below kGoodBelow (ties.h), and contradicts the map above this
 * probability of being wrong. */
constexpr double kWrongAbove = 0.9;

/** Resolution of link tests [voxels], about a third of the shift of points by the reduction. */
constexpr double kResolution = 0.1;

/** Shift required by surfaces, in standard deviations, that is neutral evidence: up to 2.5 a link
 * is consistent, from 4.5 on inconsistent. Fitted: of 1130 right links of 14 sets 0.5 % have 2 and
 * more; no link shifted by 3 and more has less than 2.6. With one of sixteen scanners left out, 0.5 %
 * of the right links of the others have 1.3 to 1.5 and more; 2 of the 924 right links exceed 2.5. */
constexpr double kLeavingSigmas = 3.3;

} // namespace pcl6d::verification
