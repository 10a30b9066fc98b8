// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/integral_image.h>

#include <array>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A rectangle of a feature. A tilted rectangle starts at its upper corner (x,
 * y); its width runs down to the right and its height down to the left, at 45 deg. */
struct HaarRect {
  ImageRect rect;
  float weight = 0; ///< of the sum over the rectangle; 0: no rectangle
};

/** \brief A weighted difference of sums over rectangles of a window. */
struct HaarFeature {
  std::array<HaarRect, 3> rects;
  bool tilted = false;
};

/** \brief The features that haarFeatures() makes. */
enum class HaarFeatureSet {
  kUpright, ///< edges, lines, centre-surround and diagonals
  kAll      ///< upright and tilted edges, lines and centre-surrounds
};

/** \return the set called "upright" or "all" \throws BadArgument another name */
HaarFeatureSet
haarFeatureSetFromName(const std::string& name);

/** \return every feature of a window, at each position and size: edges of two
 * rectangles, lines of three and of four, centre-surround of nine and diagonals of four
 * equal cells. The weighted areas of a feature sum up to zero, so its value is
 * independent of the mean brightness. Several 10^5 features for 24 x 24 pixels.
 * \throws BadArgument the window is not 4 to 128 pixels wide and high
 * \note Source: Lienhart and Maydt, ICIP 2002. \ingroup object_localization */
std::vector<HaarFeature>
haarFeatures(int width, int height, HaarFeatureSet set = HaarFeatureSet::kAll);

/** \return whether its rectangles, at least two, lie in a window */
bool
fits(const HaarFeature& feature, int width, int height);

/** \brief Offsets of a feature's corners in the tables, for tables of one width. */
struct HaarOffsets {
  /** sum = t[0] - t[1] - t[2] + t[3], from the entry of the window's upper left corner */
  std::array<std::array<int, 4>, 3> corners{};
  std::array<float, 3> weights{};
  bool tilted = false;

  HaarOffsets() = default;
  /** \param[in] stride entries per row of the tables */
  HaarOffsets(const HaarFeature& feature, int stride);

  /** \brief The feature before normalisation, computed in float like
   * cv::CascadeClassifier.
   * \param[in] window entry of the window's corner in the upright or the tilted table,
   * see `tilted` */
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

/** \brief Brightness and contrast of a window by OpenCV's rules: measured on the window
 * less one pixel on each side. */
struct WindowLighting {
  bool has_contrast = false; ///< its standard deviation is above 10 grey levels
  float factor = 1;          ///< multiplies the values of features
};

/** \param[in] width, height of the window, at least 3 each
 * \param[in] x, y its upper left corner in the image */
WindowLighting
lightingOf(const IntegralImage& image, int x, int y, int width, int height);

} // namespace pcl6d
