// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A picture of 8-bit grey values, row by row. Row 0 is the uppermost. */
struct GrayImage {
  int rows = 0;
  int cols = 0;
  std::vector<std::uint8_t> pixels; ///< rows * cols

  GrayImage() = default;
  GrayImage(int num_rows, int num_cols, std::uint8_t gray = 0)
  : rows(num_rows)
  , cols(num_cols)
  , pixels(static_cast<std::size_t>(num_rows) * static_cast<std::size_t>(num_cols),
           gray)
  {}

  std::uint8_t&
  at(int row, int col)
  {
    return pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) +
                  static_cast<std::size_t>(col)];
  }
  std::uint8_t
  at(int row, int col) const
  {
    return pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) +
                  static_cast<std::size_t>(col)];
  }
};

/** \brief A rectangle of an image's pixels. */
struct ImageRect {
  int x = 0; ///< column of its left border
  int y = 0; ///< row of its upper border
  int width = 0;
  int height = 0;

  friend bool
  operator==(const ImageRect& a, const ImageRect& b)
  {
    return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
  }
};

/** \return a part of an image \throws BadArgument the part reaches out of the image */
GrayImage
cropped(const GrayImage& image, const ImageRect& part);

/** \return the image in another size, interpolated linearly like cv::CascadeClassifier
 * (OpenCV's INTER_LINEAR_EXACT)
 * \throws BadArgument the image is empty, or a size < 1 */
GrayImage
resized(const GrayImage& image, int rows, int cols);

/** \brief Integral image: the sum over any rectangle takes four table entries.
 *
 * Each table has one row and one column more than the image. The entry (y, x) of sums()
 * and squares() sums the pixels above and to the left. The entry of tilted() sums the
 * triangle that opens upwards from the pixel (y - 1, x - 1), with sides at 45 deg. Sums
 * count modulo 2^32; the sum of a rectangle is right where it fits.
 * \note Sources: Viola and Jones, "Rapid object detection using a boosted cascade of
 * simple features", CVPR 2001; Lienhart and Maydt, "An extended set of Haar-like
 * features for rapid object detection", ICIP 2002. \ingroup object_localization */
class IntegralImage {
public:
  enum class Tables {
    kUpright, ///< tilted() stays empty
    kAll
  };

  explicit IntegralImage(const GrayImage& image, Tables tables = Tables::kAll);

  int
  rows() const
  {
    return rows_;
  }
  int
  cols() const
  {
    return cols_;
  }
  /** \return entries per row of the tables: cols() + 1 */
  int
  stride() const
  {
    return cols_ + 1;
  }
  const std::vector<std::uint32_t>&
  sums() const
  {
    return sums_;
  }
  const std::vector<std::uint32_t>&
  squares() const
  {
    return squares_;
  }
  const std::vector<std::uint32_t>&
  tilted() const
  {
    return tilted_;
  }

private:
  void
  sumUpright(const GrayImage& image);
  void
  sumTilted(const GrayImage& image);

  int rows_, cols_;
  std::vector<std::uint32_t> sums_, squares_, tilted_;
};

} // namespace pcl6d
