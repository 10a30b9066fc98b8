// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/object_localization/haar_cascade.h>

namespace pcl6d {

/** \brief What a search for false alarms found. */
struct NegativeWindows {
  std::vector<GrayImage> windows; ///< of the cascade's size
  std::size_t passed = 0;         ///< windows of the backgrounds that pass all stages
  std::size_t tested = 0;         ///< those with enough contrast
};

struct NegativeSearch {
  std::size_t wanted = 0;
  double scale_factor = 1.2;
  std::uint64_t seed = 1;
  unsigned int num_threads = 0;
};

/** \brief Looks at all windows of the backgrounds, as the detector does, and draws from
 * those that pass all stages of the cascade (which may have none yet). Which are drawn
 * depends on the seed alone. */
NegativeWindows
findNegatives(const HaarCascade& cascade,
              const std::vector<GrayImage>& backgrounds,
              const NegativeSearch& search);

} // namespace pcl6d
