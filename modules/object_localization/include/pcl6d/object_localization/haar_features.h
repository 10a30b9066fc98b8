// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/integral_image.h>

#include <array>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A rectangle of a feature. A tilted one starts at its upper corner (x, y), from
 * which its width runs down to the right and its height down to the left, at 45 deg. */
struct HaarRect {
  ImageRect rect;
  float weight = 0; ///< of the sum over it; 0: no rectangle
};

/** \brief A weighted difference of sums over rectangles of a window. */
struct HaarFeature {
  std::array<HaarRect, 3> rects;
  bool tilted = false;
};

/** \brief Which features haarFeatures() makes. */
enum class HaarFeatureSet {
  kUpright, ///< edges, lines, centre-surround and diagonals
  kAll      ///< also the tilted edges, lines and centre-surrounds
};

/** \return the set called "upright" or "all" \throws BadArgument another name */
HaarFeatureSet
haarFeatureSetFromName(const std::string& name);

/** \return every feature of a window, at each place and size: edges of two rectangles,
 * lines of three and of four, centre-surround of nine and diagonals of four equal cells.
 * The weighted areas of each sum up to zero, so that it does not see how bright the window
 * is. Several 10^5 for 24 x 24 pixels.
 * \throws BadArgument the window is not 4 to 128 pixels wide and high
 * \note Source: Lienhart and Maydt, ICIP 2002. \ingroup object_localization */
std::vector<HaarFeature>
haarFeatures(int width, int height, HaarFeatureSet set = HaarFeatureSet::kAll);

/** \return whether its rectangles, at least two, lie in a window */
bool
fits(const HaarFeature& feature, int width, int height);

/** \brief Where a feature finds its sums, for one width of the tables. */
struct HaarOffsets {
  /** sum = t[0] - t[1] - t[2] + t[3], from the entry of the window's upper left corner */
  std::array<std::array<int, 4>, 3> corners{};
  std::array<float, 3> weights{};
  bool tilted = false;

  HaarOffsets() = default;
  /** \param[in] stride entries per row of the tables */
  HaarOffsets(const HaarFeature& feature, int stride);

  /** \brief The feature before normalisation, computed as cv::CascadeClassifier does, in
   * float. \param[in] window entry of the window's corner in the table that tilted names */
  float
  value(const std::uint32_t* window) const
  {
    float sum = weights[0] * rectSum(window, 0) + weights[1] * rectSum(window, 1);
    if (weights[2] != 0)
      sum += weights[2] * rectSum(window, 2);
    return sum;
  }

private:
  float
  rectSum(const std::uint32_t* window, std::size_t i) const
  {
    const auto& c = corners[i];
    return static_cast<float>(static_cast<std::int32_t>(window[c[0]] - window[c[1]] -
                                                        window[c[2]] + window[c[3]]));
  }
};

/** \brief How bright and contrasty a window is, by OpenCV's rules: taken over the window
 * less one pixel on each side. */
struct WindowLighting {
  bool has_contrast = false; ///< its standard deviation is above 10 grey levels
  float factor = 1;          ///< values of features are multiplied by it
};

/** \param[in] width, height of the window, at least 3 each
 * \param[in] x, y its upper left corner in the image */
WindowLighting
lightingOf(const IntegralImage& image, int x, int y, int width, int height);

} // namespace pcl6d
