// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "point_paint.h"

#include <pcl6d/visualization/top_view.h>

namespace pcl6d {

/** \brief The map's points as they are drawn. */
struct DrawnPoints {
  std::vector<Eigen::Vector3f> pixels; ///< column, row, layer in [0, 1] by height
  std::vector<Colour> colours;
  ColourScale scale;
  double size = 1; ///< [px]
};

/** \brief Places, thins and colours the shown points.
 * \param[in,out] layout gets the range of the colours and the number of points */
DrawnPoints
drawnPoints(const TopViewScene& scene,
            const ShownPoints& shown,
            const TopViewOptions& options,
            TopViewLayout& layout);

} // namespace pcl6d
