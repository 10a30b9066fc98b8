// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drawing/pixel_layer.h"

#include <atomic>
#include <cstdint>
#include <memory>

namespace pcl6d::visualization {

/** \brief Draws points as round splats, the nearest on top, by the CPU: faster than
 * OpenGL in software, and pixel by pixel equal on every machine.
 *
 * Each pixel has four samples; a sample keeps the nearest splat. */
class SplatBuffer {
public:
  SplatBuffer(int width, int height);

  /** \brief Adds a splat; may be called from several threads, and the order never
   * changes the result. At equal depth the smaller index is visible. Splats that are
   * not finite or lie outside are left out.
   * \param[in] depth > 0, smaller is nearer \param[in] diameter [px]
   * \param[in] index of its colour */
  void
  add(float column, float row, float depth, float diameter, std::uint32_t index);

  /** \brief The picture, with eye-dome lighting: pixels behind their neighbours are
   * darker, which shows edges and shapes.
   * \param[in] colours by index \param[in] shading strength, >= 0; 0: off
   * \note Source: C. Boucheny, "Visualisation scientifique de grands volumes de
   * donnees", PhD thesis, Grenoble 2009. */
  PixelLayer
  paint(const std::vector<Colour>& colours, double shading) const;

  /** \return the share of pixels covered by splats */
  double
  coveredShare() const;

private:
  std::vector<float>
  logDepths() const;
  std::size_t
  sampleOf(int column, int row) const
  {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  int width_;
  int height_;
  int per_pixel_; ///< samples along a side of a pixel
  int columns_;   ///< of samples
  int rows_;
  /** bits of the depth, then the index: the smallest wins */
  std::unique_ptr<std::atomic<std::uint64_t>[]> samples_;
};

} // namespace pcl6d::visualization
