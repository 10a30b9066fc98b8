// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "detectors/hough_votes.h"
#include "detectors/plane_support.h"

#include <pcl6d/plane_segmentation/plane_hough.h>

/** \file
 * Common parts of the Hough variants, and the variants in which a point votes for every
 * plane through it; see houghCandidates(). */
namespace pcl6d::plane_segmentation {

constexpr int kHoughWindow = 4; ///< steps on each side of a peak

/** \return a search in a cloud, without planes taken yet */
PlaneSearch
makeHoughSearch(const PlaneCloud& cloud, const HoughPlaneOptions& options);

/** \return the patch of a peak of the votes; without slots: no plane */
Support
supportOfPeak(const PlaneSearch& search,
              const AccumulatorBall& ball,
              const HoughCell& peak,
              double offset_cell);

/** \brief The standard, probabilistic and adaptive variants: votes are counted, then
 * peaks are taken. */
PlaneCandidates
fullHough(const PlaneCloud& cloud, const HoughPlaneOptions& options);

/** \brief The progressive variant: peaks are taken while votes are counted. */
PlaneCandidates
progressiveHough(const PlaneCloud& cloud, const HoughPlaneOptions& options);

} // namespace pcl6d::plane_segmentation
