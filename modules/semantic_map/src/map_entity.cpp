// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/semantic_map/map_entity.h>

#include <charconv>

namespace pcl6d {
namespace {
constexpr Named<EntityKind> kKinds[] = {{EntityKind::kScan, "scan"},
                                        {EntityKind::kPlane, "plane"},
                                        {EntityKind::kObject, "object"},
                                        {EntityKind::kRoom, "room"},
                                        {EntityKind::kStorey, "storey"}};
} // namespace

const char*
toString(EntityKind kind)
{
  return nameOf(kKinds, kind);
}

std::optional<EntityKind>
entityKindFromName(std::string_view name)
{
  return findNamed(kKinds, name);
}

std::string
toString(const Entity& entity)
{
  return toString(entity.kind) + (':' + std::to_string(entity.id));
}

std::optional<Entity>
entityFromText(std::string_view text)
{
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos)
    return {};
  const auto kind = entityKindFromName(text.substr(0, colon));
  const std::string_view number = text.substr(colon + 1);
  Entity entity;
  const auto [end, error] =
      std::from_chars(number.data(), number.data() + number.size(), entity.id);
  if (!kind || error != std::errc() || end != number.data() + number.size())
    return {};
  entity.kind = *kind;
  return entity;
}

} // namespace pcl6d
