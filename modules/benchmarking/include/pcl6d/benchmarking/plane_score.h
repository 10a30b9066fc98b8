// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/plane.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Which plane each point of a cloud is on, by number from 1; 0: none. */
using PlaneNumbers = std::vector<std::uint32_t>;

/** \brief How scorePlanes() compares. */
struct PlaneScoreOptions {
  double overlap = 0.8;         ///< share of points that makes two the same; (0.5, 1]
  std::size_t min_points = 100; ///< true planes with fewer are not asked for; >= 1
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief A plane that was found and is a true one. */
struct PlaneMatch {
  std::uint32_t found = 0;
  std::uint32_t truth = 0;
  double normal_error = 0; ///< [rad] angle between the normals, whatever their sign
  double offset_error = 0; ///< [m] of the found plane in the middle of the true hull
};

/** \brief A segmentation beside the truth, in the usual counts: each true plane that is
 * asked for is correct, over-segmented, in an under-segmentation or missed; each found
 * one is correct, part of an over-segmentation, an under-segmentation, noise or not
 * judged. */
struct PlaneScore {
  std::size_t asked = 0;           ///< true planes of at least min_points points
  std::vector<PlaneMatch> correct; ///< by rising number of the true plane
  std::size_t over_segmented = 0;  ///< true planes that were split into several
  std::size_t under_segmented = 0; ///< found planes that join several true ones
  std::size_t joined = 0;          ///< the true planes in these
  std::size_t missed = 0;          ///< true planes with no counterpart at all
  std::size_t noise = 0;           ///< found planes with no counterpart at all
  std::size_t not_judged = 0;      ///< found planes mostly on planes not asked for

  /** \return correct / asked; 1 if nothing is asked */
  double
  correctShare() const;
  /** \return the median of the correct ones' normal errors [rad]; 0 for none */
  double
  medianNormalError() const;
  /** \return the median of the correct ones' offset errors [m]; 0 for none */
  double
  medianOffsetError() const;
};

/** \brief Compares the planes found in a cloud with the true ones.
 *
 * With T the option `overlap`: a found and a true plane are the same if they share T of
 * the points of each. A true plane is over-segmented if T of its points are on two or
 * more found planes, each with T of its own points on it. A found plane is an
 * under-segmentation if T of its points are on two or more true planes, T of the points
 * of each. Where several hold, correct comes before over-segmented and that before
 * under-segmented, since T > 0.5 allows a plane one partner at most.
 *
 * True planes of less than min_points points are not asked for. A found plane more than
 * half on such planes, or without any point, is not judged; points on small planes count
 * as points on none in all other respects.
 * \param[in] found, truth one number per point
 * \param[in] found_planes, true_planes number i at place i - 1; for the errors alone
 * \throws BadArgument an option breaks its rule, found and truth differ in size, or a
 * number has no plane
 * \note Source: A. Hoover et al., "An experimental comparison of range image
 * segmentation algorithms", PAMI 18(7), 1996. \ingroup benchmarking */
PlaneScore
scorePlanes(const PlaneNumbers& found,
            const std::vector<Plane>& found_planes,
            const PlaneNumbers& truth,
            const std::vector<Plane>& true_planes,
            const PlaneScoreOptions& options = {});

} // namespace pcl6d
