// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "height_cut.h"

namespace pcl6d {

/** \brief The map's points as they are drawn. */
struct DrawnPoints {
  std::vector<Eigen::Vector3f> pixels; ///< column, row, layer in [0, 1] by height
  std::vector<Colour> colours;
  double size = 1; ///< [px]
};

/** \return the colour of a share of the colour range; low heights are near the colour
 * of the background, so that walls stand out */
Colour
pointColour(double share, const TopViewOptions& options);

/** \brief Places, thins and colours the shown points.
 * \param[in,out] layout gets the range of the colours and the number of points */
DrawnPoints
drawnPoints(const TopViewScene& scene,
            const ShownPoints& shown,
            const TopViewOptions& options,
            TopViewLayout& layout);

} // namespace pcl6d
