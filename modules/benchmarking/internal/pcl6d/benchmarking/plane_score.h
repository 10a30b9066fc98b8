// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/plane.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Number of the plane of each point of a cloud, from 1; 0: no plane. */
using PlaneNumbers = std::vector<std::uint32_t>;

/** \brief How scorePlanes() compares. */
struct PlaneScoreOptions {
  double overlap = 0.8;         ///< common share of points of matching planes; (0.5, 1]
  std::size_t min_points = 100; ///< true planes with fewer are not asked for; >= 1
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief A found plane and the matching true plane. */
struct PlaneMatch {
  std::uint32_t found = 0;
  std::uint32_t truth = 0;
  double normal_error = 0; ///< [rad] angle between the normals, whatever their sign
  double offset_error = 0; ///< [m] of the found plane in the middle of the true hull
};

/** \brief A segmentation compared with the truth, in the usual counts. Each true plane
 * that is asked for is correct, over-segmented, in an under-segmentation or missed.
 * Each found plane is correct, part of an over-segmentation, an under-segmentation,
 * noise or ignored. */
struct PlaneScore {
  std::size_t asked = 0;           ///< true planes of at least min_points points
  std::vector<PlaneMatch> correct; ///< by rising number of the true plane
  std::size_t over_segmented = 0;  ///< true planes split into several found planes
  std::size_t under_segmented = 0; ///< found planes that merge several true planes
  std::size_t joined = 0;          ///< number of true planes merged
  std::size_t missed = 0;          ///< true planes without counterpart
  std::size_t noise = 0;           ///< found planes without counterpart
  std::size_t not_evaluated = 0;   ///< found planes mostly on planes not asked for

  /** \return correct / asked; 1 if asked is 0 */
  double
  correctShare() const;
  /** \return the median normal error of the correct planes [rad]; 0 without correct planes */
  double
  medianNormalError() const;
  /** \return the median offset error of the correct planes [m]; 0 without correct planes */
  double
  medianOffsetError() const;
};

/** \brief Compares the planes found in a cloud with the true planes.
 *
 * With T the option `overlap`: a found and a true plane match if they share T of the
 * points of each. A true plane is over-segmented if T of its points are on two or more
 * found planes, each with T of its own points on the true plane. A found plane is an
 * under-segmentation if T of its points are on two or more true planes, T of the points
 * of each. If several cases apply, the order is correct, over-segmented,
 * under-segmented. As T > 0.5, a plane has at most one partner.
 *
 * True planes of less than min_points points are not asked for. A found plane is
 * ignored if more than half of its points are on small planes, or if it has no points.
 * Otherwise points on small planes count as points on no plane.
 * \param[in] found, truth one number per point
 * \param[in] found_planes, true_planes plane number i has index i - 1; used only for
 * the errors
 * \throws BadArgument an option is invalid, found and truth differ in size, or a number
 * has no plane
 * \note Source: A. Hoover et al., "An experimental comparison of range image
 * segmentation algorithms", PAMI 18(7), 1996. \ingroup benchmarking */
PlaneScore
scorePlanes(const PlaneNumbers& found,
            const std::vector<Plane>& found_planes,
            const PlaneNumbers& truth,
            const std::vector<Plane>& true_planes,
            const PlaneScoreOptions& options = {});

} // namespace pcl6d
