// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "proposals/support_planes.h"

#include <cstdint>
#include <vector>

/** \file Graph of adjacent surfels. Internal to the module object_localization. */
namespace pcl6d::object_localization {

/** \brief A link to an adjacent surfel. */
struct SurfelLink {
  std::uint32_t other = 0; ///< its index in SurfelGraph::surfels
  float distance = 0;      ///< [m]
  /** sine of the angle between a tangent plane and the chord, the smaller of both ends:
   * > 0 where the surface bends inwards, < 0 outwards */
  float concavity = 0;
  bool adjacent = false; ///< without a gap in between
};

/** \brief A subset of the surfels and their links. */
struct SurfelGraph {
  std::vector<std::uint32_t> surfels; ///< indices into the Surfels, ascending
  std::vector<float> spacings;        ///< [m] of the scan, at each
  std::vector<std::uint32_t> begin;   ///< first link of each, and the end
  std::vector<SurfelLink> links;      ///< of each, nearest first

  std::size_t
  size() const
  {
    return surfels.size();
  }
};

/** \param[in] surfels to link
 * \param[in] angular_spacing [rad] of the scan */
SurfelGraph
linkSurfels(const PlaneCloud& cloud,
            std::vector<std::uint32_t> surfels,
            double angular_spacing,
            const ProposalOptions& options);

/** \brief Sets of indices into a graph, each ascending, in the order of their first
 * index. */
using SurfelSets = std::vector<std::vector<std::uint32_t>>;

/** \return the connected sets: by adjacency, and over wider gaps on one plane, such as
 * a table seen at a grazing angle */
SurfelSets
connectedSets(const PlaneCloud& cloud,
              const SurfelGraph& graph,
              const SceneSupports& supports);

/** \return the sets of masked surfels connected by adjacency
 * \param[in] mask per surfel of the graph, nonzero: included */
SurfelSets
connectedSets(const SurfelGraph& graph, const std::vector<char>& mask);

} // namespace pcl6d::object_localization
