// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scene_interpretation/relations.h>
#include <pcl6d/semantic_map/semantic_map.h>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief How exactly relations of a map are to hold. */
struct MapRelationOptions {
  RelationTolerances planes; ///< of relations between planes
  double reach = 10;         ///< [m] planes farther apart are not related; > 0
  double on = 0.05;     ///< [m] from the foot of an object to what it stands on; > 0
  double next_to = 0.5; ///< [m] between neighbours; > 0
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Finds how planes, objects and rooms lie to each other. Relations with a
 * direction are kept once (`above`; `under` follows), symmetric ones with the lower id
 * first.
 *
 * | first | predicate | second | holds if |
 * |---|---|---|---|
 * | plane | parallel, orthogonal, equalheight, onto, touches, above | plane | as
 *   holds(Relation), both labelled, their boxes within reach |
 * | object | on | plane | a level plane is under its foot (lowest point, below the middle
 *   of the box), at most `on` away; the nearest one |
 * | object | on | object | its foot is over the other's box and at most `on` from its top,
 *   or it is on a plane that is in the other object |
 * | object, plane | in | object | all of it, or of its box, is in the box of a larger one |
 * | object | in | room | its foot is in the outline, between floor and ceiling |
 * | object | next_to | object | not above each other, their boxes at most `next_to` apart |
 * | object | next_to | plane | an upright labelled plane is so near to its box |
 * | object | above | object | its foot is over the other's top, boxes overlap in plan |
 * | plane | belongs_to | room | found by findRooms(), kept |
 * | room | next_to | room | a door joins them; found by findRooms(), kept |
 *
 * \param[in] map its relations that start with a plane and belongs_to, or with a room, are
 * kept \return all relations, those of lower kinds and ids first
 * \throws BadArgument an option breaks its rule
 * \note Source: algorithms of book 7.1.2 and 7.3. \ingroup semantic_map */
std::vector<MapRelation>
findRelations(const SemanticMap& map, const MapRelationOptions& options = {});

/** \return all predicates of a map: "parallel", ..., "on", "in", "next_to", "above",
 * "belongs_to" */
const std::vector<std::string>&
mapPredicates();

} // namespace pcl6d
