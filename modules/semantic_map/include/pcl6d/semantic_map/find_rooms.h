// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/semantic_map/semantic_map.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of findRooms(). */
struct RoomOptions {
  double storey_height = 0.3; ///< [m] floors this near in height are one storey; > 0
  double cell = 0.05;         ///< [m] of the plan; > 0
  double min_wall_height =
      1.2;              ///< [m] over the floor: what is lower parts nothing; > 0
  double max_gap = 0.3; ///< [m] by which walls are made longer at each end; >= 0
  double max_door =
      1.3; ///< [m] a gap this wide between pieces of a wall is a door; >= 0
  double min_width = 0.8; ///< [m] of the largest square in a room; > 0
  double min_area = 1;    ///< [m^2] of a room; >= 0
  double min_seen =
      0.2; ///< share of its squares of 25 cm with a floor point; in [0, 1]
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Finds storeys and rooms, and writes them into a map.
 *
 * A storey is all floors at one height. A room is a connected part of the plan of its
 * floor planes, as walls and doors cut it: walls are lines of the plan, made longer by
 * max_gap at both ends, gaps of a wall up to max_door are closed. What is narrower than
 * min_width is no room (the inside of a wall), and neither is what the hull of a floor
 * covers though no floor point was seen there. The plan is aligned with the walls.
 * Relations are added: planes belong_to the rooms that they bound, and rooms are
 * next_to each other if a door lies between: each door joins the two rooms nearest to it.
 * A door is a plane with that label, a gap of a wall, or a piece of it with floor inside.
 * \param[in] floor_points [m] in the world less world_offset; empty: hulls alone count
 * \throws BadArgument an option breaks its rule \ingroup semantic_map */
void
findRooms(SemanticMap& map,
          const Points& floor_points = {},
          const RoomOptions& options = {});

} // namespace pcl6d
