// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "detectors/hough_votes.h"
#include "detectors/plane_support.h"

#include <pcl6d/plane_segmentation/plane_hough.h>

/** \file
 * What the variants of the Hough transform share, and those in which a point votes for
 * all planes through it; see houghCandidates(). */
namespace pcl6d::plane_segmentation {

constexpr int kHoughWindow = 4; ///< steps on each side of a peak

/** \return a search in a cloud with nothing taken yet */
PlaneSearch
makeHoughSearch(const PlaneCloud& cloud, const HoughPlaneOptions& options);

/** \return the patch that a peak of the votes is of; no slots: it is of none */
Support
supportOfPeak(const PlaneSearch& search,
              const AccumulatorBall& ball,
              const HoughCell& peak,
              double offset_cell);

/** \brief The standard, probabilistic and adaptive variants: all votes are counted, then
 * peaks are taken. */
PlaneCandidates
fullHough(const PlaneCloud& cloud, const HoughPlaneOptions& options);

/** \brief The progressive variant: peaks are taken while votes are counted. */
PlaneCandidates
progressiveHough(const PlaneCloud& cloud, const HoughPlaneOptions& options);

} // namespace pcl6d::plane_segmentation
