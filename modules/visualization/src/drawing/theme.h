// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visualization/map_cloud.h>

namespace pcl6d::visualization {

/** \brief The colours of everything but the points. */
struct Theme {
  Colour background; ///< also around lines over points
  Colour text;
  Colour plain;   ///< points without a colour of their own
  Colour initial; ///< poses before the run
  Colour final;   ///< poses after it
  Colour moved;   ///< dynamic points
};

inline Theme
themeOf(Background background)
{
  if (background == Background::kLight)
    return {{255, 255, 255},
            {40, 40, 40},
            {170, 174, 182},
            {240, 120, 20},
            {200, 0, 70},
            {230, 20, 20}};
  return {{12, 13, 18},
          {225, 225, 225},
          {92, 97, 108},
          {255, 130, 70},
          {255, 255, 255},
          {255, 42, 42}};
}

} // namespace pcl6d::visualization
