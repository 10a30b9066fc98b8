// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/object_localization/window_gate.h>

namespace pcl6d::object_localization {

/** \brief What a search for false alarms found. */
struct NegativeWindows {
  std::vector<GrayImage> windows; ///< of the cascade's size
  std::size_t passed = 0;         ///< windows of the backgrounds that pass all stages
  std::size_t tested = 0;         ///< those with enough contrast
};

/** \brief Finds false alarms of a cascade that grows. */
class NegativeFinder {
public:
  /** Keeps a reference to the backgrounds. */
  NegativeFinder(const std::vector<BackgroundImage>& backgrounds,
                 double scale_factor,
                 unsigned int num_threads);

  /** \brief Looks at the windows of the backgrounds as the detector does, and draws from
   * those that pass all stages of the cascade. Which are drawn depends on the seed alone.
   * \param[in] cascade the last one with more stages, or one without any at first */
  NegativeWindows
  find(const HaarCascade& cascade, std::size_t wanted, std::uint64_t seed);

private:
  /** A window in an image. */
  struct Place {
    std::uint16_t x, y; // of its corner in the image of its scale
  };
  /** The windows of an image that passed so far. */
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
