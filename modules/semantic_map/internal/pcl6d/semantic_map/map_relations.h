// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scene_interpretation/relations.h>
#include <pcl6d/semantic_map/semantic_map.h>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Tolerances of the relations of a map. */
struct MapRelationOptions {
  RelationTolerances planes; ///< of relations between planes
  double reach = 10;         ///< [m] planes farther apart are not related; > 0
  double on = 0.05;          ///< [m] from the foot of an object to its support; > 0
  double next_to = 0.5;      ///< [m] between neighbours; > 0
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Finds relations of planes, objects and rooms. Relations with a direction are
 * kept once (`above`; `under` follows), symmetric relations with the lower id first.
 *
 * | first | predicate | second | holds if |
 * |---|---|---|---|
 * | plane | parallel, orthogonal, equalheight, onto, touches, above | plane | see
 *   holds(Relation); both labelled, their boxes within reach |
 * | object | on | plane | a level plane is under its foot (lowest point, below the middle
 *   of the box), at most `on` away; the nearest plane |
 * | object | on | object | its foot is over the other's box and at most `on` from its top,
 *   or on a plane inside the other object |
 * | object, plane | in | object | the plane, or the object's box, is in a larger box |
 * | object | in | room | its foot is in the outline, between floor and ceiling |
 * | object | next_to | object | not above each other, their boxes at most `next_to` apart |
 * | object | next_to | plane | its box is near (`next_to`) an upright labelled plane |
 * | object | above | object | its foot is over the other's top, boxes overlap in plan |
 * | plane | belongs_to | room | found by findRooms(), kept |
 * | room | next_to | room | joined by a door; found by findRooms(), kept |
 *
 * \param[in] map its relations that start with a room, or with a plane and belongs_to,
 * are kept
 * \return the relations, lower kinds and ids first
 * \throws BadArgument an option is invalid
 * \note Source: algorithms of book 7.1.2 and 7.3. \ingroup semantic_map */
std::vector<MapRelation>
findRelations(const SemanticMap& map, const MapRelationOptions& options = {});

/** \return the predicates of a map: "parallel", ..., "on", "in", "next_to", "above",
 * "belongs_to" */
const std::vector<std::string>&
mapPredicates();

} // namespace pcl6d
