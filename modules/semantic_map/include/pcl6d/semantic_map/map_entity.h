// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

/** \file Names of the entities of a semantic map: `plane:12`, `object:3`. */
namespace PCL6D_EXPORTS pcl6d {

enum class EntityKind { kScan, kPlane, kObject, kRoom, kStorey };

/** \return "scan", "plane", "object", "room" or "storey" */
const char*
toString(EntityKind kind);

/** \return the kind with a name; nullopt for an unknown name */
std::optional<EntityKind>
entityKindFromName(std::string_view name);

/** \brief An entity of a map. A scan's id is its index in the run (from 0); other ids
 * are the index in the map's list plus one. \ingroup semantic_map */
struct Entity {
  EntityKind kind = EntityKind::kPlane;
  std::size_t id = 1;

  friend bool
  operator==(const Entity& a, const Entity& b)
  {
    return a.kind == b.kind && a.id == b.id;
  }
  friend bool
  operator<(const Entity& a, const Entity& b)
  {
    return std::tie(a.kind, a.id) < std::tie(b.kind, b.id);
  }
};

/** \return "plane:12" */
std::string
toString(const Entity& entity);

/** \return the entity written by toString(); nullopt for text of another form */
std::optional<Entity>
entityFromText(std::string_view text);

} // namespace pcl6d
