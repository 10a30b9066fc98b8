// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Red, green, blue; 0 to 255. */
using Colour = std::array<std::uint8_t, 3>;

/** \brief A picture in memory. \ingroup visualization */
struct Image {
  int width = 0;                 ///< [px]
  int height = 0;                ///< [px]
  std::vector<std::uint8_t> rgb; ///< 3 bytes a pixel, row by row from the top
  std::vector<std::uint8_t> alpha =
      {}; ///< a byte per pixel, 255: opaque; empty: an opaque picture

  /** \return the colour of a pixel; column from the left, row from the top */
  Colour
  at(int column, int row) const;
};

/** \brief Writes a PNG file, atomically. \throws IoFailed writing failed
 * \throws BadArgument the picture is empty or its size does not fit its bytes */
void
writePng(const std::filesystem::path& path, const Image& image);

} // namespace pcl6d
