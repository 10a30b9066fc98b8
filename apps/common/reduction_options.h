// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/option_table.h"

namespace pcl6d::app {

/** \brief --min-range, --max-range, --voxel and --line-spacing, for all programs that reduce scans.
 * \param[out] parameters with the members min_range, max_range, voxel and
 * line_spacing, such as ScanParameterOptions */
template <typename Parameters>
void
addReductionOptions(OptionTable& table, Parameters& parameters)
{
  table.addAuto("min-range", &parameters.min_range)
      .help("[m] or auto: nearer points are dropped");
  table.addAuto("max-range", &parameters.max_range)
      .help("[m] or auto: farther points are dropped; auto drops no-return codes");
  table.addAuto("voxel", &parameters.voxel)
      .help("[m] or auto: edge length of the octree reduction");
  table.addAuto("line-spacing", &parameters.line_spacing)
      .help("[m] or auto: distance between the lines of a scan at its median range, "
            "such as the rings of a spinning lidar; without --voxel, a voxel spans 1.3 "
            "of it");
}

} // namespace pcl6d::app
