// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/semantic_map/semantic_map.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of findRooms(). */
struct RoomOptions {
  double storey_height = 0.3; ///< [m] floors within this height difference are one
                              ///< storey; > 0
  double cell = 0.05;         ///< [m] of the plan; > 0
  double min_wall_height =
      1.2;              ///< [m] over the floor: lower planes do not separate rooms; > 0
  double max_gap = 0.3; ///< [m] that walls are extended at each end; >= 0
  double max_door =
      1.3; ///< [m] a gap up to this width between pieces of a wall is a door; >= 0
  double min_width = 0.8; ///< [m] of the largest square in a room; > 0
  double min_area = 1;    ///< [m^2] of a room; >= 0
  double min_seen =
      0.2; ///< share of the room's squares of 25 cm with a floor point; in [0, 1]
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Finds storeys and rooms, and writes them into a map.
 *
 * A storey is the set of floors at one height. A room is a connected part of the plan
 * of its floor planes, cut by walls and doors. Walls are lines of the plan, extended by
 * max_gap at both ends; gaps of a wall up to max_door are closed. Parts narrower than
 * min_width are not rooms (the inside of a wall), nor are parts inside a floor's hull
 * without floor points. The plan is aligned with the walls. Relations are added: planes
 * belong_to the rooms that they bound, and rooms are next_to each other if a door is
 * between them. Each door joins its two nearest rooms. A door is a plane labelled door,
 * a gap of a wall, or a piece of a wall with floor inside.
 * \param[in] floor_points [m] in the world less world_offset; empty: only hulls are
 * used
 * \throws BadArgument an option is invalid \ingroup semantic_map */
void
findRooms(SemanticMap& map,
          const Points& floor_points = {},
          const RoomOptions& options = {});

} // namespace pcl6d
