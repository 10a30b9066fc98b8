// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/visibility/ray_image.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The share of a scan's points whose rays would cross another surface of the scan, if
 * measured from the given origin. Rays end at the first surface: the share is near 0 for the true
 * origin, and large if the cloud is a cut-out in a common frame, with its origin outside of the
 * measured space.
 *
 * At a sample of 1000 points the nearest 32 directions are compared. A neighbour is on the point's
 * own surface if its range differs by at most three times the width of the neighbourhood (a
 * surface hit at up to 72 deg). A ray crosses a surface if neighbours on a nearer surface lie in
 * all four quadrants around the ray, at least half as many as on the point's own surface; at the
 * edge of an object they lie on one side. Points without neighbours of their own surface in all
 * four quadrants, e.g. on single lines, do not count.
 * \param[in] measured points [m], at most about 60000 of which, evenly chosen, are used
 * \param[in] origin [m] of the rays, in the frame of the points
 * \return in [0, 1]; 0 if no point counts \ingroup visibility */
double
crossedShare(const Points& measured, const Eigen::Vector3f& origin);

/** \return whether an origin can be the position of the scanner: at most a tenth of the rays cross
 * another surface of the scan; see crossedShare() */
bool
isPlausibleOrigin(const Points& measured,
                  const Eigen::Vector3f& origin = Eigen::Vector3f::Zero());

/** \return the rays of a scan from options.origin; for an implausible origin an image without rays,
 * in which every point is unseen
 * \throws BadArgument an option is invalid */
RayImage
plausibleRays(const Points& measured, const RayImageOptions& options = {});

} // namespace pcl6d
