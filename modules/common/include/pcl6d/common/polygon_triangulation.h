// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Cuts a flat polygon with holes into triangles by clipping its ears.
 *
 * Rings are lists of corners on a plane: outer ones counter-clockwise as seen from
 * where the normal points to, each followed by its holes, clockwise. Rings of fewer
 * than 3 corners, and holes without an outer ring, are left out. Of rings that cross
 * themselves or each other the triangles may overlap; there are always as many as for a
 * proper polygon. O(n^2) for n corners as a rule.
 * \return counter-clockwise triangles; indices count the corners of all rings in order
 * \note Source: G. H. Meisters, "Polygons have ears", American Mathematical Monthly
 * 82(6), 1975; holes are joined to their outer ring by a cut to a corner that they see.
 * \ingroup common */
std::vector<std::array<std::uint32_t, 3>>
triangulate(const std::vector<std::vector<Eigen::Vector3d>>& rings,
            const Eigen::Vector3d& normal);

} // namespace pcl6d
