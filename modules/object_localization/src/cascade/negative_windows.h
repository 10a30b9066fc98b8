// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/object_localization/window_gate.h>

namespace pcl6d::object_localization {

/** \brief Result of a search for false alarms. */
struct NegativeWindows {
  std::vector<GrayImage> windows; ///< of the cascade's size
  std::size_t passed = 0;         ///< background windows that pass every stage
  std::size_t tested = 0;         ///< background windows with enough contrast
};

/** \brief Finds false alarms of a growing cascade. */
class NegativeFinder {
public:
  /** Keeps a reference to the backgrounds. */
  NegativeFinder(const std::vector<BackgroundImage>& backgrounds,
                 double scale_factor,
                 unsigned int num_threads);

  /** \brief Tests the windows of the backgrounds like the detector, and draws from the
   * windows that pass every stage. The seed alone decides the draw.
   * \param[in] cascade the previous cascade with more stages; without stages in the
   * first call */
  NegativeWindows
  find(const HaarCascade& cascade, std::size_t wanted, std::uint64_t seed);

private:
  /** A window in an image. */
  struct Place {
    std::uint16_t x, y; // corner in the image of its scale
  };
  /** The windows of an image that have passed up to now. */
  struct Search {
    bool is_known = false;
    std::vector<std::vector<Place>> places; // by scale
    std::size_t tested = 0;
  };
  struct Alarm;
  struct Alarms;

  std::vector<WindowScale>
  scalesOf(const HaarCascade& cascade, std::size_t image) const;
  std::vector<Place>
  allPlaces(const WindowScale& scale, std::size_t image) const;
  Alarms
  searchImage(const HaarCascade& cascade,
              std::size_t image,
              std::size_t wanted,
              std::uint64_t seed);
  GrayImage
  cut(const HaarCascade& cascade, const Alarm& alarm) const;

  const std::vector<BackgroundImage>& backgrounds_;
  double scale_factor_;
  unsigned int num_threads_;
  std::vector<Search> searches_; // per image
};

} // namespace pcl6d::object_localization
