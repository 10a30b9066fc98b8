// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/visualization/image.h>

#include <cstdint>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What the colour of a map point tells. \ingroup visualization */
enum class PointColour {
  kHeight,      ///< z, from its 2 % to its 98 % quantile
  kScan,        ///< index of the scan, from first to last
  kReflectance, ///< from its 2 % to its 98 % quantile
  kResidual,    ///< distance to what other scans measured, from 0 to its 95 % quantile
  kLabel,       ///< the fixed colour of its label
  kPlain        ///< nothing: all are grey
};

/** \brief Colours for numbers, all evenly changing in brightness but turbo.
 * Sources: S. van der Walt, N. Smith, matplotlib, 2015 (viridis, magma); A. Mikhailov,
 * "Turbo, an improved rainbow colormap", 2019. */
enum class ColourMap { kViridis, kTurbo, kMagma, kGrey };

enum class Background { kDark, kLight };

/** \return the value called "height", "scan", "reflectance", "residual", "label", "plain"
 * \throws BadArgument there is none of that name */
PointColour
pointColourFromName(const std::string& name);

/** \return the colours called "viridis", "turbo", "magma" or "grey"
 * \throws BadArgument there are none of that name */
ColourMap
colourMapFromName(const std::string& name);

/** \return the background called "dark" or "light" \throws BadArgument no such one */
Background
backgroundFromName(const std::string& name);

/** \brief Points of a map and what is known of each. \ingroup visualization */
struct MapCloud {
  Points points;                     ///< in the world [m]; NaN is skipped
  std::vector<std::uint32_t> scans;  ///< index of each point's scan, or empty
  std::vector<float> reflectances;   ///< or empty; NaN: not known, grey
  std::vector<float> residuals;      ///< [m] or empty; NaN: not known, grey
  std::vector<std::uint32_t> labels; ///< places in label_names, or empty
  std::vector<std::string> label_names;

  /** \throws BadArgument a list has not one entry per point, a label has no name, or
   * what the colour tells is not known */
  void
  validate(PointColour colour) const;
};

} // namespace pcl6d
