// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/segment.h>

#include <cstddef>
#include <cstdint>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of SegmentMap. */
struct SegmentMapOptions {
  double max_distance = 3; ///< [m] distances are told up to here; finite, > 0
  double cell = 0.5;       ///< [m] of the grid of candidates; finite, > 0
  std::size_t max_cells =
      4000000; ///< the cell is doubled until the grid has no more: 8
               ///< bytes each and 4 per candidate; > 0
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief A plan of walls with a fast look-up of the distance to the nearest wall.
 *
 * Each cell of a grid lists the candidates for the nearest segment within the cell: a distance is
 * exact and costs a few segments, whatever the size of the map. The list holds every segment no
 * farther from the cell's centre than the nearest segment plus the cell's diagonal; by the triangle
 * inequality no other segment can be nearest.
 *
 * National coordinates are kept apart: the map is relative to offset(), in whole metres, zero
 * unless the plan lies farther than 10 km from the origin.
 * \ingroup localisation */
class SegmentMap {
public:
  /** \param[in] segments [m] segments without length are left out
   * \throws BadArgument no segment has a length, a coordinate is not finite, or an
   * option is invalid */
  explicit SegmentMap(const Segments& segments,
                      const SegmentMapOptions& options = SegmentMapOptions());

  /** \return the distance to the nearest segment [m], at most max_distance, also returned for a
   * place that is not finite \param[in] place [m] relative to offset() */
  double
  distance(const Eigen::Vector2d& place) const;

  /** \return the segments, relative to offset() */
  const Segments&
  segments() const
  {
    return segments_;
  }

  /** \return the offset subtracted from the plan [m]: whole numbers */
  const Eigen::Vector2d&
  offset() const
  {
    return offset_;
  }

  /** \return the edge of a cell in use [m] */
  double
  cell() const
  {
    return cell_;
  }

  /** \return the corners of the box around the segments [m], relative to offset() */
  const Eigen::Vector2d&
  low() const
  {
    return low_;
  }
  const Eigen::Vector2d&
  high() const
  {
    return high_;
  }

  double
  maxDistance() const
  {
    return max_distance_;
  }

private:
  void
  chooseCell(const SegmentMapOptions& options);
  void
  fillGrid();
  template <typename Visit>
  void
  forCellsNear(const Segment& segment, double reach, Visit visit) const;
  Eigen::Vector2d
  centreOf(std::size_t column, std::size_t row) const;

  Segments segments_;
  Eigen::Vector2d offset_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d low_, high_;
  double max_distance_;
  double cell_ = 0;
  Eigen::Vector2d grid_low_; ///< corner of the first cell
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<std::uint32_t> first_;      ///< of each cell in candidates_
  std::vector<std::uint32_t> candidates_; ///< places of segments
};

/** \return the squared distance from a place to a segment [m^2]: the oracle of
 * SegmentMap */
inline double
squaredDistance(const Eigen::Vector2d& place, const Segment& segment)
{
  const Eigen::Vector2d along = segment.b - segment.a;
  const Eigen::Vector2d from_a = place - segment.a;
  const double length_sq = along.squaredNorm();
  double s = length_sq > 0 ? from_a.dot(along) / length_sq : 0;
  s = s < 0 ? 0 : s > 1 ? 1 : s;
  return (from_a - s * along).squaredNorm();
}

} // namespace pcl6d
