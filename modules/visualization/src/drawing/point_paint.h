// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visualization/map_cloud.h>

#include <array>
#include <functional>
#include <optional>
#include <utility>

namespace pcl6d::visualization {

/** \brief How the colours of points are chosen. */
struct PaintRule {
  PointColour colour = PointColour::kHeight;
  std::optional<ColourMap> map; ///< by default a map suited to the colour
  Background background = Background::kDark;
  /** values at the ends; by default from the points */
  std::optional<std::array<double, 2>> range = {};
};

/** \brief Meaning of the colours. */
struct ColourScale {
  std::string title;       ///< with the unit; empty: no scale
  double lowest = 0;       ///< value at the lower end of the colours
  double highest = 0;      ///< value at the upper end
  bool is_integer = false; ///< values are whole numbers
  std::function<Colour(double share)> colourOf;
  std::vector<std::pair<std::string, Colour>> keys; ///< of names in place of a range
};

struct PointPaint {
  std::vector<Colour> colours; ///< of the chosen points, in their order
  ColourScale scale;
};

/** \param[in] indices of the drawn points; may be empty
 * \throws BadArgument as MapCloud::validate() */
PointPaint
paintPoints(const MapCloud& cloud,
            const std::vector<std::size_t>& indices,
            const PaintRule& rule);

} // namespace pcl6d::visualization
