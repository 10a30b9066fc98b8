// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/global_registration/placeable_scan.h>

#include <vector>

namespace pcl6d::global_registration {

/** \brief Place descriptor: the L1 distance is small between scans from nearby positions, at
 * any heading. */
using PlaceDescriptor = std::vector<double>;

/** \brief Describes a scan by three histograms, each with the sum 1: the distances between its
 * upright surfaces and the angles between their normals; the distances of upright surfaces from
 * the scanner and their angles to the direction of sight; the heights of every surface. The
 * first does not depend on the position of the scanner, and no histogram depends on its heading.
 * \param[in] reach [m] the unit of lengths, equal for the whole drive; > 0
 * \note Source: shape distributions (R. Osada et al., "Shape distributions", ACM ToG 2002) and
 * rings about the scanner (G. Kim, A. Kim, "Scan Context", IROS 2018), here of surfaces */
PlaceDescriptor
describePlace(const PlaceableScan& scan, double reach);

/** \return the sum of the differences, in [0, 6] */
double
distanceOf(const PlaceDescriptor& a, const PlaceDescriptor& b);

} // namespace pcl6d::global_registration
