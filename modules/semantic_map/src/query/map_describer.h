// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/semantic_map/map_query.h>

#include <map>
#include <string>
#include <vector>

/** \file Properties of the entities of a map. Internal to the module semantic_map. */
namespace pcl6d::semantic_map {

/** \brief Lists the properties of each entity of a map; indices are into the map's
 * lists. */
class MapDescriber {
public:
  /** \param[in] map kept by reference */
  explicit MapDescriber(const SemanticMap& map);

  Properties
  scan(std::size_t place) const;
  Properties
  plane(std::size_t place) const;
  Properties
  object(std::size_t place) const;
  Properties
  room(std::size_t place) const;
  Properties
  storey(std::size_t place) const;
  Properties
  link(std::size_t place) const;
  Properties
  relation(std::size_t place) const;

private:
  using Things = std::vector<Entity>;
  using Neighbours = std::map<Entity, Things>;

  Things
  targets(const std::string& predicate, const Entity& entity) const;
  Things
  sources(const std::string& predicate, const Entity& entity) const;
  Things
  both(const std::string& predicate, const Entity& entity) const;
  /** \return the storey of the first room; without a room the storey at the position's
   * height */
  Things
  storeyOf(const Things& rooms, const Eigen::Vector3d& position) const;

  const SemanticMap& map_;
  std::map<std::string, Neighbours> forward_;  // predicate, first: seconds
  std::map<std::string, Neighbours> backward_; // predicate, second: firsts
  Neighbours seen_;                            // scan: planes and objects
};

} // namespace pcl6d::semantic_map
