// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/camera_scanner.h>
#include <pcl6d/scanner/range_scan.h>

#include <array>
#include <limits>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Gate for the pixels of a time-of-flight camera; the defaults accept every
 * pixel with a phase. */
struct TofGate {
  double min_amplitude = 0; ///< of the swing, in the units of the samples; >= 0
  double max_offset = std::numeric_limits<double>::infinity(); ///< saturated above it
  double max_jump =
      std::numeric_limits<double>::infinity(); ///< [m] see dropFlyingPixels
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Time-of-flight camera (book 2.4): each pixel samples modulated light four
 * times a period, which gives distance, amplitude and offset. The range is radial and
 * known up to multiples of ambiguityInterval(). \ingroup scanner */
class TofCamera : public CameraScanner {
public:
  /** \param[in] modulation [Hz] > 0 \throws BadArgument an option is invalid */
  TofCamera(const CameraIntrinsics& camera, double modulation, double frame_period);

  /** \return [m] c / (2 f) */
  double
  ambiguityInterval() const;

  /** \brief Ranges from four images A_k = O + A cos(phi + k pi / 2), k = 0..3, row by
   * row. A sample's intensity is its amplitude A.
   * \throws BadArgument an image has another size than the camera */
  RangeScan
  rangeScan(const std::array<std::vector<double>, 4>& images,
            const TofGate& gate = {}) const;

private:
  double modulation_;
};

/** \brief Drops flying pixels, whose spot lay on two surfaces: pixels farther than
 * max_jump from both neighbours in their row, or in their column. The last pixel of a
 * surface stays, having a neighbour on the surface; an object one pixel wide is
 * dropped. \param[in] max_jump [m] of the range, > 0
 * \return the number of dropped pixels */
std::size_t
dropFlyingPixels(RangeScan& scan, double max_jump);

} // namespace pcl6d
