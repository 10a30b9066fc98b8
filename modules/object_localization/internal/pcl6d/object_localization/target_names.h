// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/control_points.h>
#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/scan_targets.h>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Names of the targets of a scan. */
struct TargetNames {
  std::vector<std::string> names; ///< per target; empty: no control point fits
  std::string
      doubt; ///< why the targets have no names, such as two equally good assignments;
             ///< else empty
};

/** \brief Names targets by the distances between them: the largest set of targets and
 * control points with equal distances, mirror images excluded.
 *
 * Two distances are equal if they differ by at most three standard deviations, from the
 * sigmas of targets and control points, or by 2 mm. A set needs three targets that are
 * not on a line. If another set of equal size names a target differently, the names are
 * ambiguous and left empty.
 * \param[in] default_sigma [m] of control points without a sigma
 * \note Congruent subsets, as maximal cliques: C. Bron, J. Kerbosch, "Finding all
 * cliques of an undirected graph", Communications of the ACM 16(9), 1973
 * \ingroup object_localization */
TargetNames
namesByDistances(const std::vector<FoundTarget>& targets,
                 const std::vector<ControlPoint>& control,
                 double default_sigma = 0.002);

} // namespace pcl6d
