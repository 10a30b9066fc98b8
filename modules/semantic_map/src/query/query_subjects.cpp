// SPDX-License-Identifier: BSD-3-Clause
#include "query/map_describer.h"
#include "query/query_words.h"

#include <array>

namespace pcl6d::semantic_map {
namespace {
struct Subject {
  const char* singular;
  const char* plural;
  std::size_t (*size)(const SemanticMap&);
  Properties (MapDescriber::*describe)(std::size_t) const;
};

const std::array<Subject, 7>&
subjects()
{
  static const std::array<Subject, 7> all{
      {{"object",
        "objects",
        [](const SemanticMap& map) { return map.objects.size(); },
        &MapDescriber::object},
       {"plane",
        "planes",
        [](const SemanticMap& map) { return map.planes.size(); },
        &MapDescriber::plane},
       {"room",
        "rooms",
        [](const SemanticMap& map) { return map.rooms.size(); },
        &MapDescriber::room},
       {"storey",
        "storeys",
        [](const SemanticMap& map) { return map.storeys.size(); },
        &MapDescriber::storey},
       {"scan",
        "scans",
        [](const SemanticMap& map) { return map.scans.size(); },
        &MapDescriber::scan},
       {"link",
        "links",
        [](const SemanticMap& map) { return map.links.size(); },
        &MapDescriber::link},
       {"relation",
        "relations",
        [](const SemanticMap& map) { return map.relations.size(); },
        &MapDescriber::relation}}};
  return all;
}

/** A map with one entity of each kind. */
SemanticMap
smallestMap()
{
  SemanticMap map;
  map.scans.resize(1);
  map.links.resize(1);
  map.planes.resize(1);
  map.objects.resize(1);
  map.storeys.resize(1);
  map.rooms.resize(1);
  map.relations.resize(1);
  return map;
}
} // namespace

std::string
pluralOf(const std::string& subject)
{
  for (const auto& entry : subjects())
    if (subject == entry.singular || subject == entry.plural)
      return entry.plural;
  return "";
}

std::string
subjectNames()
{
  std::string names;
  for (const auto& entry : subjects())
    names += (names.empty() ? "" : ", ") + std::string(entry.plural);
  return names;
}

std::vector<Properties>
propertiesOf(const SemanticMap& map, const std::string& subject)
{
  std::vector<Properties> all;
  const MapDescriber describer(map);
  for (const auto& entry : subjects())
    for (std::size_t i = 0; subject == entry.plural && i < entry.size(map); ++i)
      all.push_back((describer.*entry.describe)(i));
  return all;
}

Properties
prototypeOf(const std::string& subject)
{
  return propertiesOf(smallestMap(), subject).front();
}

} // namespace pcl6d::semantic_map
