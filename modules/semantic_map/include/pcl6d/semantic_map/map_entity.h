// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

/** \file Names of what a semantic map holds: `plane:12`, `object:3`. */
namespace PCL6D_EXPORTS pcl6d {

enum class EntityKind { kScan, kPlane, kObject, kRoom, kStorey };

/** \return "scan", "plane", "object", "room" or "storey" */
const char*
toString(EntityKind kind);

/** \return the kind of that name; none if there is none */
std::optional<EntityKind>
entityKindFromName(std::string_view name);

/** \brief One thing of a map. A scan's id is its index in the run (from 0), all others
 * are the place in the map's list plus one. \ingroup semantic_map */
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

/** \return what toString() wrote; none if the text is of another form */
std::optional<Entity>
entityFromText(std::string_view text);

} // namespace pcl6d
