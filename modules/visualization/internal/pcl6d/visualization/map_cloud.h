// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/visualization/image.h>

#include <cstdint>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Meaning of the colour of a map point. \ingroup visualization */
enum class PointColour {
  kHeight,      ///< z, from the 2 % to the 98 % quantile
  kScan,        ///< index of the scan, from first to last
  kReflectance, ///< from the 2 % to the 98 % quantile
  kResidual,    ///< distance to the points of other scans, from 0 to the 95 % quantile
  kLabel,       ///< the fixed colour of its label
  kPlain        ///< nothing: all are grey
};

/** \brief Colour maps for numbers; except for turbo, brightness changes evenly.
 * Sources: S. van der Walt, N. Smith, matplotlib, 2015 (viridis, magma); A. Mikhailov,
 * "Turbo, an improved rainbow colormap", 2019. */
enum class ColourMap { kViridis, kTurbo, kMagma, kGrey };

enum class Background { kDark, kLight };

/** \return the value called "height", "scan", "reflectance", "residual", "label",
 * "plain"
 * \throws BadArgument unknown name */
PointColour
pointColourFromName(const std::string& name);

/** \return the colour map called "viridis", "turbo", "magma" or "grey"
 * \throws BadArgument unknown name */
ColourMap
colourMapFromName(const std::string& name);

/** \return the background called "dark" or "light" \throws BadArgument unknown name */
Background
backgroundFromName(const std::string& name);

/** \brief Points of a map with known attributes. \ingroup visualization */
struct MapCloud {
  Points points;                     ///< in the world [m]; NaN is skipped
  std::vector<std::uint32_t> scans;  ///< index of each point's scan, or empty
  std::vector<float> reflectances;   ///< or empty; NaN: not known, grey
  std::vector<float> residuals;      ///< [m] or empty; NaN: not known, grey
  std::vector<std::uint32_t> labels; ///< indices into label_names, or empty
  std::vector<std::string> label_names;

  /** \throws BadArgument a list without one entry per point, a label without a name, or
   * an attribute missing for the colour */
  void
  validate(PointColour colour) const;
};

} // namespace pcl6d
