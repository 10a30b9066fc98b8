// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scene_interpretation/scene_plane.h>

#include <optional>
#include <string>
#include <vector>

/** \file
 * Relations of two planes, the predicates of the book's constraint network (7.1.2), and
 * rules made of them. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief Spatial relation of two planes i, j of one storey; `z` is the height of a
 * plane's centre. Tolerances: RelationTolerances. */
enum class Relation {
  kParallel,    ///< "parallel": equal or opposite normals
  kOrthogonal,  ///< "orthogonal"
  kAbove,       ///< "above": z_i > z_j + h
  kUnder,       ///< "under": z_j > z_i + h
  kEqualHeight, ///< "equalheight": |z_i - z_j| < h
  kOnto,        ///< "onto": parallel, and i lies in the carrier plane of j
  kRecessed,    ///< "recessed": onto, within the hull of j, and not in front of j
  kHinged,      ///< "hinged": both upright, across each other, an edge of i at j
  kStep,        ///< "step": one step of a flight of stairs higher or lower, and near
  kTouches,     ///< "touches": the hulls meet
  kApart        ///< "apart": the hulls do not overlap in plan
};

const char*
toString(Relation relation);

/** \return the relation with a name; nullopt for an unknown name */
std::optional<Relation>
relationFromName(const std::string& name);

/** \return the names of the relations, for messages: "parallel, orthogonal, ..." */
std::string
relationNames();

/** \brief Tolerances of the relations. */
struct RelationTolerances {
  double angle = 0.17453292519943295; ///< [rad] tau: 10 deg; in (0, pi/4)
  double height = 0.2;                ///< [m] h, of heights and carriers; > 0
  double touch = 0.1;                 ///< [m] hulls within this distance meet; > 0
  double in_front = 0.015; ///< [m] a "recessed" plane may stand out by this much; >= 0
  double hinge = 0.2;      ///< [m] from an edge to the wall; > 0
  double hinge_angle = 0.5235987755982988; ///< [rad] least angle of a leaf: 30 deg
  double min_step = 0.08;                  ///< [m] of stairs; > 0
  double max_step = 0.25;                  ///< [m] > min_step
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \return whether i is in the relation to j */
bool
holds(Relation relation,
      const ScenePlane& i,
      const ScenePlane& j,
      const RelationTolerances& tolerances);

/** \brief A relation, or several joined by "all", "any" and "not". */
struct RelationRule {
  enum class Kind { kRelation, kAll, kAny, kNot };
  Kind kind = Kind::kRelation;
  Relation relation = Relation::kParallel; ///< of kRelation
  std::vector<RelationRule> parts; ///< of kAll, kAny and kNot; exactly one part for
                                   ///< kNot
};

/** \return the rule in words: "parallel and (equalheight or apart)" */
std::string
toString(const RelationRule& rule);

bool
holds(const RelationRule& rule,
      const ScenePlane& i,
      const ScenePlane& j,
      const RelationTolerances& tolerances);

} // namespace pcl6d
