// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/scan_reader.h>

#include <cstdint>
#include <optional>
#include <vector>

/** \file Recognition of the point layout of a .bin file, which has no header. */
namespace pcl6d::io {

/** \brief Result of recognising the layout of a file. */
struct LayoutGuess {
  BinLayout layout = BinLayout::kXyzi;
  bool is_sure = true; ///< false: a second layout fits about as well
};

/** \brief Recognises the layout by size and values: neighbours within a column differ less than
 * numbers of different columns, and numbers of NCLT are implausible as floats. Returns KITTI's
 * layout unless another layout is clearly better, and for files of few points.
 * \return empty if the size fits no layout */
std::optional<LayoutGuess>
guessBinLayout(const std::vector<std::uint8_t>& data);

/** \return [byte] the size of a point */
std::size_t
pointSizeOf(BinLayout layout);

} // namespace pcl6d::io
